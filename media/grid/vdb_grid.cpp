#include "media/grid/vdb_grid.h"

#include <openvdb/openvdb.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "phase/base/error.h"
#include "phase/settings/number_text.h"

namespace arcus::media {
namespace {

const openvdb::GridBase& base(const std::shared_ptr<void>& grid) {
  return *static_cast<const openvdb::GridBase*>(grid.get());
}

template <class Metadata>
auto read(const std::shared_ptr<void>& grid, const std::string& name) {
  const auto found = base(grid).getMetadata<Metadata>(name);
  return found ? std::optional(found->value()) : std::nullopt;
}

}  // namespace

VdbGrid::VdbGrid(std::shared_ptr<void> grid, std::string where) : grid_(std::move(grid)), where_(std::move(where)) {}

bool VdbGrid::is_level_set() const { return base(grid_).getGridClass() == openvdb::GRID_LEVEL_SET; }

std::string VdbGrid::class_words() const {
  switch (base(grid_).getGridClass()) {
    case openvdb::GRID_FOG_VOLUME: return "fog volume";
    case openvdb::GRID_LEVEL_SET: return "level set";
    case openvdb::GRID_STAGGERED: return "staggered";
    default: return "no class";
  }
}

std::optional<std::string> VdbGrid::text(const std::string& name) const {
  return read<openvdb::StringMetadata>(grid_, name);
}
std::optional<std::int32_t> VdbGrid::integer(const std::string& name) const {
  return read<openvdb::Int32Metadata>(grid_, name);
}
std::optional<float> VdbGrid::number(const std::string& name) const {
  return read<openvdb::FloatMetadata>(grid_, name);
}

std::vector<std::pair<std::string, std::string>> VdbGrid::metadata() const {
  std::vector<std::pair<std::string, std::string>> result;
  for (auto entry = base(grid_).beginMeta(); entry != base(grid_).endMeta(); ++entry)
    if (!entry->first.starts_with("file_") && entry->first != "name" && entry->second)
      result.emplace_back(entry->first, entry->second->str());
  return result;
}

bool VdbGrid::is_affine() const { return base(grid_).transform().isLinear(); }

namespace {

/// The matrix of a map that is affine. OpenVDB's own conversion refuses voxels below about 1e-5.
openvdb::Mat4R matrix_of(const openvdb::math::MapBase& map) {
  openvdb::Mat4R m = openvdb::Mat4R::identity();
  const openvdb::Vec3d origin = map.applyMap({0, 0, 0});
  for (int i = 0; i < 3; ++i) {
    openvdb::Vec3d axis(0, 0, 0);
    axis[i] = 1;
    const openvdb::Vec3d image = map.applyJacobian(axis);
    for (int j = 0; j < 3; ++j) m(i, j) = image[j];
    m(3, i) = origin[i];
  }
  return m;
}

}  // namespace

Affine VdbGrid::affine() const {
  const openvdb::Mat4R m = matrix_of(*base(grid_).transform().baseMap());
  const auto row = [&](int i) { return Vec3(m(i, 0), m(i, 1), m(i, 2)); };  // OpenVDB multiplies vectors from the left
  return {row(0), row(1), row(2), row(3)};
}

Affine VdbGrid::world_from_index() const {
  if (!is_affine())
    throw bad_input(where_, "a frustum transform", "voxels of one size and shape expected",
                    "Resample the grid to an ordinary transform");
  const Affine map = affine();
  const double volume = map.determinant(), scale = length(map.x) * length(map.y) * length(map.z);
  if (!std::isfinite(volume) || !std::isfinite(length(map.origin)) || !(std::fabs(volume) > 1e-12 * scale))
    throw bad_input(where_, "a transform that makes it flat or endless", "one that can be inverted expected");
  return map;
}

}  // namespace arcus::media
