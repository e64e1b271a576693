#pragma once
// Surfaces of a scene and where a ray meets them. So far: horizontal planes that reach to the horizon.

#include <optional>
#include <string>
#include <vector>

#include "media/space/ray.h"
#include "phase/settings/keys.h"
#include "src/material/matte.h"

namespace arcus::render {

struct ShapeSettings {
  std::string type = "plane";  ///< plane
  double height_m = 0;         ///< of a horizontal plane
};
void list_keys(Keys& keys, ShapeSettings& shape);

struct SurfaceSettings {
  std::string name;
  ShapeSettings shape;
  MaterialSettings material;
};
void list_keys(Keys& keys, SurfaceSettings& surface);

/// Where a ray met a surface.
struct Hit {
  double distance_m;
  Vec3 position_m;  ///< exactly on the surface, so that a ray that starts here does not meet it again
  Vec3 normal;  ///< unit, on the side the ray came from
  const Matte* material;
};

/// All surfaces of a scene.
class Surfaces {
 public:
  explicit Surfaces(const std::vector<SurfaceSettings>& settings);
  /// The nearest hit within the ray's interval.
  std::optional<Hit> nearest_hit(const media::Ray& ray) const;
  /// Whether anything lies within the ray's interval.
  bool is_blocked(const media::Ray& ray) const { return nearest_hit(ray).has_value(); }

 private:
  struct Plane {
    double height_m;
    Matte material;
  };
  std::vector<Plane> planes_;
};

}  // namespace arcus::render
