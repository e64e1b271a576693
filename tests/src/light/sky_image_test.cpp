#include "src/light/sky_image.h"

#include <gtest/gtest.h>

#include "phase/base/frame.h"
#include "phase/base/random.h"
#include "src/camera/equirectangular.h"
#include "tests/src/sky_pictures.h"
#include "tests/statistics/seed.h"

namespace arcus::render {
namespace {

/// Nine decades of brightness, and black.
Raster contrasty() {
  Random random(3, 0, 0);
  return sky_raster(8, [&](int, int) { return random.uniform() < 0.2f ? 0 : std::pow(10.0, 9 * random.uniform_double() - 5); });
}

}  // namespace

TEST(SkyImage, PixelsAreWhereTheCameraHasThem) {
  Raster raster = sky_raster(16, [](int column, int row) { return 1 + column + 100 * row; });
  const SkyImage sky(raster, flat_basis(), 77);
  const Equirectangular camera({.type = "equirectangular", .azimuth_deg = 77, .fov_deg = 360, .width_px = 32, .height_px = 16});
  for (int row = 0; row < 16; ++row)
    for (int column = 0; column < 32; ++column)
      for (const double part : {0.001, 0.5, 0.999}) {
        const auto ray = camera.ray(column + part, row + 1 - part);
        ASSERT_TRUE(ray);
        EXPECT_NEAR(sky.radiance(ray->direction, {{400, 500, 600, 700}})[2], 1 + column + 100 * row, 1e-3);
      }
  // North-east of south, a little above the horizon: to the left of the middle of a picture that looks south.
  const SkyImage south(sky_raster(2, [](int column, int row) { return column == 1 && row == 0 ? 5 : 1; }), flat_basis(), 180);
  EXPECT_NEAR(south.radiance(direction_of(135, 10), {{400, 500, 600, 700}})[0], 5, 1e-5);
}

TEST(SkyImage, DrawsInProportionToWhatExceedsTwiceTheMean) {
  const Raster raster = contrasty();
  const SkyImage sky(raster, flat_basis(), 30);
  const auto pixel_of = [&](const Vec3& direction) {
    const double azimuth = std::atan2(direction.x, direction.y) - radians(30);
    const double turn = azimuth / (2 * pi) + 0.5, elevation = std::asin(direction.z);
    return static_cast<std::size_t>((0.5 - elevation / pi) * 8) * 16 + static_cast<std::size_t>((turn - std::floor(turn)) * 16);
  };
  std::vector<double> expected(raster.pixels());
  double all = 0;  // the light of the sphere
  for (int row = 0; row < 8; ++row)
    for (int column = 0; column < 16; ++column) {
      const double solid_angle = (std::cos(pi * row / 8) - std::cos(pi * (row + 1) / 8)) * 2 * pi / 16;
      all += static_cast<double>(raster.at(column, row)[0]) * solid_angle;
    }
  const auto excess = [&](std::size_t pixel) { return std::max(0.0, static_cast<double>(raster.values[3 * pixel]) - 2 * all / (4 * pi)); };
  for (std::size_t pixel = 0; pixel < expected.size(); ++pixel) {
    const auto row = static_cast<double>(pixel / 16);
    expected[pixel] = excess(pixel) * (std::cos(pi * row / 8) - std::cos(pi * (row + 1) / 8)) * 2 * pi / 16;
  }
  std::vector<double> found(raster.pixels());
  constexpr int count = 1000000;
  Random random(statistics::test_seed(), 0, 0);
  double mean_sine = 0;
  for (int i = 0; i < count; ++i) {
    const auto drawn = sky.draw(random.uniform_double(), random.uniform_double());
    if (!drawn) continue;
    const Vec3 direction = *drawn;
    EXPECT_NEAR(length(direction), 1, 1e-12);
    const std::size_t pixel = pixel_of(direction);
    ++found[pixel];
    ASSERT_NEAR(sky.density_per_sr(direction), excess(pixel) / all, 3e-5 * excess(pixel) / all);
    mean_sine += direction.z;
  }
  double chi2 = 0, degrees = -1, wrong = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double e = expected[i] / all * count, w = expected[(i + 1) % found.size()] / all * count;
    if (expected[i] == 0) {
      EXPECT_EQ(found[i], 0);
    }
    if (e < 10) continue;
    chi2 += (found[i] - e) * (found[i] - e) / e;
    if (w > 10) wrong += (found[i] - w) * (found[i] - w) / w;
    ++degrees;
  }
  ASSERT_GT(degrees, 5);
  EXPECT_LT(chi2, degrees + 5 * std::sqrt(2 * degrees));
  EXPECT_GT(wrong, degrees + 50 * std::sqrt(2 * degrees));
  // Within the pixels uniform in solid angle: the mean of z has a closed form.
  double closed = 0;
  for (int row = 0; row < 8; ++row)
    for (int column = 0; column < 16; ++column)
      closed += expected[static_cast<std::size_t>(row * 16 + column)] / all * 0.5 * (std::cos(pi * row / 8) + std::cos(pi * (row + 1) / 8));
  EXPECT_NEAR(mean_sine / count, closed, 5 / std::sqrt(count));
}

TEST(SkyImage, DensityIntegratesToHowOftenItIsAsked) {
  const SkyImage sky(contrasty(), flat_basis(), 0);
  double sum = 0, asked = 0;
  Random random(statistics::test_seed(), 1, 0);
  for (int i = 0; i < 100000; ++i) asked += sky.draw(random.uniform_double(), random.uniform_double()).has_value();
  for (int row = 0; row < 8; ++row)
    for (int column = 0; column < 16; ++column)
      sum += sky.density_per_sr(direction_of(22.5 * (column + 0.5) - 180, 90 - 22.5 * (row + 0.5))) *
             (std::cos(pi * row / 8) - std::cos(pi * (row + 1) / 8)) * 2 * pi / 16;
  EXPECT_NEAR(asked / 100000, sum, 5 * std::sqrt(sum * (1 - sum) / 100000));
  EXPECT_GT(sum, 0.5);
  EXPECT_LT(sum, 0.99);
}

TEST(SkyImage, EvenSkiesAreNotAsked) {
  EXPECT_FALSE(SkyImage(sky_raster(8, [](int, int) { return 3; }), flat_basis(), 0).is_asked());
  EXPECT_FALSE(SkyImage(sky_raster(8, [](int, int row) { return row < 4 ? 3 : 0; }), flat_basis(), 0).is_asked());
  EXPECT_TRUE(SkyImage(sky_raster(8, [](int column, int row) { return column == 3 && row == 2 ? 30 : 3; }), flat_basis(), 0).is_asked());
}

}  // namespace arcus::render
