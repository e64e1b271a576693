#pragma once
// An equidistant fisheye: the distance from the centre of the picture is proportional to the angle
// from the viewing direction. The angle of view fills the largest circle around the centre that
// fits on the picture; outside it the picture shows nothing.

#include "src/camera/camera.h"
#include "src/camera/view_frame.h"

namespace arcus::render {

class Fisheye : public Camera {
 public:
  explicit Fisheye(const CameraSettings& settings);
  std::optional<media::Ray> ray(double x, double y) const override;
  std::optional<ImagePoint> image_point(const Vec3& point_m) const override;

 private:
  ViewFrame frame_;
  int width_px_, height_px_;
  double widest_rad_, rad_per_pixel_;
};

}  // namespace arcus::render
