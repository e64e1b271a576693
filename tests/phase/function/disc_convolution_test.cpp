#include "phase/function/disc_convolution.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "phase/function/half_angle.h"
#include "tests/phase/function/synthetic_drops.h"

namespace arcus::phase {

namespace {

constexpr double radius_deg = mean_sun_radius_deg;

/// A function linear in s = sin²(θ/2) between nodes.
struct Interpolant {
  Interpolant(std::vector<double> angles_deg, std::vector<double> node_values)
      : angle_deg(std::move(angles_deg)), values(std::move(node_values)) {
    for (const double deg : angle_deg) s.push_back(sin2_half_deg(deg));
  }
  double operator()(double x) const {
    const auto above = std::upper_bound(s.begin() + 1, s.end() - 1, x);
    const std::size_t i = static_cast<std::size_t>(above - s.begin()) - 1;
    return values[i] + (x - s[i]) / (s[i + 1] - s[i]) * (values[i + 1] - values[i]);
  }
  std::vector<double> angle_deg, values, s;
};

/// The drops' phase function at 550 nm.
Interpolant drops_of(double size_um, int every = 1) {
  const auto angle_deg = synthetic_angles_deg(every);
  return {angle_deg, synthetic_row(SyntheticDrops(size_um), 550, angle_deg)};
}

/// Mean over the disc by adding up its points.
double brute_force(const Interpolant& function, const DiscProfile& disc, double angle_deg,
                   double wavelength_nm, int rings, int points) {
  const Frame centre = frame_around(direction_of(0, 0));
  const Vec3 outgoing = direction_at(centre, sin2_half_deg(angle_deg), 0);
  const double s_disc = std::pow(std::sin(disc.angular_radius_rad() / 2), 2);
  double sum = 0, weight = 0;
  for (int r = 0; r < rings; ++r) {
    const double rho = (r + 0.5) / rings;
    const double radiance = rho * disc.relative_radiance(rho, wavelength_nm);
    for (int q = 0; q < points; ++q) {
      const Vec3 incoming = direction_at(centre, rho * rho * s_disc, pi * (q + 0.5) / points);
      sum += radiance * function(half_angle_between(incoming, outgoing).sin2);
    }
    weight += radiance * points;
  }
  return sum / weight;
}

std::vector<float> mean_over_disc(const std::vector<double>& angle_deg, double disc_radius_deg,
                                  const std::vector<float>& values, const WavelengthGrid& grid) {
  std::vector<float> means(values.size());
  DiscConvolution(angle_deg, DiscProfile(radians(disc_radius_deg))).apply(values, 1, grid, means);
  return means;
}

/// Largest relative difference between the convolution and brute force at the nodes near `places`.
double largest_error(const Interpolant& function, double disc_radius_deg,
                     const std::vector<double>& places_deg) {
  const DiscProfile disc(radians(disc_radius_deg));
  const WavelengthGrid grid(450, 650, 2);
  std::vector<float> values;
  for (const double v : function.values) values.insert(values.end(), 2, static_cast<float>(v));
  const auto means = mean_over_disc(function.angle_deg, disc_radius_deg, values, grid);
  double largest = 0;
  for (std::size_t place = 0; place < places_deg.size(); ++place) {
    const auto node = static_cast<std::size_t>(
        std::lower_bound(function.angle_deg.begin(), function.angle_deg.end(), places_deg[place]) -
        function.angle_deg.begin());
    const int k = place % 2;
    const double expected =
        brute_force(function, disc, function.angle_deg[node], grid.wavelength_nm(k), 400, 400);
    largest = std::max(largest, std::fabs(means[2 * node + k] / expected - 1));
  }
  return largest;
}

}  // namespace

TEST(DiscConvolution, LeavesAConstantAsItIs) {
  const std::vector<double> angle_deg{0, 0.01, 0.2, 0.3, 30, 90, 170, 179.8, 180};
  const std::vector<float> values(2 * angle_deg.size(), 0.25f);
  for (const float v : mean_over_disc(angle_deg, radius_deg, values, WavelengthGrid(400, 700, 2)))
    EXPECT_NEAR(v, 0.25f, 1e-7);
}

TEST(DiscConvolution, MeetsBruteForceForANarrowRing) {
  // A hat 0.04° wide at 50°, seen from within and around.
  std::vector<double> angle_deg, values;
  for (int i = 0; i <= 36000; ++i) {
    const double deg = i * 0.005;
    if (std::fabs(deg - 50) > 1 && i % 200 != 0) continue;
    angle_deg.push_back(deg);
    values.push_back(1e-6 + std::fmax(0.0, 1 - std::fabs(deg - 50) / 0.02));
  }
  EXPECT_LT(largest_error({angle_deg, values}, radius_deg,
                          {49.75, 49.8, 49.9, 50, 50.05, 50.1, 50.2}),
            1e-3);
}

TEST(DiscConvolution, MeetsBruteForceAtBothEndsAndInTheBows) {
  EXPECT_LT(largest_error(drops_of(500), radius_deg,
                          {0, 0.01, 0.1, 0.2666, 0.3, 0.6, 128.9, 129.2, 137.4, 137.6, 138.3, 139,
                           179.5, 179.72, 179.74, 179.9, 179.99, 180}),
            1e-3);
}

TEST(DiscConvolution, MeetsBruteForceForAWideDisc) {
  EXPECT_LT(largest_error(drops_of(10, 8), 5, {0, 1, 4.9, 5, 6, 90, 140, 174, 175.5, 179, 180}), 1e-3);
}

// With a disc a hundredth too large the comparison above fails: it sees the disc's edge.
TEST(DiscConvolution, DiffersFromBruteForceForAnotherDisc) {
  const Interpolant function = drops_of(500);
  const DiscProfile disc(radians(radius_deg)), larger(radians(1.01 * radius_deg));
  const double a = brute_force(function, disc, 137.6, 550, 400, 400);
  const double b = brute_force(function, larger, 137.6, 550, 400, 400);
  EXPECT_GT(std::fabs(a / b - 1), 2e-3);
}

TEST(DiscConvolution, FeelsTheDarkeningOfTheEdge) {
  // Half of the sky lit, seen with all but a sliver of the disc in it: less is missing than the
  // sliver's share of the disc.
  const std::vector<double> angle_deg{0, 59.9999, 60.0001, 60.2, 180};
  const std::vector<float> values{0, 0, 0, 0, 1, 1, 1, 1, 1, 1};
  const auto means = mean_over_disc(angle_deg, radius_deg, values, WavelengthGrid(450, 650, 2));
  const double h = 0.2 / radius_deg, sliver = (std::acos(h) - h * std::sqrt(1 - h * h)) / pi;
  const double missing_450 = 1 - means[6], missing_650 = 1 - means[7];
  EXPECT_LT(missing_450, 0.78 * sliver);
  EXPECT_LT(missing_450, missing_650);
  EXPECT_LT(missing_650, 0.86 * sliver);
  EXPECT_GT(missing_450, 0.6 * sliver);
}

}  // namespace arcus::phase
