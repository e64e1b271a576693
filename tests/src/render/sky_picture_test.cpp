// A picture by the equirectangular camera as a sky: the same camera shows the same picture again.

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "phase/base/error.h"
#include "phase/base/random.h"
#include "src/film/image_file.h"
#include "src/render/picture.h"
#include "src/scene/build_scene.h"
#include "src/scene/fingerprint.h"

namespace arcus::render {
namespace {

class SkyPicture : public testing::Test {
 protected:
  SkyPicture() : file_(testing::TempDir() + "arcus_sky_" + std::to_string(::getpid()) + ".exr") {}
  ~SkyPicture() override { std::filesystem::remove(file_); }

  /// Saturated colours of four decades, and black; a channel that nobody asked for beside them.
  Image colours() const {
    Image image(16, 8, {"S0.500.0nm", "R", "G", "B"});
    Random random(5, 0, 0);
    for (float& value : image.values()) value = random.uniform() < 0.1f ? 0 : std::pow(10.f, 4 * random.uniform() - 2);
    return image;
  }
  void write(const Image& image) const { write_exr(file_, image); }

  SceneSettings settings() const {
    SceneSettings scene;
    scene.path = "test.toml";
    scene.camera = {.type = "equirectangular", .azimuth_deg = 77, .fov_deg = 360, .width_px = 16, .height_px = 8};
    scene.sun.elevation_deg = -50;
    scene.sun.angular_radius_deg = 0.01;
    scene.sky.type = "image";
    scene.sky.file = file_;
    scene.sky.azimuth_deg = 77;
    scene.film.channels = {"rgb", "variance"};
    scene.render.samples_per_pixel = 256;
    scene.render.max_bounces = 0;
    return scene;
  }
  const std::string& file() const { return file_; }
  void expect_refused(const SceneSettings& scene, const std::string& part) const {
    try {
      build_scene(scene, {});
      FAIL() << part;
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::input);
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  }

 private:
  std::string file_;
};

}  // namespace

TEST_F(SkyPicture, ComesBackWithItsColours) {
  const Image given = colours();
  write(given);
  for (const std::string white : {"auto", "equal_energy", "D65", "2500", "20000"}) {
    SceneSettings scene = settings();
    scene.film.white = white;
    scene.sky.scale = 2;
    if (white == "equal_energy") scene.sun.irradiance_scale = 0;
    const Image shown = render_picture(scene, build_scene(scene, {}), std::nullopt, {}, "").image;
    double worst = 0, sum_of_errors = 0, sum = 0;
    for (int row = 0; row < 8; ++row)
      for (int column = 0; column < 16; ++column)
        for (const char* const channel : {"R", "G", "B"}) {
          const double expected = 2 * static_cast<double>(given.value(column, row, *given.channel(channel)));
          const double found = static_cast<double>(shown.value(column, row, *shown.channel(channel)));
          const double error = std::sqrt(static_cast<double>(shown.value(column, row, *shown.channel("variance." + std::string(channel)))));
          const double brightest = 2 * static_cast<double>(std::max({given.value(column, row, 1), given.value(column, row, 2), given.value(column, row, 3)}));
          // Wavelengths are spread evenly over a pixel's samples: the noise is less than that of independent ones.
          EXPECT_NEAR(found, expected, 5 * error + 1e-5 * brightest) << white << ' ' << column << ' ' << row << channel;
          if (brightest > 0) worst = std::max(worst, std::fabs(found - expected) / brightest);
          sum_of_errors += std::fabs(found - expected);
          sum += expected;
        }
    EXPECT_LT(sum_of_errors / sum, 0.01) << white;
    RecordProperty("worst_over_brightest_channel_" + white, std::to_string(worst));
  }
}

TEST_F(SkyPicture, TurnsWithItsAzimuth) {
  write(colours());
  SceneSettings scene = settings();
  const Image one = render_picture(scene, build_scene(scene, {}), std::nullopt, {}, "").image;
  scene.sky.azimuth_deg += 22.5;  // a column
  const Image other = render_picture(scene, build_scene(scene, {}), std::nullopt, {}, "").image;
  for (int column = 0; column < 15; ++column) {
    const float a = one.value(column, 3, 1), b = other.value(column + 1, 3, 1);
    EXPECT_NEAR(a, b, 0.15f * std::max(a, b) + 0.15f);
  }
}

TEST_F(SkyPicture, IsPartOfTheScenesIdentity) {
  Image image = colours();
  write(image);
  const std::string before = scene_fingerprint(settings());
  EXPECT_EQ(scene_fingerprint(settings()), before);
  image.value(3, 3, 1) += 1;
  write(image);
  EXPECT_NE(scene_fingerprint(settings()), before);
}

TEST_F(SkyPicture, WhatIsNoSkyIsRefused) {
  expect_refused(settings(), "no file");
  write(Image(15, 8, {"R", "G", "B"}));
  expect_refused(settings(), "15 x 8 pixels");
  write(Image(16, 8, {"R", "G", "B"}));
  expect_refused(settings(), "no light");
  Image image = colours();
  image.value(4, 2, 2) = -1e-3f;
  write(image);
  expect_refused(settings(), "1 negative values, the first in column 4, row 2");
  SceneSettings clipped = settings();
  clipped.sky.clips_negative = true;
  EXPECT_EQ(build_scene(clipped, {}).sky.radiance(direction_of(0, 0), {{400, 500, 600, 700}}).min() >= 0, true);
  image.value(5, 6, 3) = std::numeric_limits<float>::quiet_NaN();
  write(image);
  expect_refused(clipped, "not finite in column 5, row 6");
}

}  // namespace arcus::render
