#pragma once
// Axes of a camera in the world.

#include <cmath>

#include "phase/base/frame.h"
#include "src/camera/camera.h"

namespace arcus::render {

struct ViewFrame {
  Vec3 position_m, right, up, forward;

  explicit ViewFrame(const CameraSettings& settings)
      : position_m(settings.position_m),
        // From the azimuth and not from a cross product with the vertical: defined also straight up
        // and down.
        right(std::cos(radians(settings.azimuth_deg)), -std::sin(radians(settings.azimuth_deg)), 0),
        forward(direction_of(settings.azimuth_deg, settings.elevation_deg)) {
    up = cross(right, forward);
  }
  /// The vector with these components along right, up and forward.
  Vec3 to_world(double x, double y, double z) const { return right * x + up * y + forward * z; }
  /// Components of a vector along right, up and forward.
  Vec3 to_view(const Vec3& v) const { return {dot(v, right), dot(v, up), dot(v, forward)}; }
};

/// The point where it lies on a picture of that size, its border included.
inline std::optional<ImagePoint> if_on_picture(double x, double y, int width_px, int height_px) {
  if (!(x >= 0 && x <= width_px && y >= 0 && y <= height_px)) return std::nullopt;
  return ImagePoint{x, y};
}

}  // namespace arcus::render
