#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <vector>

#include "phase/optics/refractive_index.h"
#include "phase/optics/sun_disc.h"
#include "phase/population/tabulate_crystals.h"

namespace arcus::phase {
namespace {

OrientedTable map_of(const std::string& habit, double step_deg) {
  CrystalTableSettings settings;
  settings.crystals = crystals_of_habit(habit);
  settings.size_um = {200};
  settings.waves = {{550, RefractiveIndex::ice().relative_to_air(550).real(), 0}};
  settings.rays = 12e6;
  settings.map_step_deg = step_deg;
  return tabulate_oriented_crystals(settings, 20, mean_sun_radius_deg);
}

/// Median relative difference of two maps over the brightest tenth of the nodes of the coarser one, whose step must be a multiple of
/// the finer one's.
double difference(const OrientedTable& coarse, const OrientedTable& fine) {
  const std::size_t ratio = (fine.azimuth_deg.size() - 1) / (coarse.azimuth_deg.size() - 1);
  struct Pair {
    float a, b;
  };
  std::vector<Pair> pairs;
  // The poles' columns are one place, and of most nodes near them little of the sky is seen.
  for (std::size_t row = 1; row + 1 < coarse.elevation_deg.size(); ++row) {
    if (std::fabs(coarse.elevation_deg[row]) > 80) continue;
    for (std::size_t column = 0; column < coarse.azimuth_deg.size(); ++column)
      pairs.push_back({coarse.scattering_m2_per_sr[coarse.cell(0, row, column)], fine.scattering_m2_per_sr[fine.cell(0, row * ratio, column * ratio)]});
  }
  const auto bright = static_cast<std::ptrdiff_t>(pairs.size() / 10);
  std::nth_element(pairs.begin(), pairs.begin() + bright, pairs.end(), [](const Pair& x, const Pair& y) { return x.b > y.b; });
  std::vector<double> differences;
  for (auto pair = pairs.begin(); pair != pairs.begin() + bright; ++pair) differences.push_back(std::fabs(pair->a - pair->b) / pair->b);
  std::nth_element(differences.begin(), differences.begin() + bright / 2, differences.end());
  return differences[static_cast<std::size_t>(bright / 2)];
}

}  // namespace

// Maps have a step of 0.1 degrees, a fifth of the sun's disc, which has blurred what they show. Their noise is 3 %.
TEST(MapResolution, HalvingTheStepChangesLessThanTheNoise) {
  // Level plates draw the thinnest line, the parhelic circle.
  const OrientedTable usual = map_of("plate", 0.1);
  const double halved = difference(usual, map_of("plate", 0.05)), coarse = difference(map_of("plate", 1), usual);
  std::cout << "0.1 against 0.05 degrees " << 100 * halved << " %, 1 against 0.1 degrees " << 100 * coarse << " %\n";
  EXPECT_LT(halved, 0.03);
  EXPECT_GT(coarse, 2 * halved) << "a step as wide as two suns must be seen";
}

}  // namespace arcus::phase
