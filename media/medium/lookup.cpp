#include "media/medium/lookup.h"

namespace arcus::media {

Spectrum Lookup::interpolated(const Vec3& index, const RatioTable::Columns& columns) const {
  Spectrum total;
  const auto add = [&](const Voxel& voxel, double weight) {
    if (voxel.extinction == 0 || weight == 0) return;
    const float size = sizes_vary ? voxel.size_um : size_um;
    total += ratios.at(size, columns) * static_cast<float>(weight * voxel.extinction * scale);
  };
  if (!grid || !is_linear) {
    add(read(index, Vec3(0)), 1);
    return total;
  }
  const int x = whole(index.x), y = whole(index.y), z = whole(index.z);
  const double share_x = index.x - x, share_y = index.y - y, share_z = index.z - z;
  for (int i = 0; i < 8; ++i) {
    const int up_x = i & 1, up_y = i >> 1 & 1, up_z = i >> 2;
    add(grid->at(x + up_x, y + up_y, z + up_z), (up_x ? share_x : 1 - share_x) * (up_y ? share_y : 1 - share_y) *
                                                    (up_z ? share_z : 1 - share_z));
  }
  return total;
}

Box Lookup::support() const {
  if (!grid) return box;
  return grid->voxels().is_empty() ? Box{} : grid->voxels().box().grown_by(1);
}

}  // namespace arcus::media
