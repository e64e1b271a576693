#include "src/shape/surfaces.h"

#include <algorithm>

namespace arcus::render {
namespace {

/// Planes are a group of their own.
constexpr std::uint32_t plane_group = PieceId::none - 1;

}  // namespace

void list_keys(Keys& keys, SurfaceSettings& surface) {
  keys.text("name", surface.name, "for messages");
  keys.table("shape", surface.shape, "where the surface is");
  keys.table("material", surface.material, "what it does with light");
}

void SurfaceParts::add(const SurfaceSettings& surface, const std::string& folder, const SurfaceInputs& inputs) {
  const Material material = make_material(surface.material, folder, inputs, "surface '" + surface.name + "'");
  if (surface.shape.type == "plane") {
    planes.push_back({surface.shape.height_m, static_cast<std::uint32_t>(materials.size())});
    materials.push_back(material);
  } else {
    add(pieces_of(surface.shape, folder, "surface '" + surface.name + "'", inputs.heights), material);
  }
}

void SurfaceParts::add(PieceGroup group, const Material& material) {
  group.material = static_cast<std::uint32_t>(materials.size());
  materials.push_back(material);
  groups.push_back(std::move(group));
}

Surfaces::Surfaces(SurfaceParts parts, bool is_exhaustive)
    : materials_(std::make_unique<const std::vector<Material>>(std::move(parts.materials))),
      groups_(std::make_unique<const std::vector<PieceGroup>>(std::move(parts.groups))),
      planes_(std::move(parts.planes)) {
  for (const PieceGroup& group : *groups_) {
    bounds_m_.include(bounds_of(group));
    has_pieces_ |= group.size() > 0;
  }
  if (has_pieces_) intersector_ = is_exhaustive ? make_exhaustive(*groups_) : make_hierarchy(*groups_);
}

bool Surfaces::has_sea() const {
  return std::any_of(materials_->begin(), materials_->end(), [](const Material& material) { return material.sea() != nullptr; });
}

std::vector<PieceId> Surfaces::smooth_planes() const {
  std::vector<PieceId> result;
  for (std::uint32_t i = 0; i < planes_.size(); ++i)
    if ((*materials_)[planes_[i].material].is_smooth()) result.push_back({plane_group, i});
  return result;
}

std::optional<Hit> Surfaces::nearest_hit(const media::Ray& ray, const Departure& departure) const {
  std::optional<Hit> nearest;
  media::Ray rest = ray;
  for (std::uint32_t i = 0; i < planes_.size(); ++i) {
    const Plane& plane = planes_[i];
    if (ray.direction.z == 0 || departure.from == PieceId{plane_group, i}) continue;
    const double distance_m = (plane.height_m - ray.origin_m.z) / ray.direction.z;
    if (!(distance_m > rest.nearest_m && distance_m < rest.farthest_m)) continue;
    rest.farthest_m = distance_m;
    Vec3 position_m = ray.at(distance_m);
    position_m.z = plane.height_m;
    nearest = Hit{distance_m, position_m, Vec3(0, 0, ray.direction.z < 0 ? 1 : -1), &(*materials_)[plane.material], ray.direction.z > 0, {plane_group, i}};
  }
  if (!intersector_) return nearest;
  const auto found = intersector_->nearest(rest, departure);
  if (!found) return nearest;

  const PieceGroup& group = (*groups_)[found->id.group];
  Hit hit{found->meeting.distance_m, ray.at(found->meeting.distance_m), {}, &(*materials_)[group.material], found->meeting.from_inside, found->id};
  if (!group.spheres.empty()) {
    const Sphere& sphere = group.spheres[found->id.piece];
    const Vec3 centre_m = group.centre_m + sphere.offset_m();
    hit.normal = normalize(hit.position_m - centre_m);
    hit.position_m = centre_m + hit.normal * sphere.radius_m;
  } else if (!group.flats.empty()) {
    const Flat& flat = group.flats[found->id.piece];
    hit.normal = normalize(cross(flat.edge_u_m, flat.edge_v_m));
  } else {
    const Triangle t = group.triangle(found->id.piece);
    hit.normal = normalize(cross(t.b_m - t.a_m, t.c_m - t.a_m));
  }
  if (hit.from_inside) hit.normal = -hit.normal;
  return hit;
}

bool Surfaces::is_blocked(const media::Ray& ray, const Departure& departure) const {
  for (std::uint32_t i = 0; i < planes_.size(); ++i) {
    if (ray.direction.z == 0 || departure.from == PieceId{plane_group, i}) continue;
    const double distance_m = (planes_[i].height_m - ray.origin_m.z) / ray.direction.z;
    if (distance_m > ray.nearest_m && distance_m < ray.farthest_m) return true;
  }
  return intersector_ && intersector_->is_blocked(ray, departure);
}

}  // namespace arcus::render
