#include "src/shape/surfaces.h"

namespace arcus::render {

void list_keys(Keys& keys, ShapeSettings& shape) {
  keys.choice("type", shape.type, {"plane"}, "plane: horizontal, reaches to the horizon");
  keys.number("height_m", shape.height_m, any(), "height of the plane above z = 0");
}

void list_keys(Keys& keys, SurfaceSettings& surface) {
  keys.text("name", surface.name, "for messages");
  keys.table("shape", surface.shape, "where the surface is");
  keys.table("material", surface.material, "what it does with light");
}

Surfaces::Surfaces(const std::vector<SurfaceSettings>& settings) {
  for (const SurfaceSettings& surface : settings)
    planes_.push_back({surface.shape.height_m, Matte(surface.material.albedo)});
}

std::optional<Hit> Surfaces::nearest_hit(const media::Ray& ray) const {
  std::optional<Hit> nearest;
  for (const Plane& plane : planes_) {
    if (ray.direction.z == 0) continue;
    const double distance_m = (plane.height_m - ray.origin_m.z) / ray.direction.z;
    if (!(distance_m > ray.nearest_m && distance_m < ray.farthest_m)) continue;
    if (nearest && distance_m >= nearest->distance_m) continue;
    Vec3 position_m = ray.origin_m + ray.direction * distance_m;
    position_m.z = plane.height_m;
    nearest = Hit{distance_m, position_m, Vec3(0, 0, ray.direction.z < 0 ? 1 : -1), &plane.material};
  }
  return nearest;
}

}  // namespace arcus::render
