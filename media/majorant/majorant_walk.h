#pragma once
// The cells along a ray, in order, without gaps: empty ones are passed over, the others are handed out one at a time.
// Amanatides & Woo, "A Fast Voxel Traversal Algorithm for Ray Tracing", Eurographics 1987, on two levels.

#include <algorithm>
#include <cstdint>
#include <limits>

#include "media/majorant/majorant_grid.h"
#include "media/space/ray.h"

namespace arcus::media {

/// The part of a ray inside one cell; `end` of one is `begin` of the next unless empty cells lie between.
struct Segment {
  double begin_m = 0, end_m = 0;  ///< along the ray from its origin
  float majorant_per_m = 0;       ///< above 0
  float minorant_per_m = 0;
};

class MajorantWalk {
 public:
  MajorantWalk(const MajorantGrid& grid, const Ray& ray);

  /// Goes on to the next cell that is not empty; false where the ray has left the grid or ends.
  bool next(Segment& segment) {
    while (true) {
      while (in_block_) {
        const MajorantGrid::Cell cell = cells_[cell_.index];
        const double begin = place_m_, end = cell_.step();
        in_block_ = end < leave_block_m_;
        place_m_ = in_block_ ? end : block_end_m_;
        if (cell.majorant_per_m > 0 && begin < place_m_) {
          segment = {begin, place_m_, cell.majorant_per_m, cell.minorant_per_m};
          return true;
        }
      }
      if (!(place_m_ < end_m_)) return false;
      const MajorantGrid::Block block = blocks_[block_.index];
      const double low[3] = {block_low_[0], block_low_[1], block_low_[2]}, begin = place_m_;
      const double end = step_to_next_block();
      block_end_m_ = end < leave_grid_m_ ? end : end_m_;
      if (block.level > 0) {
        enter(block, low);
        continue;
      }
      place_m_ = block_end_m_;
      if (block.majorant_per_m > 0 && begin < place_m_) {
        segment = {begin, place_m_, block.majorant_per_m, block.minorant_per_m};
        return true;
      }
    }
  }

 private:
  /// A lattice of cubes: where the ray leaves the present one through each pair of faces, and what changes then.
  struct Lattice {
    double crossing_m[3], spacing_m[3];
    std::int32_t stride[3];
    std::uint32_t index;

    /// Steps into the next cube (diagonally where the ray meets an edge); returns where the present one ends.
    double step() {
      const double end = std::min(std::min(crossing_m[0], crossing_m[1]), crossing_m[2]);
      const bool x = crossing_m[0] <= end, y = crossing_m[1] <= end, z = crossing_m[2] <= end;
      index += static_cast<std::uint32_t>((x ? stride[0] : 0) + (y ? stride[1] : 0) + (z ? stride[2] : 0));
      crossing_m[0] += x ? spacing_m[0] : 0;
      crossing_m[1] += y ? spacing_m[1] : 0;
      crossing_m[2] += z ? spacing_m[2] : 0;
      return end;
    }
  };
  double step_to_next_block() {
    const double x = block_.crossing_m[0], y = block_.crossing_m[1], z = block_.crossing_m[2];
    const double end = block_.step();
    block_low_[0] += x <= end ? heading_[0] : 0;
    block_low_[1] += y <= end ? heading_[1] : 0;
    block_low_[2] += z <= end ? heading_[2] : 0;
    return end;
  }
  void enter(const MajorantGrid::Block& block, const double low[3]);
  void place(Lattice& lattice, const double low[3], const std::int32_t count[3], double cells_per_block);

  const MajorantGrid::Block* blocks_;
  const MajorantGrid::Cell* all_cells_;
  const MajorantGrid::Cell* cells_ = nullptr;  // of the present block
  bool in_block_ = false;
  double place_m_ = 0, end_m_ = 0, block_end_m_ = 0;
  // A crossing this near to the end of the block or grid is that end: sums of spacings are not exact.
  double leave_block_m_ = 0, leave_grid_m_ = 0;
  Lattice cell_, block_;
  double block_low_[3];                                        // the present block's first corner
  double origin_[3], direction_[3], inverse_[3], heading_[3];  // in block coordinates; heading: -1, 0 or 1
};

}  // namespace arcus::media
