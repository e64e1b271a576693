#pragma once
// A view from infinitely far: all rays are parallel, and start in the plane of the picture.

#include "src/camera/camera.h"
#include "src/camera/view_frame.h"

namespace arcus::render {

class Orthographic : public Camera {
 public:
  explicit Orthographic(const CameraSettings& settings);
  std::optional<media::Ray> ray(double x, double y) const override;
  std::optional<ImagePoint> image_point(const Vec3& point_m) const override;

 private:
  ViewFrame frame_;
  int width_px_, height_px_;
  double m_per_pixel_;
};

}  // namespace arcus::render
