#pragma once
// All surfaces of a scene, explicit drops included, and where a ray meets them.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "media/space/ray.h"
#include "phase/settings/keys.h"
#include "src/material/material.h"
#include "src/shape/intersector.h"
#include "src/shape/shape.h"

namespace arcus::render {

struct SurfaceSettings {
  std::string name;
  ShapeSettings shape;
  MaterialSettings material;
};
void list_keys(Keys& keys, SurfaceSettings& surface);

/// Where a ray met a surface.
struct Hit {
  double distance_m;
  Vec3 position_m;       ///< on the surface to the last digits
  Vec3 normal;           ///< unit, on the side the ray came from
  const Material* material;
  bool from_inside;      ///< the ray came through the body behind the surface
  PieceId piece;

  /// How a ray sets out from here, across the surface or back.
  Departure departure(bool crosses) const { return {piece, crosses != from_inside}; }
};

/// A horizontal plane to the horizon.
struct Plane {
  double height_m;
  std::uint32_t material;
};

/// What surfaces are made from.
struct SurfaceParts {
  std::vector<Material> materials;
  std::vector<Plane> planes;
  std::vector<PieceGroup> groups;

  /// `folder`: where relative paths start. Throws bad_input.
  void add(const SurfaceSettings& surface, const std::string& folder, const SurfaceInputs& inputs);
  void add(PieceGroup group, const Material& material);
};

class Surfaces {
 public:
  Surfaces() = default;  ///< none
  /// `is_exhaustive`: without a hierarchy, for measurement alone.
  explicit Surfaces(SurfaceParts parts, bool is_exhaustive = false);

  bool is_empty() const { return planes_.empty() && !has_pieces_; }
  /// The nearest hit within the ray's stretch.
  std::optional<Hit> nearest_hit(const media::Ray& ray, const Departure& departure = {}) const;
  /// Whether anything lies within the ray's stretch.
  bool is_blocked(const media::Ray& ray, const Departure& departure = {}) const;
  /// Around all but the planes.
  const media::Box& bounds_m() const { return bounds_m_; }
  /// The flat piece of a hit, where it is on one.
  const Flat* flat(const PieceId& piece) const {
    const bool is_flat = piece.group < groups_->size() && piece.piece < (*groups_)[piece.group].flats.size();
    return is_flat ? &(*groups_)[piece.group].flats[piece.piece] : nullptr;
  }
  bool has_planes() const { return !planes_.empty(); }
  /// Those planes that are no matte ones, as hits name them.
  std::vector<PieceId> smooth_planes() const;
  bool has_sea() const;
  const std::vector<PieceGroup>& groups() const { return *groups_; }
  const std::vector<Material>& materials() const { return *materials_; }

 private:
  // Behind pointers: the hierarchy and the hits point to them while the surfaces move.
  std::unique_ptr<const std::vector<Material>> materials_ = std::make_unique<const std::vector<Material>>();
  std::unique_ptr<const std::vector<PieceGroup>> groups_ = std::make_unique<const std::vector<PieceGroup>>();
  std::vector<Plane> planes_;
  std::unique_ptr<const Intersector> intersector_;
  media::Box bounds_m_;
  bool has_pieces_ = false;
};

}  // namespace arcus::render
