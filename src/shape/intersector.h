#pragma once
// Finds the piece that a ray meets first. With a hierarchy of boxes (Embree) or, for measurement alone, by asking every piece.

#include <memory>
#include <optional>
#include <vector>

#include "media/space/ray.h"
#include "src/shape/pieces.h"

namespace arcus::render {

/// The first piece that a ray meets.
struct PieceHit {
  PieceId id;
  Meeting meeting;
};

class Intersector {
 public:
  virtual ~Intersector() = default;
  /// Within the ray's stretch.
  virtual std::optional<PieceHit> nearest(const media::Ray& ray, const Departure& departure) const = 0;
  /// Whether there is any.
  virtual bool is_blocked(const media::Ray& ray, const Departure& departure) const = 0;
};

/// The groups must outlive them. Throws cannot() where there is too little memory for the hierarchy, with how many spheres fit.
std::unique_ptr<const Intersector> make_hierarchy(const std::vector<PieceGroup>& groups);
std::unique_ptr<const Intersector> make_exhaustive(const std::vector<PieceGroup>& groups);

}  // namespace arcus::render
