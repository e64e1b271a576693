#include "media/majorant/majorant_walk.h"

namespace arcus::media {

MajorantWalk::MajorantWalk(const MajorantGrid& grid, const Ray& ray) : blocks_(grid.blocks().data()), cells_(grid.cells().data()) {
  if (grid.blocks().empty()) return;
  constexpr double cubes = 1 << finest;
  // Stands for the inverse of 0: no face is ever reached along such an axis.
  constexpr double never = 1e200;
  const Vec3 origin = grid.block_from_world().point(ray.origin_m) * cubes;
  const Vec3 direction = grid.block_from_world().vector(ray.direction) * cubes;
  const Coord& count = grid.block_count();
  stride_[0] = static_cast<std::size_t>(count.y) * static_cast<std::size_t>(count.z);
  stride_[1] = static_cast<std::size_t>(count.z);
  const std::int32_t counts[3] = {count.x, count.y, count.z};
  double begin = ray.nearest_m, end = ray.farthest_m;
  for (int axis = 0; axis < 3; ++axis) {
    const double limit = counts[axis] * cubes;
    limit_[axis] = static_cast<std::uint32_t>(counts[axis]) << finest;
    origin_[axis] = origin[axis];
    direction_[axis] = direction[axis];
    ahead_[axis] = direction[axis] >= 0;
    inverse_[axis] = direction[axis] == 0 ? never : 1 / direction[axis];
    if (origin[axis] >= 0 && origin[axis] <= limit) {
      // Enters along no face of this axis, and next() sees where it leaves.
      continue;
    }
    if (direction[axis] == 0 || (direction[axis] > 0) == (origin[axis] > 0)) return;  // beside it, or leads away
    begin = std::max(begin, ((direction[axis] > 0 ? 0 : limit) - origin[axis]) * inverse_[axis]);
  }
  if (!(begin < end)) return;
  for (int axis = 0; axis < 3; ++axis) {
    const double p = origin_[axis] + direction_[axis] * begin, limit = counts[axis] * cubes;
    // The ray may miss the grid: by the time that it has reached one face it has passed another.
    if (p < -1e-9 * limit || p > limit * (1 + 1e-9)) return;
    at_[axis] = static_cast<std::int32_t>(std::clamp(p, 0.0, limit - 0.5));
  }
  place_m_ = begin;
  end_m_ = end;
}

}  // namespace arcus::media
