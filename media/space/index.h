#pragma once
// Integer coordinates of voxels.

#include <algorithm>
#include <cstdint>

#include "media/space/box.h"

namespace arcus::media {

struct Coord {
  int x = 0, y = 0, z = 0;
  friend bool operator==(const Coord&, const Coord&) = default;
  friend auto operator<=>(const Coord&, const Coord&) = default;  // x first
};

/// Voxels from `low` to `high`, both included; empty as made by default.
struct IndexBox {
  Coord low{1, 1, 1}, high{0, 0, 0};

  friend bool operator==(const IndexBox&, const IndexBox&) = default;
  bool is_empty() const { return low.x > high.x || low.y > high.y || low.z > high.z; }
  bool contains(const Coord& c) const {
    return c.x >= low.x && c.x <= high.x && c.y >= low.y && c.y <= high.y && c.z >= low.z && c.z <= high.z;
  }
  void include(const Coord& c) {
    if (is_empty()) {
      low = high = c;
      return;
    }
    low = {std::min(low.x, c.x), std::min(low.y, c.y), std::min(low.z, c.z)};
    high = {std::max(high.x, c.x), std::max(high.y, c.y), std::max(high.z, c.z)};
  }
  void include(const IndexBox& other) {
    if (other.is_empty()) return;
    include(other.low);
    include(other.high);
  }
  std::int64_t size(int axis) const {
    if (is_empty()) return 0;
    if (axis == 0) return std::int64_t{high.x} - low.x + 1;
    if (axis == 1) return std::int64_t{high.y} - low.y + 1;
    return std::int64_t{high.z} - low.z + 1;
  }
  /// The coordinates of the outermost voxels' places (not of their outer faces).
  Box box() const {
    return {Vec3(low.x, low.y, low.z), Vec3(high.x, high.y, high.z)};
  }
};

}  // namespace arcus::media
