#pragma once
// The eye: which ray belongs to a point of the picture, and back.
//
// Points of the picture are in pixels, x to the right and y down from the top left corner; the
// centre of the pixel in column i and row j is (i + 1/2, j + 1/2). The camera looks along f =
// direction_of(azimuth, elevation), its right is r = (cos az, -sin az, 0) and its up is r x f, also
// straight up and down.

#include <memory>
#include <optional>
#include <string>

#include "media/space/ray.h"
#include "phase/base/vec3.h"
#include "phase/settings/keys.h"

namespace arcus::render {

struct CameraSettings {
  std::string type = "perspective";  ///< perspective | orthographic | fisheye | equirectangular
  Vec3 position_m{0, 0, 1.7};
  double azimuth_deg = 0;    ///< compass azimuth of the viewing direction
  double elevation_deg = 0;  ///< of the viewing direction, -90 to 90
  /// Angle of view: across the width (perspective, equirectangular) or across the full circle
  /// (fisheye). 0: the type's usual one, see usual_fov_deg.
  double fov_deg = 0;
  double width_m = 1000;  ///< orthographic: what the width of the picture shows
  int width_px = 960, height_px = 640;
};
/// Keys as in the scene file; `look_at_m` is turned into azimuth and elevation when it is read.
void list_keys(Keys& keys, CameraSettings& camera);

/// 90 for perspective, 180 for fisheye (the hemisphere), 360 for equirectangular.
double usual_fov_deg(const std::string& type);

/// Pictures have at most this many pixels: a film of 32 bytes a pixel then takes 8 GiB.
inline constexpr long long most_pixels = 1LL << 28;

struct ImagePoint {
  double x, y;  ///< pixels from the top left corner
};

class Camera {
 public:
  virtual ~Camera() = default;
  /// The ray that leaves the eye (for an orthographic camera: the picture's plane) through a point
  /// of the picture. Nothing where the picture shows nothing: outside the circle of a fisheye,
  /// beyond the poles of an equirectangular picture.
  virtual std::optional<media::Ray> ray(double x, double y) const = 0;
  /// Where on the picture a point in space is seen. Nothing where it is not on the picture, its
  /// border included.
  virtual std::optional<ImagePoint> image_point(const Vec3& point_m) const = 0;
};

/// Throws bad_input for a field of view that the type cannot have and for a picture without or with
/// too many pixels.
std::unique_ptr<Camera> make_camera(const CameraSettings& settings);

}  // namespace arcus::render
