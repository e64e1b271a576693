#include "media/author/cirrus.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <map>
#include <numbers>

#include "media/author/air_density.h"
#include "media/author/diamond_dust.h"
#include "media/author/fall_streaks.h"
#include "media/author/fill.h"
#include "media/author/ice_climate.h"
#include "media/author/smooth_step.h"
#include "phase/base/error.h"
#include "phase/base/frame.h"
#include "phase/species/recipe.h"

namespace arcus::media {
namespace {

constexpr double root3 = std::numbers::sqrt3;

IceCrystals crystals(double aspect_ratio, const std::string& lies = "random") {
  phase::CrystalSettings settings;
  settings.habit.aspect_ratio = aspect_ratio;
  settings.orientation.type = lies;
  return IceCrystals(settings);
}

CirrusSettings small_cirrus() {
  CirrusSettings settings;
  settings.size_m = {6000, 5000};
  settings.voxel_m = 100;
  settings.cell_m = 1500;
  settings.cover = 0.4;
  settings.crystals.habits = {"plate", "column"};
  return settings;
}

/// A sheet without any texture: a function of the height alone.
CirrusSettings smooth_sheet() {
  CirrusSettings settings = small_cirrus();
  settings.kind = "cirrostratus";
  settings.cover = 1;
  settings.texture = 0;
  return settings;
}

/// Calls visit(middle of the voxel, extinction, size) for every voxel that is not empty.
template <class Visit>
void for_each_voxel(const NewSpecies& species, const Visit& visit) {
  for (std::size_t b = 0; b < species.extinction.size(); ++b)
    for (int i = 0; i < SparseGrid::brick_voxels; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const Coord origin = species.extinction[b].origin;
      if (species.extinction[b].values[at] > 0)
        visit(species.world_from_index.point(Vec3(origin.x + (i >> 6), origin.y + (i >> 3 & 7), origin.z + (i & 7))),
              species.extinction[b].values[at], species.size[b].values[at]);
    }
}

/// Mass of the ice that stops as much light [kg], by the closed form of hexagonal prisms.
double ice_kg(const NewSpecies& species, double aspect_ratio) {
  // Base of diameter 1, length a: V = 3√3/8 a, S = 3√3/4 + 3 a, longest √(1 + a²).
  const double volume = 3 * root3 / 8 * aspect_ratio, surface = 3 * root3 / 4 + 3 * aspect_ratio, longest = std::hypot(1, aspect_ratio);
  const double voxel_m3 = std::fabs(species.world_from_index.determinant());
  double sum = 0;
  for_each_voxel(species, [&](const Vec3&, float extinction, float size) {
    sum += extinction * 917 * volume / longest * size * 1e-6 / (0.5 * surface) * voxel_m3;
  });
  return sum;
}

}  // namespace

TEST(IceCrystals, ExtinctionIsTwiceTheShadowOfTheShape) {
  for (const double a : {0.1, 1.0, 2.5}) {
    const double d_um = 300, base_m = d_um * 1e-6 / std::hypot(1, a);  // diameter of the base
    const double volume = 3 * root3 / 8 * a * std::pow(base_m, 3), shadow = (3 * root3 / 4 + 3 * a) * base_m * base_m / 4;
    const IceCrystals one = crystals(a);
    EXPECT_NEAR(one.mass_kg(d_um) / (917 * volume), 1, 1e-9) << a;
    EXPECT_NEAR(one.extinction_per_m(0.02, d_um) / (2 * shadow * 0.02e-3 / (917 * volume)), 1, 1e-9) << a;
    EXPECT_NEAR(one.extinction_per_m(0.02, d_um) / (1.5 * 0.02e-3 / (917 * one.effective_radius_um(d_um) * 1e-6)), 1, 1e-9) << a;
  }
}

TEST(IceCrystals, FallByDragAndWeightLargeOnesFaster) {
  // Creeping flow, where inertia does not count: the formula tends to X/(8² 0.35) for Re, so v = 8 m g / (8² 0.35 pi eta D sqrt(Ar)); eta = 1.667e-5 at -10 C.
  const IceCrystals plate = crystals(0.1, "plate");
  const double base = 5e-6 / std::hypot(1, 0.1), area_ratio = 3 * root3 / 8 * base * base / (0.25 * 3.14159265 * 25e-12);
  const double eta = 1.667e-5, creeping = 8 * plate.mass_kg(5) * 9.80665 / (3.14159265 * 64 * 0.35 * std::sqrt(area_ratio) * eta * 5e-6);
  EXPECT_NEAR(plate.fall_speed_m_per_s(5, 1.3, -10) / creeping, 1, 0.03);
  // Large ones: tenths of a metre a second.
  EXPECT_NEAR(plate.fall_speed_m_per_s(300, 1.3, -10), 0.3, 0.2);
  EXPECT_NEAR(crystals(2.5, "column").fall_speed_m_per_s(300, 0.5, -40), 0.5, 0.3);
  const IceCrystals plates = crystals(0.1, "plate");
  EXPECT_GT(plates.fall_speed_m_per_s(200, 0.5, -40), plates.fall_speed_m_per_s(100, 0.5, -40));
  EXPECT_GT(plates.fall_speed_m_per_s(200, 0.4, -40), plates.fall_speed_m_per_s(200, 1.2, -40));
}

TEST(IceClimate, IsThatOfThePublishedFits) {
  EXPECT_NEAR(mean_ice_g_per_m3(-20), std::exp(-3.6), 1e-12);
  EXPECT_NEAR(std::log(mean_ice_g_per_m3(-60)), -7.6 + 4 * std::exp(-0.2443e-3 * std::pow(40.0, 2.455)), 1e-12);
  EXPECT_NEAR(mean_width_um(-20), 147.1, 0.01);
  EXPECT_NEAR(mean_width_um(-40), 67.9, 0.01);
  EXPECT_NEAR(mean_width_um(-60), 31.1, 0.01);
  for (double t = -75; t < -10; t += 5) {
    EXPECT_LE(mean_ice_g_per_m3(t), mean_ice_g_per_m3(t + 5));
    EXPECT_LE(mean_width_um(t), mean_width_um(t + 5));
  }
  EXPECT_LT(columnar_share(-15), 0.2);
  EXPECT_GT(columnar_share(-55), 0.8);
  EXPECT_GT(columnar_share(-6), 0.8);
}

TEST(FallStreaks, AreTheIntegralOfShearOverFallSpeed) {
  // Constant speed: a parabola. Speed that grows as 1 + d/D: s/v0 D² (u - ln(1 + u)), u = d/D.
  const FallStreaks constant({4e-3, 90, 0}, 2000, [](double) { return 0.5; });
  EXPECT_NEAR(constant.drift_m(1500).x, 0.5 * 4e-3 / 0.5 * 1500 * 1500, 1);
  EXPECT_NEAR(constant.drift_m(1500).y, 0, 1e-6);
  EXPECT_NEAR(constant.time_s(1500), 3000, 1e-6);
  const FallStreaks growing({4e-3, 0, 0}, 2000, [](double d) { return 0.5 * (1 + d / 2000); });
  EXPECT_NEAR(growing.drift_m(1000).y, 4e-3 / 0.5 * 4e6 * (0.5 - std::log(1.5)), 1);
  // Half a turn: slope at the end is opposite to that of the start.
  const FallStreaks turning({4e-3, 0, 180}, 2000, [](double) { return 0.5; });
  EXPECT_GT(turning.drift_m(1000).x, 0);
  EXPECT_NEAR((turning.drift_m(2000).y - turning.drift_m(1990).y) / 10, -4e-3 * 2000 / 0.5, 0.3);
}

TEST(Cirrus, StreaksInTheGridLieWhereWindAndFallCarryThem) {
  CirrusSettings settings = small_cirrus();
  settings.size_m = {12000, 8000};
  settings.cell_life_min = 0;
  settings.texture = 0;
  settings.shear_m_per_s_km = 4;
  settings.fall_speed_m_per_s = 1;
  settings.shear_turn_deg = 0;
  settings.crystals.habits = {"prism"};
  const AuthoredIce cloud = author_cirrus(settings);
  // Ice of each level over that of the climate, by place in the cell: x shifted back by the drift, which 100 m voxels resolve to 50 m.
  const double cell_base_m = settings.top_m - 500;
  std::map<int, std::map<std::pair<int, int>, double>> levels;
  for_each_voxel(cloud.species[0], [&](const Vec3& p, float extinction, float) {
    levels[static_cast<int>(std::lround(p.z))][{static_cast<int>(std::floor(p.x / 100)), static_cast<int>(std::floor(p.y / 100))}] = extinction;
  });
  const auto drift_m = [&](int z) { const double d = cell_base_m - z; return 0.5 * 4e-3 / 1 * d * d; };
  const auto& upper = levels.at(8450);
  double expected = 0, unmoved = 0;
  const int z = 7950, moved = static_cast<int>(std::lround((drift_m(z) - drift_m(8450)) / 100));
  EXPECT_GE(moved, 5);
  for (const auto& [place, value] : upper) {
    const auto at = [&](int dx) { const auto found = levels.at(z).find({place.first + dx, place.second}); return found == levels.at(z).end() ? 0 : found->second; };
    expected += value * at(-moved);  // towards the west
    unmoved += value * at(0);
  }
  EXPECT_GT(expected, 1.15 * unmoved);
  // The best shift is the drift.
  double best = 0;
  int best_shift = 0;
  for (int shift = 0; shift < 2 * moved; ++shift) {
    double sum = 0;
    for (const auto& [place, value] : upper)
      if (const auto found = levels.at(z).find({place.first - shift, place.second}); found != levels.at(z).end()) sum += value * found->second;
    if (sum > best) best = sum, best_shift = shift;
  }
  EXPECT_NEAR(best_shift, moved, 1);
}

TEST(Cirrus, HoldsTheIceOfItsTemperatures) {
  const CirrusSettings settings = smooth_sheet();
  const AuthoredIce sheet = author_cirrus(settings);
  // Fades within 0.3 of the layer of cells at the top, and of the rest at the base.
  const double cell_base = settings.top_m - 250;
  double column_g_per_m2 = 0;
  for (double z = settings.base_m + 0.5; z < settings.top_m; z += 1)
    column_g_per_m2 += mean_ice_g_per_m3(15 - 6.5e-3 * z) *
                       (z > cell_base ? smooth_step((settings.top_m - z) / 250 / 0.3) : smooth_step((z - settings.base_m) / (cell_base - settings.base_m) / 0.3));
  const double expected_kg = 1e-3 * column_g_per_m2 * 6000 * 5000;
  EXPECT_NEAR(sheet.ice_kg / expected_kg, 1, 0.01);
  EXPECT_NEAR((ice_kg(sheet.species[0], 0.1) + ice_kg(sheet.species[1], 2.5)) / sheet.ice_kg, 1, 1e-5);
}

TEST(Cirrus, OpticalDepthDecidesTheIce) {
  CirrusSettings settings = small_cirrus();
  settings.optical_depth = 0.7;
  const AuthoredIce cloud = author_cirrus(settings);
  double depth = 0;
  for (const NewSpecies& species : cloud.species)
    for_each_voxel(species, [&](const Vec3&, float extinction, float) { depth += extinction * 1e6 / (6000.0 * 5000); });
  EXPECT_NEAR(depth, 0.7, 1e-4);
  EXPECT_NEAR(cloud.mean_optical_depth, 0.7, 1e-9);
}

TEST(Cirrus, CrystalsGrowDownwardUntilTheySublimate) {
  const CirrusSettings settings = smooth_sheet();
  std::map<int, float> sizes;
  for_each_voxel(author_cirrus(settings).species[0], [&](const Vec3& p, float, float size) { sizes[static_cast<int>(std::lround(p.z))] = size; });
  EXPECT_LT(sizes.at(8850), sizes.at(8050));
  EXPECT_NEAR(sizes.at(8050), 2.5 * mean_width_um(15 - 6.5e-3 * 8050), 0.1);
  EXPECT_LT(sizes.at(7150), crystal_size_um(settings, 7150));
}

TEST(Cirrus, SharesAddUp) {
  IceMixtureSettings settings;
  settings.habits = {"plate", "column", "prism"};
  settings.shares = {3, 2, 5};
  for (const bool by_temperature : {false, true}) {
    settings.by_temperature = by_temperature;
    const IceMixture mixture(settings);
    for (double t = -70; t < 0; t += 7) EXPECT_NEAR(mixture.share(0, t) + mixture.share(1, t) + mixture.share(2, t), 1, 1e-12);
    EXPECT_EQ(mixture.share(0, -55) < 0.2, by_temperature);
    if (!by_temperature) {
      EXPECT_NEAR(mixture.share(2, -30), 0.5, 1e-12);
    }
  }
  // The same ice, whatever it is shared among.
  CirrusSettings cloud = small_cirrus();
  const double both = author_cirrus(cloud).ice_kg;
  cloud.crystals.shares = {1, 3};
  cloud.fall_speed_m_per_s = 0.4;
  const AuthoredIce uneven = author_cirrus(cloud);
  EXPECT_NEAR(ice_kg(uneven.species[1], 2.5) / ice_kg(uneven.species[0], 0.1), 3, 1e-4);
  EXPECT_GT(both, 0);
}

TEST(Cirrus, RecipesHaveFewSizes) {
  const AuthoredIce cloud = author_cirrus(small_cirrus());
  for (const NewSpecies& species : cloud.species) {
    const phase::Recipe recipe = phase::recipe_from_text(species.recipe, "");
    EXPECT_TRUE(recipe.is_oriented());
    EXPECT_LE(recipe.size_um.size(), 2u);
    EXPECT_GE(recipe.size_um.front(), cloud.smallest_size_um / 1.5);
    EXPECT_LE(recipe.size_um.back(), cloud.largest_size_um * 1.5);
    EXPECT_EQ(species.phase_id.size(), 32u);
  }
  const IceMixture large({.habits = {"plate"}, .size_nodes = 4});
  EXPECT_EQ(phase::recipe_from_text(large.recipe(0, 200, 800), "").size_um.size(), 1u);
  EXPECT_EQ(phase::recipe_from_text(large.recipe(0, 20, 200), "").size_um.size(), 4u);
}

TEST(Cirrus, HabitsLieAsTheirWordsSay) {
  const IceMixture mixture({.habits = {"plate", "random_plate", "parry", "lowitz"}, .tilt_deg = {2, 1, 0.5, 3}, .aspect_ratio = {0.05, 0, 0, 0}});
  const auto& parts = mixture.parts();
  EXPECT_EQ(parts[0].settings.orientation.type, "plate");
  EXPECT_EQ(parts[0].settings.habit.aspect_ratio, 0.05);
  EXPECT_EQ(parts[1].settings.orientation.type, "random");
  EXPECT_EQ(parts[1].settings.habit.aspect_ratio, 0.1);
  EXPECT_EQ(parts[2].settings.orientation.type, "parry");
  EXPECT_EQ(parts[2].settings.orientation.roll_deg, 0.5);
  EXPECT_EQ(parts[3].settings.orientation.roll_deg, 180);
  EXPECT_EQ(phase::recipe_from_text(mixture.recipe(3, 200, 300), "").crystal.orientation.tilt_deg, 3);
}

TEST(Cirrus, IsTheSameForAnyNumberOfThreadsAndAnotherForAnotherSeed) {
  CirrusSettings settings = small_cirrus();
  const AuthoredIce many = author_cirrus(settings);
  AuthoredIce one;
  {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    one = author_cirrus(settings);
  }
  ASSERT_EQ(one.species.size(), many.species.size());
  for (std::size_t s = 0; s < one.species.size(); ++s) {
    ASSERT_EQ(one.species[s].extinction.size(), many.species[s].extinction.size());
    for (std::size_t b = 0; b < one.species[s].extinction.size(); ++b) {
      ASSERT_EQ(one.species[s].extinction[b].values, many.species[s].extinction[b].values);
      ASSERT_EQ(one.species[s].size[b].values, many.species[s].size[b].values);
    }
  }
  settings.seed = 2;
  EXPECT_NE(author_cirrus(settings).ice_kg, many.ice_kg);
}

TEST(DiamondDust, HasTheNumberAndDepthAskedFor) {
  DiamondDustSettings settings;
  settings.size_m = {600};
  settings.voxel_m = 20;
  settings.patchiness = 0;
  settings.crystals.habits = {"prism"};
  const AuthoredIce dust = author_diamond_dust(settings);
  // 100 crystals in a litre: 2 N A, A a quarter of the surface of a prism of aspect ratio 1 and 120 um.
  const double base_m = 120e-6 / std::hypot(1, 1), shadow = (3 * root3 / 4 + 3) * base_m * base_m / 4;
  EXPECT_NEAR(dust.largest_extinction_per_m / (2e5 * shadow), 1, 1e-5);
  settings.optical_depth = 0.1;
  settings.patchiness = 0.5;
  settings.crystals.habits = {"plate", "column"};
  const AuthoredIce patchy = author_diamond_dust(settings);
  EXPECT_NEAR(patchy.mean_optical_depth, 0.1, 1e-9);
  EXPECT_EQ(patchy.species[1].name, "diamond_dust_column");
  for_each_voxel(patchy.species[0], [&](const Vec3& p, float, float) { ASSERT_LT(p.z, 200); });
}

}  // namespace arcus::media
