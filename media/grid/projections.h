#pragma once
// A grid seen along its axes: what `arcus info --png` shows.

#include <array>
#include <functional>
#include <vector>

#include "media/grid/sparse_grid.h"

namespace arcus::media {

/// Integral of extinction over the columns along one index axis: the optical depth where voxels are `step_m` long.
struct Projection {
  int width = 0, height = 0;  ///< voxels
  std::vector<double> depth;  ///< [row][column], the highest row first
};

/// Along x (y to the right, z up), along y (x to the right, z up) and along z (x to the right, y up); empty where a picture would have
/// more than 2²⁶ points.
std::array<Projection, 3> projections(const SparseGrid& grid, const Vec3& step_m);
/// Of several grids with the same voxels: their sum.
std::array<Projection, 3> projections(const std::vector<const SparseGrid*>& grids, const Vec3& step_m);

/// Calls visit for every voxel that is not zero, brick by brick.
void for_each_voxel(const SparseGrid& grid, const std::function<void(const Coord&, const Voxel&)>& visit);

}  // namespace arcus::media
