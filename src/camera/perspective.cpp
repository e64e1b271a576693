#include "src/camera/perspective.h"

namespace arcus::render {

Perspective::Perspective(const CameraSettings& settings)
    : frame_(settings),
      width_px_(settings.width_px),
      height_px_(settings.height_px),
      pixels_per_tangent_(0.5 * settings.width_px / std::tan(radians(settings.fov_deg) / 2)) {}

std::optional<media::Ray> Perspective::ray(double x, double y) const {
  const Vec3 direction =
      frame_.to_world(x - 0.5 * width_px_, 0.5 * height_px_ - y, pixels_per_tangent_);
  return media::Ray{frame_.position_m, normalize(direction)};
}

std::optional<ImagePoint> Perspective::image_point(const Vec3& point_m) const {
  const Vec3 v = frame_.to_view(point_m - frame_.position_m);
  if (!(v.z > 0)) return std::nullopt;
  return if_on_picture(0.5 * width_px_ + pixels_per_tangent_ * v.x / v.z,
                       0.5 * height_px_ - pixels_per_tangent_ * v.y / v.z, width_px_, height_px_);
}

}  // namespace arcus::render
