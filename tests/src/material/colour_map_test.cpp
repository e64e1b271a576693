#include "src/material/colour_map.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "phase/base/error.h"
#include "phase/base/whole_file.h"
#include "src/film/image_file.h"
#include "src/material/material.h"
#include "src/scene/build_scene.h"
#include "src/scene/colour_basis.h"
#include "src/scene/fingerprint.h"
#include "src/shape/terrain.h"
#include "tests/src/plain_png.h"

namespace arcus::render {
namespace {

class TextureFile : public testing::Test {
 protected:
  ~TextureFile() override {
    std::filesystem::remove(file_);
    std::filesystem::remove(exr_);
  }
  std::string file_ = testing::TempDir() + "arcus_texture_" + std::to_string(::getpid()) + ".png", exr_ = file_ + ".exr";

  SceneSettings settings() const {
    SceneSettings scene;
    scene.path = "test.toml";
    scene.surfaces.resize(1);
    scene.surfaces[0].name = "ground";
    scene.surfaces[0].material.pattern = "image";
    scene.surfaces[0].material.image = file_;
    scene.surfaces[0].material.image_size_m = {30, 20};
    scene.surfaces[0].material.image_centre_m = {100, 50};
    return scene;
  }
  void expect_refused(const SceneSettings& scene, const std::string& part) const {
    try {
      build_scene(scene, {});
      FAIL() << part;
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::input);
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  }
};

}  // namespace

TEST_F(TextureFile, LiesOnTheGroundWithNorthAtItsTop) {
  // 3 x 2 pixels of 10 m: red, green, blue in the north, white, black, grey of code 128 in the south.
  write_whole_file(file_, plain_png(3, 2, 8, {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255, 0, 0, 0, 128, 128, 128}));
  const auto basis = std::make_shared<const ThreeSpectra>(reflectance_basis());
  const ColourMap map(read_colours(file_, "test"), basis, {100, 50, 30, 20});
  const auto expect = [&](double x, double y, float r, float g, float b) {
    const auto rgb = map.at(Vec3(x, y, 7));
    EXPECT_NEAR(rgb[0], r, 1e-6) << x << ' ' << y;
    EXPECT_NEAR(rgb[1], g, 1e-6) << x << ' ' << y;
    EXPECT_NEAR(rgb[2], b, 1e-6) << x << ' ' << y;
  };
  const float grey = 0.2158605f;  // ((128/255 + 0.055)/1.055)^2.4
  expect(90, 55, 1, 0, 0);
  expect(100, 55, 0, 1, 0);
  expect(110, 55, 0, 0, 1);
  expect(90, 45, 1, 1, 1);
  expect(100, 45, 0, 0, 0);
  expect(110, 45, grey, grey, grey);
  expect(95, 55, 0.5f, 0.5f, 0);    // between red and green
  expect(90, 50, 1, 0.5f, 0.5f);    // between red and white
  expect(115, 55, 0.5f, 0, 0.5f);   // from blue over the edge to the next copy's red
  expect(90, 55 - 20 * 1e6, 1, 0, 0);
  expect(90 - 30 * 7, 55 + 20, 1, 0, 0);
  expect(100, 40, 0, 0.5f, 0);      // from black over the edge to the next copy's green
}

TEST_F(TextureFile, CoversATerrainOfTheSamePlace) {
  // The same picture as heights and as colours: what is high is bright, at the middles of all pixels.
  const std::vector<std::uint16_t> values{10, 200, 90, 40, 250, 130};
  write_whole_file(file_, plain_png(3, 2, 8, values));
  const auto basis = std::make_shared<const ThreeSpectra>(reflectance_basis());
  const ColourMap map(read_colours(file_, "test"), basis, {100, 50, 30, 20});
  const Terrain terrain(read_heights(file_, "test"), {Vec3(100, 50, 0), 30, 20, 0, 255});
  for (int row = 0; row < 2; ++row)
    for (int column = 0; column < 3; ++column) {
      const Vec3 place(90 + 10 * column, 55 - 10 * row, 0);
      const double code = *terrain.height_m(place.x, place.y) / 255;
      EXPECT_NEAR(code * 255, values[static_cast<std::size_t>(3 * row + column)], 1e-3);
      EXPECT_NEAR(static_cast<double>(map.at(place)[1]), code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4), 1e-6);
    }
}

TEST_F(TextureFile, AScenesMaterialHasItsColoursExactly) {
  Image picture(1, 1, {"R", "G", "B"});
  picture.values() = {0.8f, 0.2f, 0.05f};
  write_exr(exr_, picture);
  SceneSettings scene = settings();
  scene.surfaces[0].material.image = exr_;
  const Scene built = build_scene(scene, {});
  const Albedo albedo = built.surfaces.materials()[0].matte()->albedo_at(Vec3(3, 4, 0));
  const Rgb rgb = to_rgb_from_white(equal_energy_white())(xyz_of([&](double nm) { return albedo.at(nm); }));
  EXPECT_NEAR(rgb.r, 0.8, 1e-5);
  EXPECT_NEAR(rgb.g, 0.2, 1e-5);
  EXPECT_NEAR(rgb.b, 0.05, 1e-5);
  const Wavelengths some{{450, 520, 600, 700}};
  for (int i = 0; i < wavelength_count; ++i) EXPECT_NEAR(albedo.at(some)[i], albedo.at(static_cast<double>(some[i])), 1e-6);
  for (double nm = 380; nm <= 780; ++nm) {
    EXPECT_GE(albedo.at(nm), 0);
    EXPECT_LE(albedo.at(nm), 1);
  }
}

TEST_F(TextureFile, GreyIsTheSameAtEveryWavelength) {
  write_whole_file(file_, plain_png(1, 1, 16, {32768}));
  const Scene built = build_scene(settings(), {});
  const Albedo albedo = built.surfaces.materials()[0].matte()->albedo_at(Vec3(0));
  const double expected = std::pow((32768.0 / 65535 + 0.055) / 1.055, 2.4);
  for (double nm = 380; nm <= 780; nm += 10) EXPECT_NEAR(albedo.at(nm), expected, 1e-5);
}

TEST_F(TextureFile, WhatIsNoReflectanceIsRefused) {
  expect_refused(settings(), "no file");
  Image picture(2, 1, {"R", "G", "B"});
  SceneSettings scene = settings();
  scene.surfaces[0].material.image = exr_;
  picture.values() = {0.8f, 0.2f, 0.05f, 0, 1.5f, 0};
  write_exr(exr_, picture);
  expect_refused(scene, "1.5 in column 1, row 0");
  picture.values()[4] = -0.1f;
  write_exr(exr_, picture);
  expect_refused(scene, "-0.1");
}

TEST_F(TextureFile, IsPartOfTheScenesIdentity) {
  write_whole_file(file_, plain_png(1, 1, 8, {100}));
  const std::string before = scene_fingerprint(settings());
  write_whole_file(file_, plain_png(1, 1, 8, {101}));
  EXPECT_NE(scene_fingerprint(settings()), before);
}

TEST_F(TextureFile, AlbedoFileIsFollowed) {
  std::ofstream(file_) << "nm,share\n400,0.1\n500,0.3\n700,0.9\n";
  SceneSettings scene = settings();
  scene.surfaces[0].material = {.albedo_file = file_};
  const Scene built = build_scene(scene, {});
  const Albedo albedo = built.surfaces.materials()[0].matte()->albedo_at(Vec3(0));
  EXPECT_NEAR(albedo.at(450), 0.2, 1e-12);
  EXPECT_NEAR(albedo.at(Wavelengths{{380, 450, 600, 780}})[2], 0.6, 1e-6);
  const std::string before = scene_fingerprint(scene);
  std::ofstream(file_) << "nm,share\n400,0.1\n500,1.3\n";
  EXPECT_NE(scene_fingerprint(scene), before);
  expect_refused(scene, "a share of 1.3");
  std::ofstream(file_) << "400 0.1 3\n500 0.3 4\n";
  expect_refused(scene, "3 columns");
}

}  // namespace arcus::render
