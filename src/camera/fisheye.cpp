#include "src/camera/fisheye.h"

#include <algorithm>

namespace arcus::render {

Fisheye::Fisheye(const CameraSettings& settings)
    : frame_(settings),
      width_px_(settings.width_px),
      height_px_(settings.height_px),
      widest_rad_(radians(settings.fov_deg) / 2),
      rad_per_pixel_(widest_rad_ / (0.5 * std::min(width_px_, height_px_))) {}

std::optional<media::Ray> Fisheye::ray(double x, double y) const {
  const double right = x - 0.5 * width_px_, up = 0.5 * height_px_ - y;
  const double radius_px = std::hypot(right, up);
  const double angle = radius_px * rad_per_pixel_;
  if (angle > widest_rad_ * (1 + 1e-14)) return std::nullopt;
  const double scale = radius_px > 0 ? std::sin(angle) / radius_px : 0;
  return media::Ray{frame_.position_m, frame_.to_world(right * scale, up * scale, std::cos(angle))};
}

std::optional<ImagePoint> Fisheye::image_point(const Vec3& point_m) const {
  const Vec3 v = frame_.to_view(point_m - frame_.position_m);
  const double sideways = std::hypot(v.x, v.y);
  const double angle = std::atan2(sideways, v.z);
  if (squared_length(v) == 0 || angle > widest_rad_ * (1 + 1e-14)) return std::nullopt;
  const double scale = sideways > 0 ? angle / (rad_per_pixel_ * sideways) : 0;
  return if_on_picture(0.5 * width_px_ + v.x * scale, 0.5 * height_px_ - v.y * scale, width_px_,
                       height_px_);
}

}  // namespace arcus::render
