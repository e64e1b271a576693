#include "src/camera/camera.h"

#include <gtest/gtest.h>

#include "phase/base/error.h"
#include "phase/base/frame.h"
#include "phase/base/random.h"
#include "phase/settings/toml_text.h"

namespace arcus::render {
namespace {

CameraSettings settings_of(const std::string& type, double azimuth_deg, double elevation_deg) {
  CameraSettings settings;
  settings.type = type;
  settings.position_m = {1000, -2000, 30};
  settings.azimuth_deg = azimuth_deg;
  settings.elevation_deg = elevation_deg;
  settings.width_px = 400;
  settings.height_px = 300;
  return settings;
}

void expect_near(const Vec3& a, const Vec3& b, double tolerance) {
  EXPECT_LE(length(a - b), tolerance) << a << " against " << b;
}

std::string message_of(const std::string& toml) {
  try {
    settings_from_text<CameraSettings>(toml, "scene.toml");
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::input);
    return error.what();
  }
  return "no error";
}

bool contains(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

class EveryCamera : public testing::TestWithParam<std::string> {};

TEST_P(EveryCamera, RaysGoBackToTheImagePointTheyCameFrom) {
  Random random(1, 2, 3);
  int rays = 0;
  for (const double elevation_deg : {-90.0, -33.0, 0.0, 57.0, 90.0}) {
    const CameraSettings settings = settings_of(GetParam(), 217, elevation_deg);
    const auto camera = make_camera(settings);
    for (int i = 0; i < 400; ++i) {
      const double x = 400 * random.uniform_double(), y = 300 * random.uniform_double();
      const auto ray = camera->ray(x, y);
      if (!ray) continue;
      ++rays;
      EXPECT_NEAR(length(ray->direction), 1, 1e-14);
      const auto point = camera->image_point(ray->origin_m +
                                             ray->direction * (5000 * random.uniform_double() + 1));
      ASSERT_TRUE(point) << x << " " << y;
      EXPECT_NEAR(point->x, x, 1e-7);
      EXPECT_NEAR(point->y, y, 1e-7);
    }
  }
  EXPECT_GT(rays, 800);
}

TEST_P(EveryCamera, LooksAlongAzimuthAndElevationThroughItsCentre) {
  for (const double elevation_deg : {-90.0, -10.0, 90.0}) {
    const auto ray = make_camera(settings_of(GetParam(), 70, elevation_deg))->ray(200, 150);
    ASSERT_TRUE(ray);
    expect_near(ray->direction, direction_of(70, elevation_deg), 1e-14);
    expect_near(ray->origin_m, {1000, -2000, 30}, 1e-9);
  }
}

TEST_P(EveryCamera, ShowsTheRightHandSideToTheRightAndRowZeroAtTheTop) {
  const auto camera =
      make_camera(settings_of(GetParam(), 0, 0));  // north: right is east = +x, up is +z
  const Vec3 ahead = Vec3(1000, -2000, 30) + Vec3(0, 100, 0);
  const auto right = camera->image_point(ahead + Vec3(5, 0, 0)),
             up = camera->image_point(ahead + Vec3(0, 0, 5));
  ASSERT_TRUE(right && up);
  EXPECT_GT(right->x, 200.5);
  EXPECT_NEAR(right->y, 150, 1e-9);
  EXPECT_LT(up->y, 149.5);
  EXPECT_NEAR(up->x, 200, 1e-9);
}

TEST_P(EveryCamera, LookingStraightUpWithAzimuthZeroHasEastOnTheRightAndSouthAtTheTop) {
  const auto camera = make_camera(settings_of(GetParam(), 0, 90));
  const Vec3 above = Vec3(1000, -2000, 30) + Vec3(0, 0, 100);
  const auto east = camera->image_point(above + Vec3(5, 0, 0)),
             south = camera->image_point(above + Vec3(0, -5, 0));
  ASSERT_TRUE(east && south);
  EXPECT_GT(east->x, 200.5);
  EXPECT_LT(south->y, 149.5);
}

INSTANTIATE_TEST_SUITE_P(Camera, EveryCamera,
                         testing::Values("perspective", "orthographic", "fisheye",
                                         "equirectangular"),
                         [](const auto& info) { return info.param; });

TEST(Perspective, FieldOfViewIsAcrossTheWidth) {
  CameraSettings settings = settings_of("perspective", 0, 0);
  settings.fov_deg = 60;
  const auto camera = make_camera(settings);
  EXPECT_NEAR(
      degrees(angle_between_rad(camera->ray(0, 150)->direction, camera->ray(400, 150)->direction)),
      60, 1e-10);
  EXPECT_FALSE(camera->image_point(settings.position_m + Vec3(0, -10, 0))) << "behind";
  EXPECT_FALSE(camera->image_point(settings.position_m + Vec3(10, 10, 0))) << "beside the picture";
}

TEST(Orthographic, RaysAreParallelAndWidthIsInMetres) {
  CameraSettings settings = settings_of("orthographic", 0, 0);
  settings.width_m = 80;
  const auto camera = make_camera(settings);
  const auto left = camera->ray(0, 150), right = camera->ray(400, 150);
  expect_near(right->origin_m - left->origin_m, {80, 0, 0}, 1e-9);
  EXPECT_EQ(left->direction, right->direction);
}

TEST(Fisheye, IsEquidistantInTheLargestCircleAndEmptyOutside) {
  CameraSettings settings = settings_of("fisheye", 0, 90);
  settings.fov_deg = 180;
  const auto camera = make_camera(settings);
  EXPECT_NEAR(degrees(angle_between_rad(camera->ray(200, 75)->direction, {0, 0, 1})), 45, 1e-10);
  EXPECT_NEAR(degrees(angle_between_rad(camera->ray(200, 0)->direction, {0, 0, 1})), 90, 1e-10);
  EXPECT_FALSE(camera->ray(200 + 150.001, 150));
  EXPECT_FALSE(camera->image_point(settings.position_m + Vec3(0, 10, -0.01)))
      << "below the horizon";
}

TEST(Fisheye, ThreeHundredSixtyDegreesShowTheDirectionBehind) {
  CameraSettings settings = settings_of("fisheye", 0, 0);
  settings.fov_deg = 360;
  expect_near(make_camera(settings)->ray(200, 0)->direction, {0, -1, 0}, 1e-12);
}

TEST(Equirectangular, FullPanoramaHasThePolesAtTopAndBottomAndNorthInTheMiddle) {
  CameraSettings settings = settings_of("equirectangular", 0, 0);
  settings.height_px = 200;
  const auto camera = make_camera(settings);
  expect_near(camera->ray(37, 0)->direction, {0, 0, 1}, 1e-12);
  expect_near(camera->ray(37, 200)->direction, {0, 0, -1}, 1e-12);
  expect_near(camera->ray(300, 100)->direction, {1, 0, 0}, 1e-12);
  expect_near(camera->ray(0, 100)->direction, {0, -1, 0}, 1e-12);
  settings.height_px = 300;
  EXPECT_FALSE(make_camera(settings)->ray(200, 10)) << "beyond the pole";
}

TEST(CameraSettings, LookAtBecomesAzimuthAndElevation) {
  const auto settings = settings_from_text<CameraSettings>(
      "position_m = [1, 2, 3]\nlook_at_m = [11, 12, 3]\n", "scene.toml");
  EXPECT_NEAR(settings.azimuth_deg, 45, 1e-12);
  EXPECT_NEAR(settings.elevation_deg, 0, 1e-12);
  const auto up = settings_from_text<CameraSettings>(
      "position_m = [0, 0, 0]\nlook_at_m = [0, 0, 3]\n", "scene.toml");
  EXPECT_EQ(up.elevation_deg, 90);
  EXPECT_EQ(up.azimuth_deg, 0);
  EXPECT_TRUE(contains(message_of("azimuth_deg = 3\nlook_at_m = [0, 0, 3]\n"),
                       "scene.toml:2:13: look_at_m"));
  EXPECT_TRUE(contains(message_of("look_at_m = [0, 0, 1.7]\n"), "own position"));
  EXPECT_TRUE(contains(message_of("look_at_m = [0, 1]\n"), "must be [x, y, z]"));
}

TEST(CameraSettings, WritingAndReadingGivesTheSameText) {
  const auto settings = settings_from_text<CameraSettings>(
      "type = 'fisheye'\nlook_at_m = [0.1, 7, 3]\n", "scene.toml");
  EXPECT_EQ(settings.fov_deg, 180);
  const std::string text = text_of(settings);
  EXPECT_EQ(text_of(settings_from_text<CameraSettings>(text, "copy")), text);
}

TEST(CameraSettings, ImpossiblePicturesAreBadInput) {
  EXPECT_TRUE(
      contains(message_of("resolution = [0, 100]\n"), "scene.toml:1:15: resolution: 0 found"))
      << message_of("resolution = [0, 100]\n");
  EXPECT_TRUE(contains(message_of("resolution = [10.5, 100]\n"), "whole numbers"));
  const std::string huge = message_of("resolution = [50000, 20000]\n");
  EXPECT_TRUE(contains(huge, "1000000000 pixels")) << huge;
  EXPECT_TRUE(contains(huge, "29.8 GiB")) << huge;
  EXPECT_TRUE(contains(huge, "8 GiB")) << huge;
  EXPECT_TRUE(contains(message_of("resolution = [1e12, 1e12]\n"), "found"));
  EXPECT_TRUE(contains(message_of("fov_deg = 180\n"), "above 0 and below 180"));
  EXPECT_TRUE(contains(message_of("type = 'fisheye'\nfov_deg = 361\n"), "360"));
  CameraSettings settings;
  settings.width_px = 0;
  EXPECT_THROW(make_camera(settings), Error);
  settings.width_px = settings.height_px = 1 << 30;
  EXPECT_THROW(make_camera(settings), Error);
}

}  // namespace arcus::render
