#pragma once
// The cells along a ray, in order, without gaps: empty ones are passed over, the others are handed out one at a time.
//
// In a dense cloud a ray ends after a cell or two, so a walk must begin as cheaply as it goes on. It keeps no state but its place
// in the finest lattice that blocks may have; each step looks up block and cell anew and computes where the ray leaves that cube.

#include <algorithm>
#include <cstdint>

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
    while (place_m_ < end_m_) {
      const MajorantGrid::Block& block =
          blocks_[static_cast<std::size_t>(at_[0] >> finest) * stride_[0] + static_cast<std::size_t>(at_[1] >> finest) * stride_[1] +
                  static_cast<std::size_t>(at_[2] >> finest)];
      const auto level = static_cast<int>(block.level);
      const int shift = finest - level;
      MajorantGrid::Cell cell{block.majorant_per_m, block.minorant_per_m};
      if (level > 0) {
        const std::int32_t mask = (1 << level) - 1;
        const std::int32_t index = ((((at_[0] >> shift) & mask) << level | ((at_[1] >> shift) & mask)) << level) | ((at_[2] >> shift) & mask);
        cell = cells_[block.first_cell + static_cast<std::uint32_t>(index)];
      }
      const double begin_m = place_m_;
      place_m_ = std::min(step(shift), end_m_);
      if (cell.majorant_per_m > 0 && begin_m < place_m_) {
        segment = {begin_m, place_m_, cell.majorant_per_m, cell.minorant_per_m};
        return true;
      }
    }
    return false;
  }

 private:
  static constexpr int finest = MajorantGrid::most_levels;  // log2 of the finest lattice's cubes along a block's edge

  /// Leaves the cube of edge 2^shift around at_; returns where.
  double step(int shift) {
    std::int32_t low[3];
    double leave_m[3];
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = at_[axis] >> shift << shift;
      leave_m[axis] = (low[axis] + (ahead_[axis] << shift) - origin_[axis]) * inverse_[axis];
    }
    const double leave = std::min(std::min(leave_m[0], leave_m[1]), leave_m[2]);
    bool is_inside = true;
    for (int axis = 0; axis < 3; ++axis) {
      // Across the face, or (elsewhere) wherever the ray has come to within the cube; through an edge, diagonally.
      const std::int32_t across = low[axis] + (ahead_[axis] ? 1 << shift : -1);
      const auto within = std::clamp(static_cast<std::int32_t>(origin_[axis] + direction_[axis] * leave), low[axis], low[axis] + (1 << shift) - 1);
      at_[axis] = leave_m[axis] <= leave ? across : within;
      is_inside &= static_cast<std::uint32_t>(at_[axis]) < limit_[axis];
    }
    if (!is_inside) end_m_ = std::min(end_m_, leave);
    return std::max(leave, place_m_);
  }

  const MajorantGrid::Block* blocks_;
  const MajorantGrid::Cell* cells_;
  double place_m_ = 0, end_m_ = 0;
  std::int32_t at_[3];                                // the finest lattice's cube
  std::int32_t ahead_[3];                             // 1: towards larger coordinates, or along them
  double origin_[3], direction_[3], inverse_[3];      // in the finest lattice
  std::uint32_t limit_[3];
  std::size_t stride_[2];
};

}  // namespace arcus::media
