#pragma once
// Axis-aligned box.

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "media/space/ray.h"
#include "phase/base/vec3.h"

namespace arcus::media {

/// Stretch of a line, from `begin` to `end`, measured along it.
struct Interval {
  double begin, end;
};

/// All points between `low` and `high`, both included; empty (holds nothing) as made by default.
struct Box {
  Vec3 low{std::numeric_limits<double>::infinity()};
  Vec3 high{-std::numeric_limits<double>::infinity()};

  bool is_empty() const { return !(low.x <= high.x && low.y <= high.y && low.z <= high.z); }
  bool contains(const Vec3& p) const {
    return p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y && p.z >= low.z && p.z <= high.z;
  }
  Vec3 size() const { return high - low; }
  Vec3 centre() const { return (low + high) * 0.5; }
  Vec3 corner(int i) const { return {i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z}; }

  void include(const Vec3& p) {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  }
  void include(const Box& other) {
    if (other.is_empty()) return;
    include(other.low);
    include(other.high);
  }
  Box grown_by(double margin) const { return {low - Vec3(margin), high + Vec3(margin)}; }
};

/// The part of the line origin + t·direction with nearest ≤ t ≤ farthest that lies in the box; nothing where they do not
/// meet. direction need not be a unit vector; it may have zero components. A line within a face counts as inside.
inline std::optional<Interval> clip(const Vec3& origin, const Vec3& direction, double nearest, double farthest,
                                    const Box& box) {
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0) {
      if (origin[axis] < box.low[axis] || origin[axis] > box.high[axis]) return std::nullopt;
      continue;
    }
    const double inverse = 1 / direction[axis];
    const double one = (box.low[axis] - origin[axis]) * inverse;
    const double other = (box.high[axis] - origin[axis]) * inverse;
    nearest = std::max(nearest, std::min(one, other));
    farthest = std::min(farthest, std::max(one, other));
  }
  if (!(nearest <= farthest)) return std::nullopt;
  return Interval{nearest, farthest};
}
inline std::optional<Interval> clip(const Ray& ray, const Box& box) {
  return clip(ray.origin_m, ray.direction, ray.nearest_m, ray.farthest_m, box);
}

}  // namespace arcus::media
