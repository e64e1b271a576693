#include "media/majorant/majorant_walk.h"

#include <algorithm>

namespace arcus::media {

MajorantWalk::MajorantWalk(const MajorantGrid& grid, const Ray& ray)
    : blocks_(grid.blocks().data()), all_cells_(grid.cells().data()) {
  if (grid.blocks().empty()) return;
  const Vec3 origin = grid.block_from_world().point(ray.origin_m);
  const Vec3 direction = grid.block_from_world().vector(ray.direction);
  const Coord& count = grid.block_count();
  const auto interval = clip(origin, direction, ray.nearest_m, ray.farthest_m,
                             Box{Vec3(0), Vec3(count.x, count.y, count.z)});
  if (!interval) return;
  place_m_ = interval->begin;
  end_m_ = interval->end;
  const int counts[3] = {count.x, count.y, count.z};
  const int strides[3] = {count.y * count.z, count.z, 1};
  for (int axis = 0; axis < 3; ++axis) {
    origin_[axis] = origin[axis];
    direction_[axis] = direction[axis];
    inverse_[axis] = 1 / direction[axis];
    block_.count[axis] = counts[axis];
    block_.stride[axis] = strides[axis];
  }
  const double low[3] = {0, 0, 0};
  place(block_, low, 1);
}

/// Finds the cube at place_m_ of a lattice whose first corner is `low` (block coordinates).
void MajorantWalk::place(Lattice& lattice, const double low[3], double cells_per_block) const {
  lattice.index = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double p = (origin_[axis] + direction_[axis] * place_m_ - low[axis]) * cells_per_block;
    lattice.at[axis] = std::clamp(static_cast<std::int32_t>(std::floor(std::clamp(p, -1.0, 1e9))), 0, lattice.count[axis] - 1);
    lattice.index += static_cast<std::uint32_t>(lattice.at[axis] * lattice.stride[axis]);
    if (direction_[axis] == 0) {
      lattice.direction[axis] = 0;
      lattice.crossing_m[axis] = lattice.spacing_m[axis] = std::numeric_limits<double>::infinity();
      lattice.stride[axis] = 0;
      continue;
    }
    const bool up = direction_[axis] > 0;
    lattice.direction[axis] = up ? 1 : -1;
    if (!up) lattice.stride[axis] = -lattice.stride[axis];
    const double plane = low[axis] + (lattice.at[axis] + (up ? 1 : 0)) / cells_per_block;
    // Rounding may put the plane a hair behind the ray's place: no segment begins before its predecessor's end.
    lattice.crossing_m[axis] = std::max(place_m_, (plane - origin_[axis]) * inverse_[axis]);
    lattice.spacing_m[axis] = std::fabs(inverse_[axis]) / cells_per_block;
  }
}

void MajorantWalk::enter(const MajorantGrid::Block& block, int x, int y, int z) {
  const int n = 1 << block.level;
  const double low[3] = {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
  cells_ = all_cells_ + block.first_cell;
  for (int axis = 0; axis < 3; ++axis) cell_.count[axis] = n;
  cell_.stride[0] = n * n;
  cell_.stride[1] = n;
  cell_.stride[2] = 1;
  place(cell_, low, n);
  in_block_ = true;
}

}  // namespace arcus::media
