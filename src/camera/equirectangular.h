#pragma once
// A panorama: columns are equally spaced in longitude, rows in latitude, both counted from the
// viewing direction and about the camera's up. With elevation 0 they are compass azimuth and
// elevation. Pixels are square, so a field of view of 360 degrees and a width of twice the height
// show the whole sphere; rows beyond the poles show nothing.

#include "src/camera/camera.h"
#include "src/camera/view_frame.h"

namespace arcus::render {

class Equirectangular : public Camera {
 public:
  explicit Equirectangular(const CameraSettings& settings);
  std::optional<media::Ray> ray(double x, double y) const override;
  std::optional<ImagePoint> image_point(const Vec3& point_m) const override;

 private:
  ViewFrame frame_;
  int width_px_, height_px_;
  double rad_per_pixel_;
};

}  // namespace arcus::render
