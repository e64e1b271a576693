#include "phase/function/wavelength_interpolation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/phase/function/synthetic_drops.h"

namespace arcus::phase {

namespace {

constexpr double first_nm = 380, last_nm = 780;

/// Largest relative error at the angle nodes, at wavelengths between the table's.
double largest_error(double size_um, const ScatteringTable& table) {
  const SyntheticDrops drops(size_um);
  const WavelengthInterpolation rows(table, 0, false);
  std::vector<float> row(table.scattering_angle_deg.size());
  double largest = 0;
  for (const double nm : {384.1, 397.3, 466.6, 555.5, 704.8}) {
    rows.evaluate(nm, row);
    const auto truth = synthetic_row(drops, nm, table.scattering_angle_deg);
    for (std::size_t i = 0; i < row.size(); ++i)
      largest = std::max(largest, std::fabs(row[i] / truth[i] - 1));
  }
  return largest;
}

}  // namespace

TEST(WavelengthInterpolation, MeetsTheTruthBetweenNodesTenNanometresApart) {
  for (const double size_um : {5.0, 30.0, 200.0, 1000.0}) {
    const auto table = synthetic_table({size_um}, wavelengths_nm(first_nm, last_nm, 10));
    EXPECT_LT(largest_error(size_um, table), 0.005) << size_um << " um";
  }
}

// What it costs not to follow the bows: a thousand times the error allowed above.
TEST(WavelengthInterpolation, WouldFailAtFixedAngles) {
  const auto angle_deg = synthetic_angles_deg();
  const SyntheticDrops drops(1000);
  double largest = 0;
  for (const double angle : angle_deg) {
    double sum = 0;
    const double weights[] = {-1.0 / 16, 9.0 / 16, 9.0 / 16, -1.0 / 16};
    for (int j = 0; j < 4; ++j) sum += weights[j] * std::log(drops.shape(angle, 410 + 10 * j));
    largest = std::max(largest, std::fabs(std::exp(sum) / drops.shape(angle, 425) - 1));
  }
  EXPECT_GT(largest, 1);
}

TEST(WavelengthInterpolation, GivesTheTablesOwnRowsAtItsNodes) {
  const auto table = synthetic_table({100}, wavelengths_nm(first_nm, last_nm, 20), 8);
  const WavelengthInterpolation rows(table, 0, false);
  std::vector<float> row(table.scattering_angle_deg.size());
  for (const std::size_t j : {0u, 3u, 20u}) {
    rows.evaluate(table.wavelength_nm[j], row);
    for (std::size_t i = 0; i < row.size(); ++i) EXPECT_EQ(row[i], table.p11[table.first(0, j) + i]);
  }
}

TEST(WavelengthInterpolation, TakesTheEndsBeyondTheRange) {
  const auto table = synthetic_table({20}, wavelengths_nm(500, 600, 20), 8);
  const WavelengthInterpolation rows(table, 0, false);
  std::vector<float> row(table.scattering_angle_deg.size());
  rows.evaluate(300, row);
  EXPECT_EQ(row[7], table.p11[7]);
  rows.evaluate(1000, row);
  EXPECT_EQ(row[7], table.p11[table.first(0, 5) + 7]);
}

TEST(WavelengthInterpolation, StaysWithinItsNeighboursWhereThereAreZeros) {
  ScatteringTable table;
  table.size_um = {10};
  table.wavelength_nm = {400, 500, 600, 700};
  table.scattering_angle_deg = {0, 60, 120, 180};
  table.p11 = {0.3f, 0, 0.1f, 0, 0.2f, 0, 0, 0.4f, 0.3f, 0, 0, 0.1f, 0.1f, 0, 0.2f, 0};
  table.forward_fraction.assign(4, 0);
  const WavelengthInterpolation rows(table, 0, false);
  std::vector<float> row(4);
  rows.evaluate(550, row);
  EXPECT_FLOAT_EQ(row[0], 0.25f);
  EXPECT_FLOAT_EQ(row[1], 0);
  EXPECT_FLOAT_EQ(row[3], 0.25f);
}

TEST(FeatureTracks, FollowBothBowsOfDrops) {
  const auto table = synthetic_table({500}, wavelengths_nm(first_nm, last_nm, 20), 4);
  const WavelengthInterpolation rows(table, 0, false);
  ASSERT_TRUE(rows.tracks().primary().found);
  ASSERT_TRUE(rows.tracks().secondary().found);
  for (const double nm : {400.0, 533.0, 700.0}) {
    // Airy's maximum stands 1.0188 units beyond Descartes' angle.
    const double unit_deg = degrees(1.7 * std::pow(2 * pi * 500 / um_from_nm(nm), -2.0 / 3));
    EXPECT_NEAR(rows.tracks().primary().at_nm(nm), SyntheticDrops::bow_deg(nm, 1) + 1.02 * unit_deg,
                0.03);
    EXPECT_NEAR(rows.tracks().secondary().at_nm(nm),
                SyntheticDrops::bow_deg(nm, 2) - 1.02 * 1.78 * unit_deg, 0.06);
  }
}

TEST(FeatureTracks, DoNotMoveWhatHasNoBows) {
  ScatteringTable table = isotropic_table();
  const WavelengthInterpolation rows(table, 0, false);
  EXPECT_FALSE(rows.tracks().primary().found);
  std::vector<float> row(table.scattering_angle_deg.size());
  rows.evaluate(433, row);
  for (const float value : row) EXPECT_NEAR(value, 1 / (4 * pi), 1e-8);
}

}  // namespace arcus::phase
