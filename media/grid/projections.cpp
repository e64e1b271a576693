#include "media/grid/projections.h"

namespace arcus::media {
namespace {

constexpr std::int64_t most_points = std::int64_t{1} << 26;

int below(int voxel) { return voxel & ~(SparseGrid::brick_edge - 1); }

}  // namespace

void for_each_voxel(const SparseGrid& grid, const std::function<void(const Coord&, const Voxel&)>& visit) {
  const IndexBox& box = grid.voxels();
  if (box.is_empty()) return;
  constexpr int edge = SparseGrid::brick_edge;
  for (int x = below(box.low.x); x <= box.high.x; x += edge)
    for (int y = below(box.low.y); y <= box.high.y; y += edge)
      for (int z = below(box.low.z); z <= box.high.z; z += edge) {
        if (grid.range({{x, y, z}, {x + edge - 1, y + edge - 1, z + edge - 1}}, false).largest == 0) continue;
        for (int i = 0; i < SparseGrid::brick_voxels; ++i) {
          const Coord at{x + (i >> 6), y + (i >> 3 & 7), z + (i & 7)};
          if (const Voxel voxel = grid.at(at.x, at.y, at.z); voxel.extinction != 0) visit(at, voxel);
        }
      }
}

std::array<Projection, 3> projections(const SparseGrid& grid, const Vec3& step_m) {
  return projections(std::vector<const SparseGrid*>{&grid}, step_m);
}

std::array<Projection, 3> projections(const std::vector<const SparseGrid*>& grids, const Vec3& step_m) {
  IndexBox box;
  for (const SparseGrid* grid : grids) {
    if (grid->voxels().is_empty()) continue;
    box.include(grid->voxels().low);
    box.include(grid->voxels().high);
  }
  const std::int64_t size[3] = {box.size(0), box.size(1), box.size(2)};
  constexpr int right[3] = {1, 0, 0}, up[3] = {2, 2, 1};
  std::array<Projection, 3> result;
  for (int axis = 0; axis < 3; ++axis) {
    if (box.is_empty() || size[right[axis]] * size[up[axis]] > most_points) continue;
    Projection& p = result[static_cast<std::size_t>(axis)];
    p.width = static_cast<int>(size[right[axis]]);
    p.height = static_cast<int>(size[up[axis]]);
    p.depth.assign(static_cast<std::size_t>(p.width) * static_cast<std::size_t>(p.height), 0.0);
  }
  const auto add = [&](const Coord& c, const Voxel& voxel) {
    const int at[3] = {c.x - box.low.x, c.y - box.low.y, c.z - box.low.z};
    for (int axis = 0; axis < 3; ++axis) {
      Projection& p = result[static_cast<std::size_t>(axis)];
      if (p.depth.empty()) continue;
      const int row = p.height - 1 - at[up[axis]];
      p.depth[static_cast<std::size_t>(row) * static_cast<std::size_t>(p.width) + static_cast<std::size_t>(at[right[axis]])] +=
          voxel.extinction * step_m[axis];
    }
  };
  for (const SparseGrid* grid : grids) for_each_voxel(*grid, add);
  return result;
}

}  // namespace arcus::media
