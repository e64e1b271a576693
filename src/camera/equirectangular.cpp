#include "src/camera/equirectangular.h"

namespace arcus::render {

Equirectangular::Equirectangular(const CameraSettings& settings)
    : frame_(settings),
      width_px_(settings.width_px),
      height_px_(settings.height_px),
      rad_per_pixel_(radians(settings.fov_deg) / settings.width_px) {}

std::optional<media::Ray> Equirectangular::ray(double x, double y) const {
  const double longitude = (x - 0.5 * width_px_) * rad_per_pixel_;
  const double latitude = (0.5 * height_px_ - y) * rad_per_pixel_;
  // The first and last row may begin at a pole, give or take rounding.
  if (std::fabs(latitude) > pi / 2 * (1 + 1e-14)) return std::nullopt;
  return media::Ray{frame_.position_m,
                    frame_.to_world(std::sin(longitude) * std::cos(latitude), std::sin(latitude),
                                    std::cos(longitude) * std::cos(latitude))};
}

std::optional<ImagePoint> Equirectangular::image_point(const Vec3& point_m) const {
  const Vec3 v = frame_.to_view(point_m - frame_.position_m);
  if (squared_length(v) == 0) return std::nullopt;
  const double longitude = std::atan2(v.x, v.z);
  const double latitude = std::atan2(v.y, std::hypot(v.x, v.z));
  return if_on_picture(0.5 * width_px_ + longitude / rad_per_pixel_,
                       0.5 * height_px_ - latitude / rad_per_pixel_, width_px_, height_px_);
}

}  // namespace arcus::render
