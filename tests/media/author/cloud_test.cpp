#include "media/author/cloud.h"

#include <gtest/gtest.h>

#include <map>

#include "media/author/droplets.h"
#include "media/author/fill.h"
#include "media/author/fog.h"
#include "phase/base/error.h"
#include "phase/base/units.h"
#include "phase/species/recipe.h"

namespace arcus::media {
namespace {

CloudSettings small_cloud(const std::string& kind) {
  CloudSettings settings;
  settings.kind = kind;
  settings.size_m = {2500, 2000};
  settings.voxel_m = 50;
  return settings;
}

/// Calls visit(voxel, extinction, size) for every voxel that is not empty.
template <class Visit>
void for_each_voxel(const NewSpecies& species, const Visit& visit) {
  for (std::size_t b = 0; b < species.extinction.size(); ++b)
    for (int i = 0; i < SparseGrid::brick_voxels; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const Coord origin = species.extinction[b].origin;
      if (species.extinction[b].values[at] > 0)
        visit(Coord{origin.x + (i >> 6), origin.y + (i >> 3 & 7), origin.z + (i & 7)}, species.extinction[b].values[at],
              species.size[b].values[at]);
    }
}

double covered_share(const NewSpecies& species, const CloudSettings& settings) {
  std::map<std::pair<int, int>, int> columns;
  for_each_voxel(species, [&](const Coord& c, float, float) { ++columns[{c.x, c.y}]; });
  return static_cast<double>(columns.size()) * settings.voxel_m * settings.voxel_m / (settings.size_m[0] * settings.size_m.back());
}

}  // namespace

TEST(Droplets, RadiusFromLiquidWaterAndNumber) {
  // One drop size (variance near 0): 100 drops of 10 µm in a cm³ are 4/3 π 10⁻¹⁵ m³ · 10⁸ m⁻³ · 10⁶ g/m³.
  EXPECT_NEAR(effective_radius_um(4.0 / 3 * pi * 0.1, 100, 1e-9), 10, 1e-6);
  // Hansen & Travis: the mean volume radius is smaller than the effective radius.
  EXPECT_NEAR(effective_radius_um(4.0 / 3 * pi * 0.1, 100, 0.1), 10 / std::cbrt(0.9 * 0.8), 1e-6);
}

TEST(Droplets, ExtinctionIsThatOfTheirEfficiency) {
  const DropletExtinction extinction(0.1, 5, 20);
  // Mie, gamma distribution of variance 0.1, 550 nm, from the program's own phase eval: 2.144 at 5 µm, 2.056 at 20 µm.
  EXPECT_NEAR(extinction.efficiency(5), 2.144, 0.02);
  EXPECT_NEAR(extinction.efficiency(20), 2.056, 0.02);
  EXPECT_GT(extinction.efficiency(5), extinction.efficiency(10));
  EXPECT_NEAR(extinction.per_m(0.3, 10), 0.75 * extinction.efficiency(10) * 0.3e-6 / 10e-6, 1e-12);
}

TEST(Droplets, RecipesShareALattice) {
  const phase::Recipe small = phase::recipe_from_text(droplet_recipe(0.1, 5, 9), "");
  const phase::Recipe large = phase::recipe_from_text(droplet_recipe(0.1, 4, 12), "");
  EXPECT_LE(small.size_um.front(), 5);
  EXPECT_GE(small.size_um.back(), 9);
  for (const double size : small.size_um)
    EXPECT_TRUE(std::find(large.size_um.begin(), large.size_um.end(), size) != large.size_um.end()) << size;
  for (std::size_t i = 1; i < large.size_um.size(); ++i) EXPECT_LT(large.size_um[i] / large.size_um[i - 1], 1.101);
}

TEST(Cloud, DropletsGrowAsTheCubeRootOfTheHeight) {
  for (const char* kind : {"cumulus", "stratocumulus", "stratus"}) {
    const CloudSettings settings = small_cloud(kind);
    const NewSpecies species = author_cloud(settings);
    int voxels = 0;
    for_each_voxel(species, [&](const Coord& c, float, float size) {
      const double height_m = species.world_from_index.point(Vec3(c.x, c.y, c.z)).z - settings.base_m;
      const double expected = effective_radius_um(1e-3 * settings.liquid_gradient_g_per_m3_km * height_m, settings.drops_per_cm3, settings.variance);
      ASSERT_NEAR(size, std::max(settings.smallest_um, expected), 1e-4 * expected) << kind;
      ++voxels;
    });
    EXPECT_GT(voxels, 500) << kind;
  }
}

TEST(Cloud, HoldsNoMoreWaterThanARisingParcel) {
  const CloudSettings settings = small_cloud("cumulus");
  const NewSpecies species = author_cloud(settings);
  const DropletExtinction extinction(settings.variance, 2, 30);
  for_each_voxel(species, [&](const Coord& c, float value, float size) {
    const double height_m = species.world_from_index.point(Vec3(c.x, c.y, c.z)).z - settings.base_m;
    const double most = extinction.per_m(settings.adiabatic_share * 1e-3 * settings.liquid_gradient_g_per_m3_km * height_m, size);
    ASSERT_LE(value, most * 1.01);
  });
}

TEST(Cloud, CoversWhatItIsAskedTo) {
  CloudSettings settings = small_cloud("stratus");
  EXPECT_GT(covered_share(author_cloud(settings), settings), 0.99);
  settings = small_cloud("cumulus");
  settings.size_m = {8000};
  const double third = covered_share(author_cloud(settings), settings);
  settings.cover = 0.6;
  const double more = covered_share(author_cloud(settings), settings);
  EXPECT_NEAR(third, 0.3, 0.12);
  EXPECT_GT(more, third + 0.1);
}

TEST(Cloud, FollowsItsSeed) {
  CloudSettings settings = small_cloud("cumulus");
  const auto total = [&] { return range_of(author_cloud(settings)).extinction_times_size; };
  const double first = total();
  EXPECT_EQ(total(), first);
  settings.seed = 2;
  EXPECT_NE(total(), first);
}

TEST(Fog, VisibilityIsThatOfFog) {
  for (const char* kind : {"radiation", "advection"}) {
    FogSettings settings;
    settings.kind = kind;
    settings.size_m = {400};
    settings.voxel_m = 10;
    const NewSpecies species = author_fog(settings);
    const FilledRange range = range_of(species);
    const double visibility_m = 3.9 / range.largest_extinction_per_m;  // Koschmieder
    EXPECT_GT(visibility_m, 15) << kind;
    EXPECT_LT(visibility_m, 200) << kind;
    double top_m = 0;
    for_each_voxel(species, [&](const Coord& c, float, float) { top_m = std::max(top_m, species.world_from_index.point(Vec3(c.x, c.y, c.z)).z); });
    EXPECT_LT(top_m, 1.6 * (settings.kind == "radiation" ? 60 : 200)) << kind;
  }
}

TEST(Fill, RefusesMoreVoxelsThanThereIsRoomFor) {
  CloudSettings settings;
  settings.voxel_m = 0.1;
  EXPECT_THROW(author_cloud(settings), Error);
}

}  // namespace arcus::media
