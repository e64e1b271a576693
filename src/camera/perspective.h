#pragma once
// A pinhole camera: straight lines stay straight.

#include "src/camera/camera.h"
#include "src/camera/view_frame.h"

namespace arcus::render {

class Perspective : public Camera {
 public:
  explicit Perspective(const CameraSettings& settings);
  std::optional<media::Ray> ray(double x, double y) const override;
  std::optional<ImagePoint> image_point(const Vec3& point_m) const override;

 private:
  ViewFrame frame_;
  int width_px_, height_px_;
  double pixels_per_tangent_;  ///< focal length in pixels
};

}  // namespace arcus::render
