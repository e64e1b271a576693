#pragma once
// A component as tracking reads it: made ready so that a lookup is a few multiplications and one memory access.

#include <cmath>

#include "media/grid/sparse_grid.h"
#include "media/medium/component.h"
#include "media/medium/ratio_table.h"

namespace arcus::media {

struct Lookup {
  const SparseGrid* grid = nullptr;  ///< none: 1 inside box
  Box box;
  Affine index_from_world;
  bool is_linear = true;
  float scale = 1;       ///< extinction at 550 nm per unit of the grid's value [1/m]
  bool sizes_vary = false;
  float size_um = 0;     ///< where they do not
  RatioTable ratios;

  /// Extinction in the grid's unit at a point in index space, in one of its voxels. Linear: u, in [0, 1)³, chooses one of
  /// the eight around the point with the trilinear weights, so that the mean over u is the interpolated value
  /// (⌊p + u⌋ is ⌊p⌋ + 1 with probability p − ⌊p⌋).
  Voxel read(const Vec3& index, const Vec3& u) const {
    if (!grid) return {box.contains(index) ? 1.f : 0.f, 0.f};
    const Vec3 p = index + (is_linear ? u : Vec3(0.5));
    const float* address = grid->address(whole(p.x), whole(p.y), whole(p.z));
    return {address[0], grid->has_size() ? address[1] : 0.f};
  }

  /// Mean of read() over u: extinction at the columns' wavelengths [1/m].
  Spectrum interpolated(const Vec3& index, const RatioTable::Columns& columns) const;

  /// Everything outside is empty; in index space.
  Box support() const;

  static int whole(double x) { return static_cast<int>(std::floor(x)); }
};

}  // namespace arcus::media
