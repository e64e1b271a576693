#include "phase/particle/large_drop.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "phase/base/error.h"
#include "phase/base/units.h"
#include "phase/particle/mie_block.h"
#include "phase/population/sizes.h"
#include "tests/phase/particle/debye_sum.h"

namespace arcus::phase {
namespace {

std::vector<double> angles_between(double first_deg, double last_deg, double step_deg) {
  std::vector<double> angles;
  for (double angle = first_deg; angle < last_deg + 1e-9; angle += step_deg)
    angles.push_back(std::min(radians(angle), pi));
  return angles;
}

struct Products {
  std::vector<double> i11, i12, i33, i34;
  explicit Products(std::size_t angles) : i11(angles), i12(angles), i33(angles), i34(angles) {}
  void add(const DebyeSum& sum, std::size_t order) {
    for (std::size_t a = 0; a < i11.size(); ++a) {
      const auto s1 = sum.s1[order][a], s2 = sum.s2[order][a], mixed = s2 * std::conj(s1);
      i11[a] += 0.5 * (std::norm(s1) + std::norm(s2));
      i12[a] += 0.5 * (std::norm(s2) - std::norm(s1));
      i33[a] += mixed.real();
      i34[a] += mixed.imag();
    }
  }
};

/// Largest error of any element over the light of all orders together.
double worst(const SphereIntensities& found, const Products& expected, const Products& all) {
  double most = 0;
  for (std::size_t a = 0; a < all.i11.size(); ++a)
    for (const double error : {found.i11[a] - expected.i11[a], found.i12[a] - expected.i12[a],
                               found.i33[a] - expected.i33[a], found.i34[a] - expected.i34[a]})
      most = std::max(most, std::fabs(error) / all.i11[a]);
  return most;
}

/// Means over a gamma distribution of sizes, times the mean squared size parameter. Waves take
/// thousands of sizes, large drops few.
struct Mean {
  std::vector<double> i11, i12, i33, i34;
  double extinction = 0, asymmetry = 0;
};
constexpr double mean_size_parameter = 1500, mean_variance = 0.05;

std::vector<double> size_grid(int count) {
  const Sizes sizes({.type = "gamma", .variance = mean_variance}, mean_size_parameter);
  const auto range = sizes.range_um(1e-3);
  std::vector<double> grid;
  for (int i = 0; i < count; ++i)
    grid.push_back(range.low_um * std::pow(range.high_um / range.low_um, i / (count - 1.0)));
  return grid;
}

void add(Mean& mean, double weight, double x, const SphereEfficiencies& q, double& area,
         double& power) {
  area += weight * x * x;
  power += weight * x * x * q.scattering;
  mean.extinction += weight * x * x * q.extinction;
  mean.asymmetry += weight * x * x * q.scattering * q.asymmetry;
}

void finish(Mean& mean, double area, double power) {
  for (auto* column : {&mean.i11, &mean.i12, &mean.i33, &mean.i34})
    for (double& value : *column) value /= area;
  mean.extinction /= area;
  mean.asymmetry /= power;
}

Mean mean_of_waves(std::complex<double> m, std::span<const double> angles, int count) {
  const auto x = size_grid(count);
  const auto weight =
      Sizes({.type = "gamma", .variance = mean_variance}, mean_size_parameter).weights(x);
  const MieAngles prepared(angles, x.back());
  std::vector<float> matrix(mie_block_radii * mie_block_elements * angles.size());
  std::vector<SphereEfficiencies> q(mie_block_radii);
  Mean mean;
  for (auto* column : {&mean.i11, &mean.i12, &mean.i33, &mean.i34}) column->resize(angles.size());
  double area = 0, power = 0;
  for (std::size_t first = 0; first < x.size(); first += mie_block_radii) {
    const std::size_t here = std::min<std::size_t>(mie_block_radii, x.size() - first);
    mie_block(prepared, std::span(x).subspan(first, here), m,
              std::span(matrix).first(here * mie_block_elements * angles.size()),
              std::span(q).first(here));
    for (std::size_t i = 0; i < here; ++i) {
      add(mean, weight[first + i], x[first + i], q[i], area, power);
      const float* row = &matrix[i * mie_block_elements * angles.size()];
      for (auto* column : {&mean.i11, &mean.i12, &mean.i33, &mean.i34}) {
        for (std::size_t a = 0; a < angles.size(); ++a) (*column)[a] += weight[first + i] * row[a];
        row += angles.size();
      }
    }
  }
  finish(mean, area, power);
  return mean;
}

Mean mean_of_large_drops(std::complex<double> m, std::span<const double> angles, int count,
                         DebyeOrders orders = {}) {
  const auto x = size_grid(count);
  const auto weight =
      Sizes({.type = "gamma", .variance = mean_variance}, mean_size_parameter).weights(x);
  LargeDrop drop(m, angles);
  Mean mean;
  for (auto* column : {&mean.i11, &mean.i12, &mean.i33, &mean.i34}) column->resize(angles.size());
  double area = 0, power = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const SphereIntensities sphere = drop.scatter(x[i], x[1] / x[0] - 1, orders);
    add(mean, weight[i], x[i], sphere.efficiencies, area, power);
    for (std::size_t a = 0; a < angles.size(); ++a) {
      mean.i11[a] += weight[i] * sphere.i11[a];
      mean.i12[a] += weight[i] * sphere.i12[a];
      mean.i33[a] += weight[i] * sphere.i33[a];
      mean.i34[a] += weight[i] * sphere.i34[a];
    }
  }
  finish(mean, area, power);
  return mean;
}

/// Mean of |found/expected - 1| and the largest, over angles in a range.
struct Error {
  double mean = 0, worst = 0;
};
Error error_between(std::span<const double> angles, const std::vector<double>& found,
                    const std::vector<double>& expected, double first_deg, double last_deg) {
  Error error;
  int count = 0;
  for (std::size_t a = 0; a < angles.size(); ++a) {
    if (angles[a] < radians(first_deg) || angles[a] > radians(last_deg)) continue;
    const double e = found[a] / expected[a] - 1;
    error.mean += e;
    error.worst = std::max(error.worst, std::fabs(e));
    ++count;
  }
  error.mean /= count;
  return error;
}

/// Place of the largest value in a range, by a parabola through its neighbours.
double peak_deg(std::span<const double> angles, const std::vector<double>& values, double first_deg,
                double last_deg) {
  std::size_t best = 0;
  for (std::size_t a = 1; a + 1 < angles.size(); ++a)
    if (angles[a] >= radians(first_deg) && angles[a] <= radians(last_deg) &&
        (best == 0 || values[a] > values[best]))
      best = a;
  const double before = values[best - 1], here = values[best], after = values[best + 1];
  const double offset = 0.5 * (before - after) / (before - 2 * here + after);
  return degrees(angles[best] + offset * (angles[best + 1] - angles[best]));
}

/// Angles of the comparison with waves: few where nothing happens, many in the bows.
std::vector<double> comparison_angles() {
  std::vector<double> angles = angles_between(0, 2, 0.02);
  for (const auto& part : {angles_between(2.5, 118, 1.5), angles_between(119, 127, 0.25),
                           angles_between(127.1, 146, 0.05), angles_between(146.5, 177, 0.5),
                           angles_between(177.2, 180, 0.05)})
    angles.insert(angles.end(), part.begin(), part.end());
  return angles;
}

std::string refusal(const auto& act) {
  try {
    act();
  } catch (const arcus::Error& error) {
    EXPECT_EQ(error.fault(), Fault::input);
    return error.what();
  }
  return "no error";
}

}  // namespace

TEST(LargeDrop, EachOrderIsTheSumOfItsPartialWaves) {
  const auto angles = angles_between(0, 180, 0.45);
  for (const double x : {1000.0, 2000.0}) {
    const DebyeSum sum = debye_sum(x, 1.333, 24, angles);
    Products all(angles.size()), late(angles.size());
    for (std::size_t order = 0; order < sum.s1.size(); ++order) {
      all.add(sum, order);
      if (order >= 4) late.add(sum, order);
    }
    LargeDrop drop(1.333, angles);
    for (int order = 0; order < 4; ++order) {
      Products expected(angles.size());
      expected.add(sum, static_cast<std::size_t>(order));
      EXPECT_LT(worst(drop.scatter(x, 0, {order, order}), expected, all), 10 / x)
          << "order " << order << " at x " << x;
    }
    // Later orders are powers without the interference of their two bow rays, and the orders beyond
    // 24 are added.
    const SphereIntensities found = drop.scatter(x, 0, {4, 100});
    double error = 0;
    for (std::size_t a = 0; angles[a] < radians(172); ++a)
      error = std::max(error, std::fabs(found.i11[a] - late.i11[a]) / all.i11[a]);
    EXPECT_LT(error, 0.03) << x;
  }
}

TEST(LargeDrop, EachOrderIsTheSumOfItsPartialWavesWhereBowsAreRays) {
  const double x = 3e4;
  std::vector<double> angles = angles_between(0.05, 1, 0.05);
  for (const auto& part : {angles_between(5, 120, 5), angles_between(126, 130, 0.1),
                           angles_between(137, 141, 0.05), angles_between(145, 179, 2)})
    angles.insert(angles.end(), part.begin(), part.end());
  const DebyeSum sum = debye_sum(x, 1.333, 8, angles);
  Products all(angles.size());
  for (std::size_t order = 0; order < sum.s1.size(); ++order) all.add(sum, order);
  LargeDrop drop(1.333, angles);
  for (int order = 0; order < 4; ++order) {
    Products expected(angles.size());
    expected.add(sum, static_cast<std::size_t>(order));
    EXPECT_LT(worst(drop.scatter(x, 0, {order, order}), expected, all), 0.01) << "order " << order;
  }
}

class LargeDropAgainstWaves : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    angles = comparison_angles();
    waves = mean_of_waves(1.333, angles, 4800);
    drops = mean_of_large_drops(1.333, angles, 60);
  }
  static std::vector<double> angles;
  static Mean waves, drops;
};
std::vector<double> LargeDropAgainstWaves::angles;
Mean LargeDropAgainstWaves::waves, LargeDropAgainstWaves::drops;

// The worst single angles are what 4800 waves leave of their resonances; the means show what the
// method errs.
TEST_F(LargeDropAgainstWaves, AgreesInEveryRegion) {
  struct Region {
    double first_deg, last_deg, mean, worst;
  };
  for (const Region& region :
       {Region{0, 2, 0.001, 0.004}, Region{2, 40, 0.002, 0.015}, Region{40, 80, 0.003, 0.03},
        Region{80, 118, 0.006, 0.04}, Region{118, 127, 0.006, 0.03}, Region{127, 130, 0.005, 0.03},
        Region{130, 136.5, 0.005, 0.03}, Region{136.5, 146, 0.002, 0.02},
        Region{146, 165, 0.004, 0.03}, Region{165, 177, 0.006, 0.04},
        Region{177, 180, 0.08, 0.2}}) {
    const Error error =
        error_between(angles, drops.i11, waves.i11, region.first_deg, region.last_deg);
    EXPECT_LT(std::fabs(error.mean), region.mean) << region.first_deg << " ... " << region.last_deg;
    EXPECT_LT(error.worst, region.worst) << region.first_deg << " ... " << region.last_deg;
  }
}

TEST_F(LargeDropAgainstWaves, PutsBowsAndSupernumerariesInTheirPlaces) {
  for (const auto& [first, last] :
       {std::pair{137.0, 139.5}, std::pair{127.5, 130.5}, std::pair{139.5, 141.6}})
    EXPECT_NEAR(peak_deg(angles, drops.i11, first, last), peak_deg(angles, waves.i11, first, last),
                0.02)
        << first;
}

TEST_F(LargeDropAgainstWaves, PolarisesAsWavesDo) {
  for (std::size_t a = 0; a < angles.size(); ++a) {
    if (angles[a] > radians(177)) continue;
    EXPECT_NEAR(drops.i12[a] / drops.i11[a], waves.i12[a] / waves.i11[a], 0.03)
        << degrees(angles[a]);
    EXPECT_NEAR(drops.i33[a] / drops.i11[a], waves.i33[a] / waves.i11[a], 0.03)
        << degrees(angles[a]);
    EXPECT_NEAR(drops.i34[a] / drops.i11[a], waves.i34[a] / waves.i11[a], 0.04)
        << degrees(angles[a]);
  }
}

TEST_F(LargeDropAgainstWaves, HasTheirEfficiencies) {
  EXPECT_NEAR(drops.extinction, waves.extinction, 1e-4);
  EXPECT_NEAR(drops.asymmetry, waves.asymmetry, 3e-4);
}

TEST_F(LargeDropAgainstWaves, WouldNoticeAWrongIndexAndAWrongAiryFactor) {
  // An index wrong by 0.0005 moves the bow by 0.07 degrees; 3 % of order 2 left out shows in its
  // region.
  const Mean other = mean_of_large_drops(1.3335, angles, 60);
  EXPECT_GT(
      std::fabs(peak_deg(angles, other.i11, 137, 139.5) - peak_deg(angles, waves.i11, 137, 139.5)),
      0.02);
  const Mean bow = mean_of_large_drops(1.333, angles, 60, {2, 2});
  Mean less = drops;
  for (std::size_t a = 0; a < angles.size(); ++a) less.i11[a] -= 0.03 * bow.i11[a];
  EXPECT_GT(std::fabs(error_between(angles, less.i11, waves.i11, 136.5, 146).mean), 0.002);
}

TEST(LargeDrop, DimsAsWavesDo) {
  const auto angles = angles_between(1, 176, 5);
  const std::complex<double> m(1.333, 3e-5);
  const Mean waves = mean_of_waves(m, angles, 1600), drops = mean_of_large_drops(m, angles, 60);
  const Error error = error_between(angles, drops.i11, waves.i11, 0, 180);
  EXPECT_LT(std::fabs(error.mean), 0.004);
  EXPECT_LT(error.worst, 0.05);
}

TEST(LargeDrop, AbsorbsWhatRaysAbsorb) {
  const double x = 5e3, k = 1e-6, n = 1.333;
  LargeDrop drop({n, k}, std::vector<double>{1});
  const SphereEfficiencies q = drop.scatter(x, 0.01).efficiencies;
  const double rays =
      8.0 / 3 * k * x / n *
      (n * n * n - std::pow(n * n - 1, 1.5));  // Bohren & Huffman 1983, equation 7.2
  EXPECT_NEAR((q.extinction - q.scattering) / rays, 1, 0.03);
}

// H. M. Nussenzveig and W. J. Wiscombe, Phys. Rev. Lett. 45, 1490 (1980): the edge's extinction at
// real index.
TEST(LargeDrop, ExtinctionHasTheEdgeOfNussenzveigAndWiscombe) {
  LargeDrop drop(1.333, std::vector<double>{1});
  for (double x = 1000; x < 1e5; x *= 3) {
    const double expected =
        2 + 1.9923861 * std::pow(x, -2.0 / 3) - 0.7153537 * std::pow(x, -4.0 / 3);
    EXPECT_NEAR(drop.scatter(x, 0.01).efficiencies.extinction, expected, 10 * std::pow(x, -5.0 / 3))
        << x;
  }
}

TEST(LargeDrop, ScattersAsMuchOverTheSphereAsItsEfficiencySays) {
  std::vector<double> angles = angles_between(0, 2, 0.002);
  for (const auto& part : {angles_between(2.01, 10, 0.01), angles_between(10.05, 177, 0.05),
                           angles_between(177.005, 180, 0.005)})
    angles.insert(angles.end(), part.begin(), part.end());
  LargeDrop drop(1.333, angles);
  for (const double x : {800.0, 3000.0}) {
    const SphereIntensities sphere = drop.scatter(x, 0.02);
    double sum = 0;
    for (std::size_t a = 0; a + 1 < angles.size(); ++a)
      sum += (sphere.i11[a] * std::sin(angles[a]) + sphere.i11[a + 1] * std::sin(angles[a + 1])) *
             pi * (angles[a + 1] - angles[a]);
    EXPECT_NEAR(sum / (pi * x * x) / sphere.efficiencies.scattering, 1, 1e-3) << x;
  }
}

// van de Hulst 1957, section 13.23: the first maximum of Airy's rainbow; its corrections vanish
// with the size.
TEST(LargeDrop, ItsBowTendsToAirys) {
  const double n = 1.333, x = 1e5, h = 2.25 * std::sqrt((4 - n * n) / std::pow(n * n - 1, 3));
  const RaysOfOrder rays(2, n);
  const double bow_deg = degrees(rays.turned_rad(*rays.bow_incidence_rad()));
  const auto angles = angles_between(bow_deg, bow_deg + 0.1, 0.002);
  const SphereIntensities sphere = LargeDrop(n, angles).scatter(x, 0, {2, 2});
  const double expected = bow_deg + degrees(1.0188 * std::cbrt(h / (x * x)));
  EXPECT_NEAR(peak_deg(angles, sphere.i11, bow_deg, bow_deg + 0.09), expected, 1e-3);
}

TEST(LargeDrop, AveragesFringesThatSizesDoNotResolve) {
  // Beyond the bow the two rays of order 2 beat with the size: a coarse step leaves their sum, also
  // where partial waves stand for both.
  struct Case {
    double n, size_parameter, angle_deg;
    bool is_all_waves;
    double tolerance;
  };
  // In the smallest spheres the fringe is so slow that the two weights, hat and cosine, leave different shares of it.
  for (const Case& c : {Case{1.333, 20000, 142, false, 0.01}, Case{1.5, 600, 172, true, 0.025}}) {
    LargeDrop drop(c.n, std::vector<double>{radians(c.angle_deg)});
    ASSERT_EQ(edge_window(RaysOfOrder(2, c.n), c.n, c.size_parameter).everything, c.is_all_waves);
    double mean = 0, weights = 0, least = 1e300, most = 0;
    constexpr int count = 60;
    for (int i = 0; i < count; ++i) {
      const double x = c.size_parameter * (1 + 2e-3 * i);
      const double value = drop.scatter(x, 0, {2, 2}).i11[0] / (x * x);
      const double weight = 1 - std::cos(2 * pi * (i + 0.5) / count);
      mean += weight * value;
      weights += weight;
      least = std::min(least, value);
      most = std::max(most, value);
    }
    EXPECT_GT(most / least, 1.3) << c.n;
    const double x = c.size_parameter * (1 + 1e-3 * count);
    const double coarse = drop.scatter(x, 0.08, {2, 2}).i11[0] / (x * x);
    EXPECT_NEAR(coarse / (mean / weights), 1, c.tolerance) << c.n;
  }
}

TEST(LargeDrop, RemembersNothingOfTheSizeBefore) {
  const auto angles = angles_between(0, 180, 3);
  LargeDrop drop(1.333, angles);
  const auto first = drop.scatter(1500, 0.01);
  drop.scatter(40000, 0.02);
  LargeDrop copy = drop;
  EXPECT_EQ(drop.scatter(1500, 0.01).i11, first.i11);
  EXPECT_EQ(copy.scatter(1500, 0.01).i34, first.i34);
}

TEST(LargeDrop, RefusesWhatItIsNotFor) {
  const std::vector<double> angles{1};
  EXPECT_NE(refusal([&] { LargeDrop(1.1, angles); }).find("between 1.2 and 1.7"),
            std::string::npos);
  EXPECT_NE(refusal([&] { LargeDrop({1.333, 0.1}, angles); }).find("0.001"), std::string::npos);
  EXPECT_NE(refusal([&] { LargeDrop(1.333, std::vector<double>{4}); }).find("pi"),
            std::string::npos);
  LargeDrop drop(1.333, angles);
  EXPECT_NE(refusal([&] { drop.scatter(100, 0); }).find("size parameter 100"), std::string::npos);
  EXPECT_NE(refusal([&] { drop.scatter(std::nan(""), 0); }), "no error");
}

}  // namespace arcus::phase
