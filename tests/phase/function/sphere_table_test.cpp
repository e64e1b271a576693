#include "phase/function/sphere_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "phase/optics/sun_disc.h"
#include "tests/phase/function/synthetic_drops.h"
#include "tests/statistics/cells.h"
#include "tests/statistics/chi_square.h"
#include "tests/statistics/moments.h"
#include "tests/statistics/seed.h"
#include "tests/statistics/students_t.h"

namespace arcus::phase {

namespace {

using statistics::test_seed;

constexpr double sun_radius_rad = radians(mean_sun_radius_deg);

Wavelengths all_at(double nm) {
  Wavelengths wavelengths;
  wavelengths.nm.fill(static_cast<float>(nm));
  return wavelengths;
}

std::vector<double> angles_deg(const SphereTable& table) {
  std::vector<double> result;
  for (int i = 0; i < table.angle_count(); ++i)
    result.push_back(degrees(2 * std::atan2(std::sqrt(table.angle(i).sin2), std::sqrt(table.angle(i).cos2))));
  return result;
}

/// Values at the angle nodes.
template <class Value>
std::vector<double> at_nodes(const SphereTable& table, Value value) {
  std::vector<double> result;
  for (int i = 0; i < table.angle_count(); ++i) result.push_back(value(table.angle(i)));
  return result;
}

}  // namespace

class SphereTableOfDrops : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    drops_ = new ScatteringTable(synthetic_table({10, 200}, wavelengths_nm(380, 780, 20), 8));
    SphereTableOptions options;
    options.sun_angular_radius_rad = sun_radius_rad;
    options.wavelength_nodes = 101;
    table_ = new SphereTable(*drops_, options);
  }
  static void TearDownTestSuite() {
    delete table_;
    delete drops_;
  }
  static const SphereTable& table() { return *table_; }
  static const ScatteringTable& drops() { return *drops_; }

 private:
  static inline const ScatteringTable* drops_ = nullptr;
  static inline const SphereTable* table_ = nullptr;
};

TEST_F(SphereTableOfDrops, IntegratesToOneAtEverySizeAndFineWavelength) {
  const auto angles = angles_deg(table());
  double worst = 0, worst_sunlit = 0;
  for (int size = 0; size < table().size_count(); ++size)
    for (int k = 0; k < table().wavelengths().count(); ++k) {
      const Wavelengths at = all_at(table().wavelengths().wavelength_nm(k));
      const auto p = at_nodes(table(), [&](HalfAngle a) { return table().value_per_sr(size, a, at)[0]; });
      const auto q =
          at_nodes(table(), [&](HalfAngle a) { return table().sunlit_value_per_sr(size, a, at)[0]; });
      worst = std::max(worst, std::fabs(integral_over_sphere(angles, p) - 1));
      worst_sunlit = std::max(worst_sunlit, std::fabs(integral_over_sphere(angles, q) - 1));
    }
  EXPECT_LT(worst, 1e-6);
  EXPECT_LT(worst_sunlit, 1e-6);
}

TEST_F(SphereTableOfDrops, IsNeverNegative) {
  Random random(test_seed(), 0, 0);
  for (int i = 0; i < 100000; ++i) {
    const HalfAngle angle = half_angle_of_rad(pi * random.uniform_double());
    const Wavelengths at = draw_wavelengths(random.uniform());
    EXPECT_GE(table().value_per_sr(i % 2, angle, at).min(), 0);
    EXPECT_GE(table().sunlit_value_per_sr(i % 2, angle, at).min(), 0);
  }
}

// With nodes 10 nm apart within 0.5 %.
TEST(SphereTable, MeetsTheTruthAtRandomAnglesAndWavelengths) {
  const double size_um = 100;
  const SyntheticDrops drops(size_um);
  SphereTableOptions options;
  options.clip_forward_lobe = false;
  const SphereTable table(synthetic_table({size_um}, wavelengths_nm(380, 780, 10)), options);
  const auto angles = synthetic_angles_deg();
  Random random(test_seed(), 0, 0);
  for (int j = 0; j < 20; ++j) {
    const double nm = 380 + 400 * random.uniform_double();
    std::vector<double> shape;
    for (const double angle : angles) shape.push_back(drops.shape(angle, nm));
    const double whole = integral_over_sphere(angles, shape);
    for (int i = 0; i < 500; ++i) {
      // Half of the angles in the bows.
      const double deg = i % 2 ? 180 * random.uniform_double() : 124 + 20 * random.uniform_double();
      const double found = table.value_per_sr(0, half_angle_of_rad(radians(deg)), all_at(nm))[0];
      EXPECT_NEAR(found / (drops.shape(deg, nm) / whole), 1, 0.005) << deg << " deg, " << nm << " nm";
    }
  }
}

TEST_F(SphereTableOfDrops, GivesFourWavelengthsAsOneByOne) {
  const Wavelengths four{{400.3f, 455.5f, 555.1f, 699.9f}};
  for (const double deg : {0.0, 1e-4, 0.5, 2.0, 89.999, 90.001, 138.5, 179.0, 179.9999, 180.0}) {
    const HalfAngle angle = half_angle_of_rad(radians(deg));
    for (int i = 0; i < 4; ++i) {
      EXPECT_FLOAT_EQ(table().value_per_sr(1, angle, four)[i],
                      table().value_per_sr(1, angle, all_at(four[i]))[0]);
      EXPECT_FLOAT_EQ(table().sunlit_value_per_sr(1, angle, four)[i],
                      table().sunlit_value_per_sr(1, angle, all_at(four[i]))[0]);
    }
  }
}

TEST_F(SphereTableOfDrops, IsLinearInSinSquaredBetweenNodes) {
  // Also in the last interval before 180°, where 1 − s has few digits left.
  const Wavelengths at = all_at(550);
  for (const int i : {0, 1, 100, 300, 500, table().angle_count() - 3, table().angle_count() - 2}) {
    const HalfAngle a = table().angle(i), b = table().angle(i + 1);
    const HalfAngle middle{0.75 * a.sin2 + 0.25 * b.sin2, 0.75 * a.cos2 + 0.25 * b.cos2};
    const double expected =
        0.75 * table().value_per_sr(0, a, at)[0] + 0.25 * table().value_per_sr(0, b, at)[0];
    EXPECT_NEAR(table().value_per_sr(0, middle, at)[0] / expected, 1, 2e-6) << "interval " << i;
  }
}

TEST_F(SphereTableOfDrops, TakesTheEndsBeyondItsWavelengths) {
  const HalfAngle angle = half_angle_of_rad(radians(140));
  EXPECT_FLOAT_EQ(table().value_per_sr(0, angle, all_at(200))[0],
                  table().value_per_sr(0, angle, all_at(380))[0]);
  EXPECT_FLOAT_EQ(table().value_per_sr(0, angle, all_at(2000))[0],
                  table().value_per_sr(0, angle, all_at(780))[0]);
}

TEST_F(SphereTableOfDrops, KeepsTheLobeOfSmallDropsAndClipsThatOfLargeOnes) {
  const Wavelengths at = all_at(540);
  const HalfAngle edge = half_angle_of_rad(radians(1)), straight{0, 1};
  EXPECT_GT(table().value_per_sr(0, straight, at)[0], 100 * table().value_per_sr(0, half_angle_of_rad(radians(10)), at)[0]);
  EXPECT_NEAR(table().value_per_sr(1, straight, at)[0] / table().value_per_sr(1, edge, at)[0], 1, 1e-5);
  // Beyond the lobe the clipped function is the complete one over 1 − forward_fraction, which at a
  // node of the coarse wavelengths is known.
  SphereTableOptions unclipped;
  unclipped.clip_forward_lobe = false;
  unclipped.wavelength_nodes = 101;
  const SphereTable complete(drops(), unclipped);
  const HalfAngle beyond = half_angle_of_rad(radians(30));
  const double kept = 1 - drops().forward_fraction[drops().row(1, 0)];
  EXPECT_NEAR(table().value_per_sr(1, beyond, all_at(380))[0] * kept /
                  complete.value_per_sr(0 + 1, beyond, all_at(380))[0],
              1, 1e-5);
}

TEST_F(SphereTableOfDrops, HasTheAsymmetryOfItsRows) {
  // At the first coarse node, lobe kept: what the table of the particles says.
  EXPECT_NEAR(table().asymmetry(0, 0), drops().asymmetry[drops().row(0, 0)], 1e-6);
  const int last = table().wavelengths().count() - 1;
  EXPECT_NEAR(table().asymmetry(0, last), drops().asymmetry[drops().row(0, 20)], 1e-6);
}

TEST_F(SphereTableOfDrops, DrawsAnglesWithTheMeanCosineOfItsRow) {
  for (int size = 0; size < 2; ++size) {
    Random random(test_seed(size), 0, 0);
    const int node = 37;
    const Wavelengths at = all_at(table().wavelengths().wavelength_nm(node));
    statistics::Moments cosines;
    for (int i = 0; i < 300000; ++i) cosines.add(table().draw(size, at, random).angle.cosine());
    EXPECT_TRUE(statistics::mean_is(cosines, table().asymmetry(size, node),
                                    {.comparisons = 2, .tolerance = 1e-6}));
  }
}

TEST_F(SphereTableOfDrops, DrawsHaveTheValueOfTheirAngle) {
  Random random(test_seed(), 0, 0);
  for (int i = 0; i < 20000; ++i) {
    const Wavelengths at = draw_wavelengths(random.uniform());
    const auto drawn = table().draw(i % 2, at, random);
    const Spectrum value = table().value_per_sr(i % 2, drawn.angle, at);
    for (int j = 0; j < 4; ++j) EXPECT_NEAR(drawn.value_per_sr[j] / value[j], 1, 1e-5);
    EXPECT_NEAR(drawn.angle.sin2 + drawn.angle.cos2, 1, 1e-15);
  }
}

namespace {

/// Draws angles of one size against a density per unit of s that is tilted by `tilt` × cos θ.
testing::AssertionResult draws_follow(const SphereTable& table, int size, double nm, double tilt) {
  std::vector<double> breaks;
  for (int i = 0; i < table.angle_count(); ++i) breaks.push_back(table.angle(i).sin2);
  const double g = [&] {
    const auto p = at_nodes(table, [&](HalfAngle a) { return table.value_per_sr(size, a, all_at(nm))[0]; });
    return mean_cosine(angles_deg(table), p);
  }();
  const statistics::IntervalCells cells(
      [&](double s) {
        const double p = table.value_per_sr(size, {s, 1 - s}, all_at(nm))[0];
        return 4 * pi * p * (1 + tilt * (1 - 2 * s)) / (1 + tilt * g);
      },
      0, 1, 50, breaks);
  statistics::Tally tally(cells);
  Random random(test_seed(size), 0, 0);
  for (int i = 0; i < 1000000; ++i) tally.add(table.draw(size, all_at(nm), random).angle.sin2);
  return statistics::chi_square(tally, 2);
}

}  // namespace

// Between two nodes of the fine grid, so that the mixture of two rows is what is tested.
TEST_F(SphereTableOfDrops, DrawsFollowTheDensity) {
  EXPECT_TRUE(draws_follow(table(), 0, 553.3, 0));
  EXPECT_TRUE(draws_follow(table(), 1, 553.3, 0));
}

TEST_F(SphereTableOfDrops, DrawsDoNotFollowADensityTiltedByTwoPercent) {
  EXPECT_FALSE(draws_follow(table(), 0, 553.3, 0.02));
  EXPECT_FALSE(draws_follow(table(), 1, 553.3, 0.02));
}

// Cells of equal probability never look closely at where hardly anything goes.
TEST_F(SphereTableOfDrops, DrawsFollowTheDensityAlsoInTheGloryAndTheDarkBand) {
  const double nm = table().wavelengths().wavelength_nm(50);
  for (const auto& [from_deg, to_deg] : {std::pair{170.0, 180.0}, std::pair{131.0, 135.0}}) {
    const double from = sin2_half_deg(from_deg), to = sin2_half_deg(to_deg);
    std::vector<double> breaks;
    for (int i = 0; i < table().angle_count(); ++i) breaks.push_back(table().angle(i).sin2);
    const auto density = [&](double s) {
      return 4 * pi * table().value_per_sr(0, {s, 1 - s}, all_at(nm))[0];
    };
    const statistics::IntervalCells whole(density, from, to, 4000, breaks);
    const auto& parts = whole.probabilities();
    const double share = std::accumulate(parts.begin(), parts.end(), 0.0);
    const statistics::IntervalCells cells([&](double s) { return density(s) / share; }, from, to, 20, breaks);
    statistics::Tally tally(cells);
    Random random(test_seed(), 0, 0);
    int inside = 0;
    const int draws = 1000000;
    for (int i = 0; i < draws; ++i) {
      const double s = table().draw(0, all_at(nm), random).angle.sin2;
      if (s < from || s > to) continue;
      tally.add(s);
      ++inside;
    }
    EXPECT_NEAR(inside, draws * share, 5 * std::sqrt(draws * share));
    EXPECT_TRUE(statistics::chi_square(tally, 2)) << from_deg << " deg";
  }
}

TEST(SphereTable, LeavesTheIsotropicFunctionIsotropicUnderTheSunsDisc) {
  SphereTableOptions options;
  options.sun_angular_radius_rad = sun_radius_rad;
  const SphereTable table(isotropic_table(), options);
  for (const double deg : {0.0, 0.05, 0.2666, 1.0, 45.0, 90.0, 179.8, 180.0}) {
    const Spectrum value =
        table.sunlit_value_per_sr(0, half_angle_of_rad(radians(deg)), {{390, 450, 550, 650}});
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(value[i] * 4 * pi, 1, 1e-6) << deg;
  }
}

TEST(SphereTable, UnderAMoonIsTheMeanOverAUniformDisc) {
  const ScatteringTable drops = synthetic_table({200}, wavelengths_nm(380, 780, 20), 8);
  SphereTableOptions options;
  options.sun_angular_radius_rad = 10 * sun_radius_rad;
  options.wavelength_nodes = 21;
  const SphereTable sun(drops, options);
  options.disc = DiscKind::uniform;
  const SphereTable moon(drops, options);
  const Wavelengths at = {{550, 550, 550, 550}};
  // Straight on, equal areas of the disc are equal steps of sin2(angle / 2).
  const double s_disc = std::pow(std::sin(10 * sun_radius_rad / 2), 2);
  double mean = 0;
  constexpr int steps = 20000;
  for (int i = 0; i < steps; ++i) {
    const double s = s_disc * (i + 0.5) / steps;
    mean += moon.value_per_sr(0, HalfAngle{s, 1 - s}, at)[0] / steps;
  }
  EXPECT_NEAR(moon.sunlit_value_per_sr(0, HalfAngle{0, 1}, at)[0] / mean, 1, 3e-3) << "linear between the nodes of angle and wavelength";
  double largest = 0;
  for (int i = 0; i < moon.angle_count(); ++i) {
    const float ratio = sun.sunlit_value_per_sr(0, moon.angle(i), at)[0] / moon.sunlit_value_per_sr(0, moon.angle(i), at)[0];
    largest = std::max(largest, std::fabs(static_cast<double>(ratio) - 1));
  }
  EXPECT_GT(largest, 0.02) << "the sun's disc is brightest in the middle";
}

TEST(SphereTable, WithoutASunMakesNoSunlitValues) {
  EXPECT_FALSE(SphereTable(isotropic_table()).includes_sun_disc());
}

TEST(SphereTable, OfOneWavelengthIsGrey) {
  ScatteringTable drops = synthetic_table({10}, {550}, 8);
  const SphereTable table(drops);
  const Spectrum value = table.value_per_sr(0, half_angle_of_rad(2), {{380, 500, 600, 780}});
  EXPECT_GT(value[0], 0);
  for (int i = 1; i < 4; ++i) EXPECT_FLOAT_EQ(value[i], value[0]);
}

TEST(SphereTable, NeverDrawsWhereItsValueIsZero) {
  ScatteringTable ring = isotropic_table();
  // Zero but for 40 to 90°, at both ends of the range of probabilities.
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 6; ++i) ring.p11[6 * j + i] = i == 2 || i == 3 ? 1 : 0;
  const SphereTable table(ring);
  Random random(test_seed(), 0, 0);
  for (int i = 0; i < 100000; ++i) {
    const auto drawn = table.draw(0, {{450, 500, 550, 600}}, random);
    EXPECT_GT(drawn.value_per_sr[0], 0);
    EXPECT_TRUE(std::isfinite(drawn.angle.sin2));
  }
}

TEST(SphereTable, KeepsToItsMemory) {
  SphereTableOptions options;
  options.sun_angular_radius_rad = sun_radius_rad;
  options.largest_memory_bytes = 8'000'000;
  const SphereTable table(synthetic_table({1000}, wavelengths_nm(380, 780, 20), 4), options);
  EXPECT_LT(table.memory_bytes(), 8'200'000u);
  EXPECT_GT(table.memory_bytes(), 6'000'000u);
}

}  // namespace arcus::phase
