// Tables as the renderer reads them, against a direct evaluation of the same populations with other radii, at random
// angles and wavelengths between the nodes. Slow: minutes.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "phase/base/random.h"
#include "phase/base/units.h"
#include "phase/function/sphere_table.h"
#include "phase/population/average.h"
#include "phase/species/make_species.h"

namespace arcus::phase {
namespace {

struct Agreement {
  double worst = 0, rms = 0, worst_angle_deg = 0, worst_nm = 0;
};

/// Angles spread over the sphere, and as many again near 0 and 180° and in the bows, ascending.
std::vector<double> random_angles(Random& random, int count) {
  std::vector<double> angles;
  for (int i = 0; i < count; ++i) {
    angles.push_back(180 * random.uniform_double());
    angles.push_back(8 * std::pow(random.uniform_double(), 2));
    angles.push_back(180 - 8 * std::pow(random.uniform_double(), 2));
    angles.push_back(120 + 25 * random.uniform_double());
  }
  std::sort(angles.begin(), angles.end());
  return angles;
}

/// Largest relative difference over all sizes of a recipe at random wavelengths and angles.
Agreement agreement(std::string_view text) {
  const Recipe recipe = recipe_from_text(text, "recipe.toml");
  const ScatteringTable table = compute_table(recipe);
  SphereTableOptions whole;
  whole.clip_forward_lobe = false;
  const SphereTable lobes(table, whole);
  std::vector<Sizes> sizes;
  for (const double size_um : recipe.size_um) sizes.emplace_back(recipe.distribution, size_um);
  Random random(20240901, 7, 0);
  Agreement result;
  double squares = 0;
  int count = 0;
  for (int trial = 0; trial < 4; ++trial) {
    const double first = recipe.wavelength_nm.front(), last = recipe.wavelength_nm.back();
    const auto nm = static_cast<float>(first + (last - first) * random.uniform_double());
    const std::vector<double> angles = random_angles(random, 150);
    const PopulationMeans direct = SphereAverage(sizes, angles, nm, recipe.radii * 5 / 4 + 17, true)
                                       .means(nm, refractive_index_of(recipe).relative_to_air(nm));
    for (std::size_t size = 0; size < sizes.size(); ++size)
      for (std::size_t i = 0; i < angles.size(); ++i) {
        const double value = lobes.value_per_sr(static_cast<int>(size), half_angle_of_rad(radians(angles[i])),
                                                {{nm, nm, nm, nm}})[0];
        const double error = value / direct.matrix[size * matrix_elements * angles.size() + i] - 1;
        squares += error * error;
        ++count;
        if (std::fabs(error) <= result.worst) continue;
        result.worst = std::fabs(error);
        result.worst_angle_deg = angles[i];
        result.worst_nm = nm;
      }
  }
  result.rms = std::sqrt(squares / count);
  std::printf("worst %.4f at %.4f degrees and %.1f nm, rms %.5f; normalisation %.5f, angles %.5f, %zu nodes\n",
              result.worst, result.worst_angle_deg, result.worst_nm, result.rms, table.normalisation_error,
              table.angle_error, table.scattering_angle_deg.size());
  return result;
}

constexpr double bound = 0.005;

}  // namespace

TEST(TableAccuracy, OfACloud) {
  const Agreement a = agreement(
      "size_um = [5, 10]\nwavelength_nm = { min = 430, max = 530, nodes = 11 }\n"
      "distribution = { variance = 0.1 }\nradii = 40000");
  EXPECT_LT(a.worst, bound);
  EXPECT_LT(a.rms, 0.0015);
}

TEST(TableAccuracy, OfACloudThatShowsRings) {
  const Agreement a = agreement(
      "size_um = [5, 10]\nwavelength_nm = { min = 430, max = 530, nodes = 11 }\n"
      "distribution = { variance = 0.02 }\nradii = 60000");
  EXPECT_LT(a.worst, bound);
  EXPECT_LT(a.rms, 0.0015);
}

TEST(TableAccuracy, OfDrizzleAndRain) {
  const Agreement a = agreement(
      "type = 'rain'\nsize_um = [200, 500]\nwavelength_nm = { min = 430, max = 530, nodes = 11 }\n"
      "distribution = { type = 'gamma', variance = 0.1 }");
  EXPECT_LT(a.worst, bound);
  EXPECT_LT(a.rms, 0.0015);
}

TEST(TableAccuracy, OfWellSortedDrops) {
  const Agreement a = agreement(
      "type = 'rain'\nsize_um = [200, 500]\nwavelength_nm = { min = 430, max = 530, nodes = 11 }\n"
      "distribution = { type = 'gamma', variance = 0.02 }");
  EXPECT_LT(a.worst, bound);
  EXPECT_LT(a.rms, 0.0015);
}

}  // namespace arcus::phase
