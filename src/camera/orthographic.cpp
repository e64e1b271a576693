#include "src/camera/orthographic.h"

namespace arcus::render {

Orthographic::Orthographic(const CameraSettings& settings)
    : frame_(settings),
      width_px_(settings.width_px),
      height_px_(settings.height_px),
      m_per_pixel_(settings.width_m / settings.width_px) {}

std::optional<media::Ray> Orthographic::ray(double x, double y) const {
  const Vec3 offset = frame_.to_world((x - 0.5 * width_px_) * m_per_pixel_,
                                      (0.5 * height_px_ - y) * m_per_pixel_, 0);
  return media::Ray{frame_.position_m + offset, frame_.forward};
}

std::optional<ImagePoint> Orthographic::image_point(const Vec3& point_m) const {
  const Vec3 v = frame_.to_view(point_m - frame_.position_m);
  if (v.z < 0) return std::nullopt;
  return if_on_picture(0.5 * width_px_ + v.x / m_per_pixel_, 0.5 * height_px_ - v.y / m_per_pixel_,
                       width_px_, height_px_);
}

}  // namespace arcus::render
