#pragma once
// The cells along a ray, in order, without gaps: empty ones are passed over, the others are handed out one at a time.
// Amanatides & Woo, "A Fast Voxel Traversal Algorithm for Ray Tracing", Eurographics 1987, on two levels.

#include <cmath>
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
      if (in_block_) {
        const MajorantGrid::Cell cell = cells_[cell_.index];
        const double begin = place_m_, end = cell_.step();
        in_block_ = end < block_end_m_ && cell_.is_inside();
        place_m_ = in_block_ ? end : block_end_m_;  // rounding must not leave a gap between blocks
        if (cell.majorant_per_m > 0 && begin < place_m_) {
          segment = {begin, place_m_, cell.majorant_per_m, cell.minorant_per_m};
          return true;
        }
        continue;
      }
      if (!(place_m_ < end_m_)) return false;
      const MajorantGrid::Block block = blocks_[block_.index];
      const int x = block_.at[0], y = block_.at[1], z = block_.at[2];
      const double begin = place_m_;
      block_end_m_ = std::fmin(block_.step(), end_m_);
      if (!block_.is_inside()) end_m_ = block_end_m_;
      if (block.level == 0) {
        place_m_ = block_end_m_;
        if (block.majorant_per_m > 0 && begin < place_m_) {
          segment = {begin, place_m_, block.majorant_per_m, block.minorant_per_m};
          return true;
        }
        continue;
      }
      enter(block, x, y, z);
    }
  }

 private:
  /// Position in a lattice of cubes, and where the ray crosses the next planes.
  struct Lattice {
    double crossing_m[3];  // where the ray leaves the present cube through each pair of faces
    double spacing_m[3];   // between crossings
    std::int32_t at[3], direction[3], count[3];
    std::int32_t stride[3];
    std::uint32_t index;

    /// Steps into the next cube (diagonally where the ray meets an edge); returns where the present one ends.
    double step() {
      const double end = std::fmin(std::fmin(crossing_m[0], crossing_m[1]), crossing_m[2]);
      for (int axis = 0; axis < 3; ++axis) {
        const bool crosses = crossing_m[axis] <= end;
        at[axis] += crosses ? direction[axis] : 0;
        index += static_cast<std::uint32_t>(crosses ? stride[axis] : 0);
        crossing_m[axis] += crosses ? spacing_m[axis] : 0;
      }
      return end;
    }
    bool is_inside() const {
      return static_cast<std::uint32_t>(at[0]) < static_cast<std::uint32_t>(count[0]) &&
             static_cast<std::uint32_t>(at[1]) < static_cast<std::uint32_t>(count[1]) &&
             static_cast<std::uint32_t>(at[2]) < static_cast<std::uint32_t>(count[2]);
    }
  };
  void enter(const MajorantGrid::Block& block, int x, int y, int z);
  void place(Lattice& lattice, const double low[3], double cells_per_block) const;

  const MajorantGrid::Block* blocks_;
  const MajorantGrid::Cell* all_cells_;
  const MajorantGrid::Cell* cells_ = nullptr;  // of the present block
  double place_m_ = 0, end_m_ = 0, block_end_m_ = 0;
  bool in_block_ = false;
  double origin_[3], direction_[3], inverse_[3];  // in block coordinates
  Lattice block_, cell_;
};

}  // namespace arcus::media
