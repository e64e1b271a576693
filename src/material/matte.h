#pragma once
// A matte surface: reflects the same radiance in all directions (Lambert), grey.

#include <algorithm>
#include <cmath>
#include <string>

#include "phase/base/frame.h"
#include "phase/settings/keys.h"

namespace arcus::render {

struct MaterialSettings {
  std::string type = "matte";  ///< matte
  double albedo = 0.2;         ///< share of the light that is reflected, 0 to 1
};
void list_keys(Keys& keys, MaterialSettings& material);

class Matte {
 public:
  explicit Matte(double albedo) : albedo_(albedo) {}
  double albedo() const { return albedo_; }
  /// Reflected radiance per irradiance [1/sr] for light to a direction `away` (unit); 0 behind the surface.
  double value_per_sr(const Vec3& normal, const Vec3& away) const { return dot(normal, away) > 0 ? albedo_ / pi : 0; }
  /// Density of draw() [1/sr]: cosine over pi.
  double density_per_sr(const Vec3& normal, const Vec3& away) const { return std::max(0.0, dot(normal, away)) / pi; }
  /// A direction away from the surface with density cosine over pi; u, v in [0, 1).
  Vec3 draw(const Vec3& normal, double u, double v) const {
    const double sine = std::sqrt(u), phi = 2 * pi * v;
    return frame_around(normal).to_world(sine * std::cos(phi), sine * std::sin(phi), std::sqrt(1 - u));
  }

 private:
  double albedo_;
};

}  // namespace arcus::render
