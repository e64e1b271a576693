// Does the medium show what real spheres show? Boxes of drops of optical depth 0.1, 0.5 and 2 by geometric optics, volume_path through the medium
// against path through explicit drops: backscattered bows, the sun through the box, the shadow on the ground. Both sides have no code in common
// but vectors and the film: one draws from tables, the other meets spheres.

#include "src/analysis/drops_comparison.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <iostream>

#include "media/author/box.h"
#include "tests/statistics/seed.h"

namespace arcus::render {
namespace {

/// A box of drops of 0.5 mm, of that depth along its shortest edge, as a file.
std::string box_file(double optical_depth, const Vec3& centre_m, const Vec3& size_m, double edge_m) {
  media::BoxSettings box;
  box.centre_m = centre_m;
  box.size_m = size_m;
  box.extinction_per_m = optical_depth / edge_m;
  box.voxels = {32, 32, 32};
  box.size_um = 500;
  box.phase = phase::default_recipe("mie");
  box.phase.size_um = {500};
  box.phase.distribution.variance = 0.01;
  box.phase.optics = "geometric";
  box.phase.wavelength_nm = {380, 430, 480, 530, 580, 630, 680, 730, 780};
  const std::string path = (std::filesystem::temp_directory_path() / (statistics::test_name() + ".vdb")).string();
  save_grids(path, grids_of(author_box(box, "")));
  return path;
}

SceneSettings scene_of(const std::string& vdb, double sun_elevation_deg, double sun_radius_deg) {
  SceneSettings scene;
  scene.path = statistics::test_name();
  scene.camera.position_m = Vec3(0, 0, 0);
  scene.camera.width_px = scene.camera.height_px = 48;
  scene.sun.azimuth_deg = 180;
  scene.sun.elevation_deg = sun_elevation_deg;
  scene.sun.angular_radius_deg = sun_radius_deg;
  scene.render.max_bounces = 1000;
  scene.media.emplace_back().vdb = vdb;
  return scene;
}

DropsComparison compared(SceneSettings scene, long long drops, double samples, const ProfileSettings& profile) {
  scene.render.samples_per_pixel = static_cast<long long>(samples * statistics::test_effort());
  // Every run of drops asks for the table; no other test has the same.
  const auto cache = std::filesystem::temp_directory_path() / (statistics::test_name() + ".cache");
  DropsComparisonOptions options;
  options.build.cache_folder = cache.string();
  options.drops = drops;
  options.profile = profile;
  const DropsComparison result = compare_drops(scene, options);
  std::filesystem::remove(scene.media[0].vdb);
  std::filesystem::remove_all(cache);
  std::cout << figures_text(result);
  return result;
}

/// Within the errors of chance, and in all within 2 %. Drops that are not allowed to overlap stop a little more light than as many that lie
/// at random: about the share of space that they fill, 0.01 here.
void expect_agreement(const DropsComparison& c) {
  EXPECT_NEAR(c.depth.drops, c.depth.medium, 4 * c.depth.drops_error + 0.01 * c.depth.medium) << statistics::how_to_repeat();
  for (const Agreement* a : {&c.profile_agreement, &c.block_agreement}) {
    if (a->places == 0) continue;
    EXPECT_LT(a->sigma, 4) << statistics::how_to_repeat();
    EXPECT_NEAR(a->mean_ratio, 1, 0.02 + 2 * a->mean_ratio_error) << statistics::how_to_repeat();
    EXPECT_LT(a->mean_ratio_error, 0.03);
  }
}

/// The camera looks at the antisolar point, into the middle of a box that is `thick_m` from front to back.
void expect_same_bows(double optical_depth, double thick_m, long long drops, double sun_radius_deg, double samples) {
  SceneSettings scene = scene_of(box_file(optical_depth, Vec3(0, 20, 0), Vec3(60, thick_m, 60), thick_m), 0, sun_radius_deg);
  scene.camera.fov_deg = 94;
  expect_agreement(compared(scene, drops, samples, {.around = "antisolar", .bin_deg = 3, .to_deg = 60}));
}

}  // namespace

TEST(DropsAgainstMedium, BowsOfThinRain) { expect_same_bows(0.1, 10, 30000, 8, 1000); }
TEST(DropsAgainstMedium, BowsOfRain) { expect_same_bows(0.5, 10, 100000, 6, 600); }
TEST(DropsAgainstMedium, BowsOfThickRain) { expect_same_bows(2, 20, 300000, 8, 160); }

TEST(DropsAgainstMedium, TheSunThroughTheBox) {
  SceneSettings scene = scene_of(box_file(0.5, Vec3(0, 25, 0), Vec3(60, 10, 60), 10), 0, 5);
  scene.sun.azimuth_deg = 0;
  scene.camera.fov_deg = 70;
  expect_agreement(compared(scene, 100000, 600, {.around = "sun", .bin_deg = 2, .to_deg = 44}));
}

TEST(DropsAgainstMedium, TheShadowOfTheBox) {
  // Light that drops throw on the ground is found by chance alone: under a small sun, so rarely that its error is not known.
  SceneSettings scene = scene_of(box_file(1, Vec3(0, 0, 10), Vec3(12, 12, 8), 8), 55, 20);
  SurfaceSettings ground;
  ground.shape.type = "plane";
  ground.material.albedo = {0.5};
  scene.surfaces.push_back(ground);
  scene.camera = {.type = "orthographic", .position_m = Vec3(0, 6, 30), .elevation_deg = -90, .width_m = 32, .width_px = 48, .height_px = 48};
  expect_agreement(compared(scene, 100000, 600, {}));
}

}  // namespace arcus::render
