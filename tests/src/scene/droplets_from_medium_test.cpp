#include "src/scene/droplets_from_medium.h"

#include <gtest/gtest.h>

#include <cmath>

#include "media/grid/sparse_grid.h"
#include "phase/base/error.h"
#include "phase/base/units.h"
#include "phase/species/make_species.h"
#include "phase/species/species.h"
#include "tests/statistics/moments.h"

namespace arcus::render {
namespace {

/// Two voxels of 2 m along x, the second with half the extinction and drops of twice the radius; every drop stops twice its own area.
DropSource two_voxels(media::Interpolation interpolation) {
  DropSource source;
  source.component.grid = std::make_shared<const media::SparseGrid>(media::make_sparse_grid(
      {{0, 0, 0}, {1, 0, 0}}, true, [](const media::Coord& c) { return c.x == 0 ? media::Voxel{0.2f, 10} : media::Voxel{0.1f, 20}; }));
  source.component.world_from_index = media::Affine::translation(Vec3(100, 0, 50)) * media::Affine::scaling(Vec3(2));
  source.component.interpolation = interpolation;
  source.distribution.type = "monodisperse";
  source.size_um = {10, 20};
  for (const double size : source.size_um) source.cross_section_m2.push_back(2 * pi * size * size * 1e-12);
  return source;
}

}  // namespace

TEST(DropletsFromMedium, AreAsManyAsTheExtinctionSays) {
  constexpr long long count = 20000;
  const DrawnDrops drawn = drops_from_medium({two_voxels(media::Interpolation::nearest)}, count, 1, "");
  const double small = 0.2 * 8 / (2 * pi * 1e-10), large = 0.1 * 8 / (2 * pi * 4e-10);
  EXPECT_NEAR(drawn.number_meant / (small + large), 1, 1e-6);
  EXPECT_NEAR(drawn.enlargement, std::sqrt((small + large) / count), 1e-6 * drawn.enlargement);
  double area_m2 = 0, in_first = 0;
  for (const Sphere& s : drawn.group.spheres) {
    const Vec3 at = drawn.group.centre_m + s.offset_m();
    const bool is_first = at.x < 101;
    in_first += is_first;
    area_m2 += pi * s.radius_m * s.radius_m;
    EXPECT_NEAR(s.radius_m, (is_first ? 10e-6 : 20e-6) * drawn.enlargement, 1e-5 * s.radius_m);
    EXPECT_LE(std::fabs(at.x - 101), 2);
    EXPECT_LE(std::fabs(at.z - 50), 1);
  }
  const double share = small / (small + large), error = std::sqrt(share * (1 - share) / count);
  EXPECT_NEAR(in_first / count, share, 4 * error);
  // Half of the extinction is diffraction: the drops' own area is the other half.
  EXPECT_NEAR(area_m2 / (0.5 * (0.2 + 0.1) * 8), 1, 4 * error * 3);
}

TEST(DropletsFromMedium, LieAsTheMediumInterpolates) {
  const DrawnDrops drawn = drops_from_medium({two_voxels(media::Interpolation::linear)}, 20000, 1, "");
  statistics::Moments z, square;
  for (const Sphere& s : drawn.group.spheres) {
    const double height_m = drawn.group.centre_m.z + static_cast<double>(s.z_m) - 50;
    z.add(height_m);
    square.add(height_m * height_m);
  }
  // A tent of half width 2 m: variance 4/6 m²; evenly spread in a voxel it would be 1/3.
  EXPECT_NEAR(z.mean(), 0, 4 * z.standard_error());
  EXPECT_NEAR(square.mean(), 4.0 / 6, 4 * square.standard_error());
}

TEST(DropletsFromMedium, AnotherSeedOtherPlacesAndNothingFromNothing) {
  const auto places = [](long long seed) { return drops_from_medium({two_voxels(media::Interpolation::linear)}, 10, seed, "").group; };
  EXPECT_EQ(places(1).spheres[5].x_m, places(1).spheres[5].x_m);
  EXPECT_NE(places(1).spheres[5].x_m, places(2).spheres[5].x_m);
  DropSource nothing = two_voxels(media::Interpolation::linear);
  nothing.component.extinction_scale = 0;
  EXPECT_THROW(drops_from_medium({nothing}, 10, 1, ""), Error);
}

TEST(DropletsFromMedium, TheirMediumByGeometricOpticsHasTheirDepth) {
  phase::Recipe recipe = phase::default_recipe("mie");
  recipe.size_um = {8, 12};
  recipe.wavelength_nm = {450, 550, 650};
  recipe.distribution.variance = 0.05;
  recipe.radii = 2000;
  const std::vector<double> waves_m2 = phase::cross_sections_at_550_nm_m2(phase::table_of(recipe, {}));
  recipe.optics = "geometric";
  phase::SpeciesOptions options;
  options.counted_m2 = waves_m2;
  const auto rays = phase::make_species(recipe, options);
  for (std::size_t k = 0; k < 2; ++k) {
    const double area_m2 = pi * phase::Sizes(recipe.distribution, recipe.size_um[k]).mean_power_um(2) * 1e-12;
    const auto size = static_cast<float>(recipe.size_um[k]);
    EXPECT_NEAR(rays->extinction_ratio(size, {{550, 550, 550, 550}})[0] / (area_m2 / waves_m2[k]), 1, 1e-4);
  }
}

}  // namespace arcus::render
