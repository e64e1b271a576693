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
  const std::string path = (std::filesystem::temp_directory_path() / (statistics::test_name() + ".vdb")).string();
  save_grids(path, grids_of(author_box(box, "")));
  return path;
}

SceneSettings scene_of(const std::string& vdb, double sun_elevation_deg) {
  SceneSettings scene;
  scene.path = statistics::test_name();
  scene.camera.position_m = Vec3(0, 0, 0);
  scene.camera.width_px = scene.camera.height_px = 48;
  scene.sun.azimuth_deg = 180;
  scene.sun.elevation_deg = sun_elevation_deg;
  scene.sun.angular_radius_deg = 4;
  scene.render.max_bounces = 1000;
  scene.media.emplace_back().vdb = vdb;
  return scene;
}

DropsComparison compared(SceneSettings scene, double samples, double bin_deg, const char* around, double to_deg) {
  scene.render.samples_per_pixel = static_cast<long long>(samples * statistics::test_effort());
  DropsComparisonOptions options;
  options.drops = 100000;
  options.profile = {.around = around, .bin_deg = bin_deg, .to_deg = to_deg};
  const DropsComparison result = compare_drops(scene, options);
  std::filesystem::remove(scene.media[0].vdb);
  std::cout << figures_text(result);
  return result;
}

/// Within the errors of chance, and in all within 2 %.
void expect_agreement(const DropsComparison& c) {
  EXPECT_NEAR(c.depth.drops, c.depth.medium, 4 * c.depth.drops_error + 0.01 * c.depth.medium) << statistics::how_to_repeat();
  for (const Agreement* a : {&c.profile_agreement, &c.block_agreement}) {
    if (a->places == 0) continue;
    EXPECT_LT(a->sigma, 4) << statistics::how_to_repeat();
    EXPECT_NEAR(a->mean_ratio, 1, 0.02 + 2 * a->mean_ratio_error) << statistics::how_to_repeat();
    EXPECT_LT(a->mean_ratio_error, 0.02);
  }
}

/// The camera looks at the antisolar point, into the middle of the box.
void expect_same_bows(double optical_depth, double samples) {
  SceneSettings scene = scene_of(box_file(optical_depth, Vec3(0, 25, 0), Vec3(60, 10, 60), 10), 0);
  scene.camera.fov_deg = 94;
  expect_agreement(compared(scene, samples, 3, "antisolar", 60));
}

}  // namespace

TEST(DropsAgainstMedium, BowsOfThinRain) { expect_same_bows(0.1, 6400); }
TEST(DropsAgainstMedium, BowsOfRain) { expect_same_bows(0.5, 2000); }
TEST(DropsAgainstMedium, BowsOfThickRain) { expect_same_bows(2, 800); }

TEST(DropsAgainstMedium, TheSunThroughTheBox) {
  SceneSettings scene = scene_of(box_file(0.5, Vec3(0, 25, 0), Vec3(60, 10, 60), 10), 0);
  scene.sun.azimuth_deg = 0;
  scene.camera.fov_deg = 70;
  expect_agreement(compared(scene, 1200, 2, "sun", 44));
}

TEST(DropsAgainstMedium, TheShadowOfTheBox) {
  SceneSettings scene = scene_of(box_file(1, Vec3(0, 0, 10), Vec3(12, 12, 8), 8), 55);
  SurfaceSettings ground;
  ground.shape.type = "plane";
  ground.material.albedo = {0.5};
  scene.surfaces.push_back(ground);
  scene.camera = {.type = "orthographic", .position_m = Vec3(0, 6, 30), .elevation_deg = -90, .width_m = 32, .width_px = 48, .height_px = 48};
  expect_agreement(compared(scene, 400, 0, "sun", 180));
}

}  // namespace arcus::render
