#include "src/camera/camera.h"

#include <cmath>
#include <cstdio>

#include "phase/base/error.h"
#include "phase/base/units.h"
#include "phase/settings/number_text.h"
#include "src/camera/equirectangular.h"
#include "src/camera/fisheye.h"
#include "src/camera/orthographic.h"
#include "src/camera/perspective.h"

namespace arcus::render {
namespace {

Range fov_range(const std::string& type) {
  if (type == "perspective")
    return {.low = 0, .high = 180, .low_excluded = true, .high_excluded = true};
  return above_up_to(0, 360);
}

/// What is wrong with a picture of that size; empty where nothing is.
std::string size_fault(double width_px, double height_px) {
  const double pixels = width_px * height_px;
  if (pixels <= static_cast<double>(most_pixels)) return "";
  char text[200];
  std::snprintf(
      text, sizeof text,
      "%.0f pixels, whose film takes %.1f GiB at 32 bytes a pixel (the limit: %lld pixels, %.0f GiB),",
      pixels, pixels * 32 / 0x1p30, most_pixels, static_cast<double>(most_pixels) * 32 / 0x1p30);
  return text;
}

void read_look_at(Keys& keys, CameraSettings& camera) {
  std::vector<double> target;
  keys.numbers(
      "look_at_m", target, any(), 0, 3,
      "a point [x, y, z] to look at, instead of azimuth_deg and elevation_deg; [] for none");
  if (target.empty()) return;
  if (target.size() != 3)
    keys.refuse("look_at_m", std::to_string(target.size()) + " numbers", "must be [x, y, z]");
  for (const char* other : {"azimuth_deg", "elevation_deg"})
    if (keys.is_given(other))
      keys.refuse("look_at_m", std::string(other) + " beside it", "only one of them expected");
  const Vec3 v = Vec3(target[0], target[1], target[2]) - camera.position_m;
  if (squared_length(v) == 0)
    keys.refuse("look_at_m", "the camera's own position", "another point expected");
  const double sideways = std::hypot(v.x, v.y);
  camera.azimuth_deg = sideways > 0 ? degrees(std::atan2(v.x, v.y)) : 0;
  camera.elevation_deg = degrees(std::atan2(v.z, sideways));
}

}  // namespace

double usual_fov_deg(const std::string& type) {
  if (type == "fisheye") return 180;
  return type == "equirectangular" ? 360 : 90;
}

void list_keys(Keys& keys, CameraSettings& camera) {
  keys.choice("type", camera.type, {"perspective", "orthographic", "fisheye", "equirectangular"},
              "how directions become points of the picture");
  keys.vector3("position_m", camera.position_m,
               "where the camera stands: x east, y north, z up [m]");
  keys.number("azimuth_deg", camera.azimuth_deg, any(), "compass azimuth of the viewing direction");
  keys.number("elevation_deg", camera.elevation_deg, between(-90, 90),
              "of the viewing direction above the horizon");
  read_look_at(keys, camera);
  if (camera.fov_deg == 0) camera.fov_deg = usual_fov_deg(camera.type);
  keys.number(
      "fov_deg", camera.fov_deg, keys.documents() ? fov_range("fisheye") : fov_range(camera.type),
      "angle of view across the width, usually 90 and below 180; equirectangular: usually 360; fisheye: across the full "
      "circle, usually 180");
  keys.number("width_m", camera.width_m, above(0),
              "orthographic: what the width of the picture shows [m]");
  std::vector<double> size{static_cast<double>(camera.width_px),
                           static_cast<double>(camera.height_px)};
  keys.numbers("resolution", size, between(1, static_cast<double>(most_pixels) * 1024), 2, 2,
               "width and height of the picture in pixels");
  for (const double side : size)
    if (side != std::floor(side))
      keys.refuse("resolution", number_text(side), "whole numbers expected");
  if (const std::string fault = size_fault(size[0], size[1]); !fault.empty())
    keys.refuse("resolution", fault, "a smaller picture expected");
  camera.width_px = static_cast<int>(size[0]);
  camera.height_px = static_cast<int>(size[1]);
}

std::unique_ptr<Camera> make_camera(const CameraSettings& given) {
  CameraSettings settings = given;
  if (settings.fov_deg == 0) settings.fov_deg = usual_fov_deg(settings.type);
  if (const Range range = fov_range(settings.type); !range.contains(settings.fov_deg))
    throw bad_input("camera.fov_deg", number_text(settings.fov_deg), range.words());
  if (settings.width_px < 1 || settings.height_px < 1)
    throw bad_input("camera.resolution",
                    std::to_string(settings.width_px) + " x " + std::to_string(settings.height_px),
                    "at least 1 x 1 pixel expected");
  if (const std::string fault = size_fault(settings.width_px, settings.height_px); !fault.empty())
    throw bad_input("camera.resolution", fault, "a smaller picture expected");
  if (settings.type == "perspective") return std::make_unique<Perspective>(settings);
  if (settings.type == "orthographic") return std::make_unique<Orthographic>(settings);
  if (settings.type == "fisheye") return std::make_unique<Fisheye>(settings);
  if (settings.type == "equirectangular") return std::make_unique<Equirectangular>(settings);
  throw bad_input("camera.type", "'" + settings.type + "'",
                  "perspective, orthographic, fisheye or equirectangular expected");
}

}  // namespace arcus::render
