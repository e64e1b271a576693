#include "media/majorant/majorant_walk.h"

#include <cmath>

namespace arcus::media {

MajorantWalk::MajorantWalk(const MajorantGrid& grid, const Ray& ray)
    : blocks_(grid.blocks().data()), all_cells_(grid.cells().data()) {
  if (grid.blocks().empty()) return;
  const Vec3 origin = grid.block_from_world().point(ray.origin_m);
  const Vec3 direction = grid.block_from_world().vector(ray.direction);
  const Coord& size = grid.block_count();
  const std::int32_t count[3] = {size.x, size.y, size.z};
  double begin = ray.nearest_m, end = ray.farthest_m;
  for (int axis = 0; axis < 3; ++axis) {
    origin_[axis] = origin[axis];
    direction_[axis] = direction[axis];
    if (direction[axis] == 0) {
      if (origin[axis] < 0 || origin[axis] > count[axis]) return;
      inverse_[axis] = heading_[axis] = 0;
      continue;
    }
    inverse_[axis] = 1 / direction[axis];
    heading_[axis] = direction[axis] > 0 ? 1 : -1;
    const double low = -origin[axis] * inverse_[axis], high = (count[axis] - origin[axis]) * inverse_[axis];
    begin = std::max(begin, std::min(low, high));
    end = std::min(end, std::max(low, high));
  }
  if (!(begin < end)) return;
  place_m_ = begin;
  end_m_ = end;
  block_.stride[0] = count[1] * count[2];
  block_.stride[1] = count[2];
  block_.stride[2] = 1;
  const double low[3] = {0, 0, 0};
  place(block_, low, count, 1);
  leave_grid_m_ = end_m_ - 1e-9 * (end_m_ - place_m_);
  std::int32_t rest = static_cast<std::int32_t>(block_.index);
  block_low_[0] = rest / (count[1] * count[2]);
  rest %= count[1] * count[2];
  block_low_[1] = rest / count[2];
  block_low_[2] = rest % count[2];
  for (int axis = 0; axis < 3; ++axis)
    if (heading_[axis] < 0) block_.stride[axis] = -block_.stride[axis];
}

/// Finds the cube at place_m_ of a lattice whose first corner is `low` (block coordinates). Strides are those of the array.
void MajorantWalk::place(Lattice& lattice, const double low[3], const std::int32_t count[3], double cells_per_block) {
  lattice.index = 0;
  const double edge = 1 / cells_per_block;
  for (int axis = 0; axis < 3; ++axis) {
    const double p = (origin_[axis] + direction_[axis] * place_m_ - low[axis]) * cells_per_block;
    const double at = std::floor(std::clamp(p, 0.0, count[axis] - 0.5));
    lattice.index += static_cast<std::uint32_t>(static_cast<std::int32_t>(at) * lattice.stride[axis]);
    const double plane = low[axis] + (heading_[axis] > 0 ? at + 1 : at) * edge;
    // Rounding may put the plane a hair behind the ray's place: no segment begins before its predecessor's end.
    const double crossing = std::max(place_m_, (plane - origin_[axis]) * inverse_[axis]);
    const bool never = heading_[axis] == 0;
    lattice.crossing_m[axis] = never ? std::numeric_limits<double>::infinity() : crossing;
    lattice.spacing_m[axis] = never ? 0 : std::fabs(inverse_[axis]) * edge;
  }
}

void MajorantWalk::enter(const MajorantGrid::Block& block, const double low[3]) {
  const std::int32_t n = 1 << block.level;
  const std::int32_t count[3] = {n, n, n};
  cells_ = all_cells_ + block.first_cell;
  cell_.stride[0] = n * n;
  cell_.stride[1] = n;
  cell_.stride[2] = 1;
  place(cell_, low, count, n);
  for (int axis = 0; axis < 3; ++axis)
    if (heading_[axis] < 0) cell_.stride[axis] = -cell_.stride[axis];
  in_block_ = place_m_ < block_end_m_;
  leave_block_m_ = block_end_m_ - 1e-9 * (block_end_m_ - place_m_);
}

}  // namespace arcus::media
