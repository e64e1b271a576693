#include "src/shape/terrain.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "phase/base/error.h"
#include "phase/base/random.h"
#include "phase/base/whole_file.h"
#include "src/film/image_file.h"
#include "src/scene/build_scene.h"
#include "src/scene/fingerprint.h"
#include "src/shape/surfaces.h"
#include "tests/src/plain_png.h"

namespace arcus::render {
namespace {

constexpr int width = 9, height = 6;

Raster hills() {
  Raster raster{width, height, 1, {}};
  Random random(11, 0, 0);
  for (int i = 0; i < width * height; ++i) raster.values.push_back(random.uniform());
  return raster;
}

/// 9 x 6 pixels of 10 m.
const TerrainPlace somewhere{Vec3(2000, -500, 30), 90, 60, 5, 25};

Surfaces of(const Terrain& terrain, bool is_exhaustive = false) {
  SurfaceParts parts;
  PieceGroup group;
  group.terrain = std::make_shared<const Terrain>(terrain);
  parts.add(std::move(group), Material(Matte(0.5)));
  return Surfaces(std::move(parts), is_exhaustive);
}

}  // namespace

TEST(Terrain, RaysStraightDownFindTheHeights) {
  const Raster raster = hills();
  const Terrain terrain(raster, somewhere);
  const Surfaces surfaces = of(terrain);
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) {
      // The first row is in the north, the first column in the west.
      const double x = 2000 - 45 + 10 * (column + 0.5), y = -500 + 30 - 10 * (row + 0.5);
      const double expected = 30 + 5 + 20 * static_cast<double>(raster.at(column, row)[0]);
      // A hair beside the corner: there six triangles meet.
      const auto hit = surfaces.nearest_hit({Vec3(x + 1e-6, y + 3e-6, 1000), Vec3(0, 0, -1)});
      ASSERT_TRUE(hit);
      EXPECT_NEAR(hit->position_m.z, expected, 1e-4);
      EXPECT_GT(hit->normal.z, 0);
      EXPECT_FALSE(hit->from_inside);
      EXPECT_NEAR(*terrain.height_m(x, y), expected, 1e-9);
    }
}

TEST(Terrain, HeightsBetweenAreThoseThatRaysMeet) {
  const Terrain terrain(hills(), somewhere);
  const Surfaces quick = of(terrain), slow = of(terrain, true);
  Random random(5, 0, 0);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 above(2000 + 94 * (random.uniform_double() - 0.5), -500 + 64 * (random.uniform_double() - 0.5), 100);
    const auto expected = terrain.height_m(above.x, above.y);
    const auto hit = quick.nearest_hit({above, Vec3(0, 0, -1)}), asked = slow.nearest_hit({above, Vec3(0, 0, -1)});
    ASSERT_EQ(hit.has_value(), expected.has_value()) << above.x << ' ' << above.y;
    ASSERT_EQ(asked.has_value(), expected.has_value());
    if (!hit) continue;
    EXPECT_NEAR(hit->position_m.z, *expected, 1e-9);
    EXPECT_NEAR(asked->position_m.z, *expected, 1e-9);
  }
}

TEST(Terrain, EdgesAreAsHighAsTheirPixels) {
  const Raster raster = hills();
  const Terrain terrain(raster, somewhere);
  EXPECT_NEAR(*terrain.height_m(2000 - 45, -500 + 30), 35 + 20 * static_cast<double>(raster.at(0, 0)[0]), 1e-9);
  EXPECT_NEAR(*terrain.height_m(2000 + 45, -500 - 30), 35 + 20 * static_cast<double>(raster.at(width - 1, height - 1)[0]), 1e-9);
  EXPECT_FALSE(terrain.height_m(2000 - 45.01, -500));
  const media::Box box = terrain.bounds_m();
  EXPECT_DOUBLE_EQ(box.low.x, 1955);
  EXPECT_DOUBLE_EQ(box.high.y, -470);
  EXPECT_NEAR(box.low.z, 35 + 20 * static_cast<double>(*std::min_element(raster.values.begin(), raster.values.end())), 1e-5);
}

TEST(Terrain, ShadowsAtALowSunHaveTheirLength) {
  // A wall of 40 m from south to north on flat land, one pixel of 1 m, its crest in the pixel's middle; the sun in the west, 5 degrees high.
  Raster raster{1001, 5, 1, std::vector<float>(5005, 0.f)};
  for (int row = 0; row < 5; ++row) raster.values[static_cast<std::size_t>(row) * 1001 + 200] = 1;
  const Surfaces surfaces = of(Terrain(raster, {Vec3(0, 0, 0), 1001, 5, 0, 40}));
  const double crest_x = -300, shadow_m = 40 / std::tan(radians(5));
  const auto is_in_shadow = [&](double x) {
    const auto ground = surfaces.nearest_hit({Vec3(x, 0.3, 100), Vec3(0, 0, -1)});
    return surfaces.is_blocked({ground->position_m, direction_of(270, 5)}, ground->departure(false));
  };
  double lit = crest_x + 700, dark = crest_x + 2;
  ASSERT_TRUE(is_in_shadow(dark));
  ASSERT_FALSE(is_in_shadow(lit));
  while (lit - dark > 1e-6) (is_in_shadow(0.5 * (lit + dark)) ? dark : lit) = 0.5 * (lit + dark);
  EXPECT_NEAR(lit - crest_x, shadow_m, 1e-3);
}

class TerrainFile : public testing::Test {
 protected:
  ~TerrainFile() override { std::filesystem::remove(file_); }
  std::string file_ = testing::TempDir() + "arcus_heights_" + std::to_string(::getpid()) + ".png";

  SceneSettings settings() const {
    SceneSettings scene;
    scene.path = "test.toml";
    scene.camera.position_m = Vec3(0, 0, 500);
    scene.surfaces.resize(1);
    scene.surfaces[0].name = "hills";
    scene.surfaces[0].shape.type = "terrain";
    scene.surfaces[0].shape.file = file_;
    scene.surfaces[0].shape.high_m = 65535;
    return scene;
  }
};

TEST_F(TerrainFile, AllSixteenBitsOfAPngCount) {
  std::vector<std::uint16_t> values;
  for (int i = 0; i < 12; ++i) values.push_back(static_cast<std::uint16_t>(20000 + 257 * i + (i % 2)));
  write_whole_file(file_, plain_png(4, 3, 16, values));
  const Raster read = read_heights(file_, "test");
  ASSERT_EQ(read.width, 4);
  ASSERT_EQ(read.height, 3);
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_NEAR(static_cast<double>(read.values[i]) * 65535, values[i], 0.01);
  const Scene scene = build_scene([&] {
    SceneSettings settings = this->settings();
    settings.camera.position_m.z = 1e5;
    return settings;
  }(), {});
  const auto hit = scene.surfaces.nearest_hit({Vec3(-375 + 1e-4, 333.3, 9e4), Vec3(0, 0, -1)});
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->position_m.z, 20000, 1);
}

TEST_F(TerrainFile, CamerasBelowTheLandAreRefused) {
  write_whole_file(file_, plain_png(2, 2, 16, {600, 600, 600, 600}));
  SceneSettings scene = settings();
  try {
    build_scene(scene, {});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::input);
    EXPECT_NE(std::string(error.what()).find("100 m below the land of surface 'hills'"), std::string::npos) << error.what();
  }
  scene.camera.position_m.z = 601;
  EXPECT_NO_THROW(build_scene(scene, {}));
  scene.camera.position_m = Vec3(501, 0, 5);  // beside it
  EXPECT_NO_THROW(build_scene(scene, {}));
}

TEST_F(TerrainFile, IsPartOfTheScenesIdentity) {
  write_whole_file(file_, plain_png(2, 2, 16, {600, 600, 600, 600}));
  const std::string before = scene_fingerprint(settings());
  write_whole_file(file_, plain_png(2, 2, 16, {600, 600, 600, 601}));
  EXPECT_NE(scene_fingerprint(settings()), before);
}

}  // namespace arcus::render
