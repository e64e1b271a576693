#include "phase/particle/drop_rays.h"

#include <gtest/gtest.h>

#include <cmath>

#include "phase/base/units.h"
#include "phase/optics/refractive_index.h"

namespace arcus::phase {
namespace {

std::vector<double> even_edges(int cells) {
  std::vector<double> edges;
  for (int i = 0; i <= cells; ++i) edges.push_back(pi * i / cells);
  return edges;
}

double integral(const std::vector<double>& values, const std::vector<double>& edges) {
  double sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    sum += values[i] * 2 * pi * (std::cos(edges[i]) - std::cos(edges[i + 1]));
  return sum;
}

/// Radius of a bow around the antisolar point.
double bow_radius_deg(int order, double n) {
  const RaysOfOrder rays(order, n);
  return std::fabs(180 - degrees(rays.turned_rad(*rays.bow_incidence_rad())));
}

}  // namespace

// A sphere of index 1.3343: shares of the energy and asymmetry, computed independently of this
// code.
TEST(GeometricSphere, SharesTheEnergyAmongItsOrders) {
  const auto edges = even_edges(90);
  const GeometricSphere sphere = geometric_sphere(1000, 1.3343, edges, 30);
  const double expected[] = {.0666, .8833, .0407, .0061, .0017};
  for (std::size_t p = 0; p < 5; ++p) EXPECT_NEAR(sphere.order_share[p], expected[p], 5.1e-5) << p;
  EXPECT_NEAR(sphere.efficiencies.scattering, 1, 1e-5);
  EXPECT_NEAR(sphere.efficiencies.asymmetry, 0.7676, 5.1e-5);
  EXPECT_EQ(sphere.efficiencies.extinction, 1);
}

TEST(GeometricSphere, CellsHoldWhatTheOrdersScatter) {
  const auto edges = even_edges(720);
  const GeometricSphere sphere = geometric_sphere(1000, 1.333, edges);
  EXPECT_NEAR(integral(sphere.s11, edges), sphere.efficiencies.scattering, 1e-9);
  // Six orders are what a ray tracer with as many follows: the rest is missing.
  EXPECT_EQ(sphere.order_share.size(), 6u);
  EXPECT_LT(sphere.efficiencies.scattering, 0.9996);
}

TEST(GeometricSphere, CellsAreMeansOfSmallerCells) {
  const auto fine = even_edges(3600), coarse = even_edges(180);
  const GeometricSphere a = geometric_sphere(1000, 1.333, fine),
                        b = geometric_sphere(1000, 1.333, coarse);
  for (std::size_t i = 0; i < 180; ++i) {
    double sum = 0, sum12 = 0, area = 0;
    for (std::size_t j = 20 * i; j < 20 * i + 20; ++j) {
      const double piece = std::cos(fine[j]) - std::cos(fine[j + 1]);
      sum += a.s11[j] * piece;
      sum12 += a.s12[j] * piece;
      area += piece;
    }
    EXPECT_NEAR(sum / area / b.s11[i], 1, 1e-6) << i;
    EXPECT_NEAR(sum12 / area, b.s12[i], 1e-6 * b.s11[i]) << i;
  }
}

TEST(GeometricSphere, HasTheClosedFormStraightOnAndStraightBack) {
  // Paraxial rays: reflected (n-1)^2/(n+1)^2 / 4, through (4n/(n+1)^2)^2 (n/(2(n-1)))^2, over pi.
  const double n = 1.333, r = std::pow((n - 1) / (n + 1), 2);
  const std::vector<double> edges{0, radians(0.2), radians(179.8), pi};
  const GeometricSphere sphere = geometric_sphere(1000, n, edges, 1);
  EXPECT_NEAR(sphere.s11[2], r / 4 / pi, 1e-5 * r);
  const double through = std::pow((1 - r) * n / (2 * (n - 1)), 2) / pi;
  const double reflected = geometric_sphere(1000, n, edges, 0).s11[0];
  EXPECT_NEAR(sphere.s11[0] - reflected, through, 1e-4 * through);
}

TEST(GeometricSphere, IsDarkerByWhatItsWaterAbsorbs) {
  const auto edges = even_edges(180);
  const double x = 2e4, k = 1e-7;  // weak: absorbed share of first order in k
  const GeometricSphere clear = geometric_sphere(x, 1.333, edges, 20),
                        dim = geometric_sphere(x, {1.333, k}, edges, 20);
  // Bohren & Huffman 1983, equation 7.2: (4/3) (2 k x) (n^3 - (n^2 - 1)^1.5) / n
  const double n = 1.333, expected = 8.0 / 3 * k * x / n * (n * n * n - std::pow(n * n - 1, 1.5));
  EXPECT_NEAR((clear.efficiencies.scattering - dim.efficiencies.scattering) / expected, 1, 0.01);
}

// n of water by Daimon & Masumura relative to air; radii computed independently from the same data.
TEST(Bows, OfWaterStandWhereTheyShould) {
  const RefractiveIndex water = RefractiveIndex::water();
  const double nm[] = {700, 656, 589, 550, 486, 450, 400};
  const double primary[] = {42.49, 42.35, 42.08, 41.89, 41.48, 41.18, 40.62};
  const double secondary[] = {50.14, 50.40, 50.89, 51.24, 51.97, 52.51, 53.53};
  for (int i = 0; i < 7; ++i) {
    const double n = water.relative_to_air(nm[i]).real();
    EXPECT_NEAR(bow_radius_deg(2, n), primary[i], 5.1e-3 + 2e-3) << nm[i];
    EXPECT_NEAR(bow_radius_deg(3, n), secondary[i], 5.1e-3 + 2e-3) << nm[i];
  }
}

TEST(RaysOfOrder, FindTheRayThatIsTurnedByAGivenAngle) {
  for (int p = 0; p <= 9; ++p) {
    const RaysOfOrder rays(p, 1.333);
    const double bow = rays.bow_incidence_rad().value_or(0);
    for (double incidence = 0.01; incidence < 0.5 * pi; incidence += 0.0371) {
      const bool outer = incidence >= bow;
      const auto found =
          rays.incidence_of(rays.turned_rad(incidence), outer ? bow : 0, outer ? 0.5 * pi : bow);
      ASSERT_TRUE(found) << p << " " << incidence;
      EXPECT_NEAR(*found, incidence, 1e-7) << p;
    }
    if (bow > 0) {
      EXPECT_NEAR(rays.turned_slope(bow), 0, 1e-12);
      EXPECT_FALSE(rays.incidence_of(rays.turned_rad(bow) - 1e-6, 0, bow));
    }
  }
}

TEST(RaysOfOrder, HaveTheSlopesOfTheirTurn) {
  const RaysOfOrder rays(3, 1.333);
  for (double t = 0.05; t < 1.5; t += 0.1) {
    const double h = 1e-5;
    EXPECT_NEAR(rays.turned_slope(t), (rays.turned_rad(t + h) - rays.turned_rad(t - h)) / (2 * h),
                1e-7);
    EXPECT_NEAR(rays.turned_curvature(t),
                (rays.turned_slope(t + h) - rays.turned_slope(t - h)) / (2 * h), 1e-6);
  }
}

}  // namespace arcus::phase
