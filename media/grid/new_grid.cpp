#include "media/grid/new_grid.h"

#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <cassert>

#include "phase/base/error.h"
#include "phase/base/version.h"
#include "phase/base/whole_file.h"

namespace arcus::media {
namespace {

openvdb::math::Transform::Ptr transform_of(const Affine& map) {
  openvdb::math::Mat4d matrix = openvdb::math::Mat4d::identity();
  const Vec3 rows[4] = {map.x, map.y, map.z, map.origin};  // OpenVDB multiplies vectors from the left
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 3; ++column) matrix(row, column) = rows[row][column];
  return openvdb::math::Transform::createLinearTransform(matrix);
}

openvdb::FloatGrid::Ptr vdb_grid(const NewGrid& grid) {
  const auto result = openvdb::FloatGrid::create(0.f);
  result->setName(grid.name);
  result->setGridClass(grid.is_fog_volume ? openvdb::GRID_FOG_VOLUME : openvdb::GRID_UNKNOWN);
  result->setTransform(transform_of(grid.world_from_index));
  for (const NewBrick& brick : grid.bricks) {
    const openvdb::Coord origin(brick.origin.x, brick.origin.y, brick.origin.z);
    auto leaf = std::make_unique<openvdb::FloatTree::LeafNodeType>(origin, 0.f, false);
    bool any = false;
    for (openvdb::Index i = 0; i < SparseGrid::brick_voxels; ++i)
      if (brick.values[i] != 0) {
        leaf->setValueOn(i, brick.values[i]);
        any = true;
      }
    if (any) result->tree().addLeaf(leaf.release());
  }
  for (const auto& [name, value] : grid.metadata)
    std::visit(
        [&, name = name](const auto& v) {
          using T = std::decay_t<decltype(v)>;
          result->insertMeta(name, openvdb::TypedMetadata<T>(v));
        },
        value);
  return result;
}

}  // namespace

std::vector<NewGrid> grids_of(NewSpecies species) {
  assert(species.size.empty() || species.size.size() == species.extinction.size());
  std::vector<NewGrid> grids(species.size.empty() ? 1 : 2);
  grids[0].name = species.name + ".extinction";
  grids[0].world_from_index = species.world_from_index;
  grids[0].bricks = std::move(species.extinction);
  grids[0].metadata = {{"arcus_format", std::int32_t{1}},
                       {"arcus_phase", species.recipe},
                       {"arcus_phase_id", species.phase_id},
                       {"creator", std::string("arcus ") + version}};
  if (species.size.empty()) {
    if (species.size_um > 0) grids[0].metadata.emplace_back("arcus_size_um", species.size_um);
    return grids;
  }
  grids[1].name = species.name + ".size";
  grids[1].is_fog_volume = false;
  grids[1].world_from_index = species.world_from_index;
  grids[1].bricks = std::move(species.size);
  grids[1].metadata = {{"creator", std::string("arcus ") + version}};
  return grids;
}

void save_grids(const std::string& path, const std::vector<NewGrid>& grids) {
  WholeFile file(path);
  openvdb::initialize();
  openvdb::GridPtrVec list;
  for (const NewGrid& grid : grids) list.push_back(vdb_grid(grid));
  try {
    openvdb::io::File out(file.temporary_path());
    out.setCompression(openvdb::io::COMPRESS_ACTIVE_MASK |
                       (openvdb::io::Archive::hasBloscCompression() ? openvdb::io::COMPRESS_BLOSC : openvdb::io::COMPRESS_ZIP));
    out.write(list);
    out.close();
  } catch (const openvdb::Exception& error) {
    throw cannot("cannot write " + path, error.what());
  }
  file.commit();
}

SparseGrid sparse_grid_of(const NewSpecies& species) {
  const bool with_size = !species.size.empty();
  IndexBox box;
  for (const NewBrick& brick : species.extinction) {
    box.include(brick.origin);
    box.include(Coord{brick.origin.x + 7, brick.origin.y + 7, brick.origin.z + 7});
  }
  SparseGridBuilder builder(box, with_size, species.name);
  std::vector<std::uint32_t> numbers;
  for (const NewBrick& brick : species.extinction) numbers.push_back(builder.add_brick(brick.origin));
  builder.allocate();
  for (std::size_t b = 0; b < numbers.size(); ++b) {
    float* out = builder.values(numbers[b]);
    for (std::size_t i = 0; i < SparseGrid::brick_voxels; ++i) {
      *out++ = species.extinction[b].values[i];
      if (with_size) *out++ = species.size[b].values[i];
    }
  }
  return builder.finish();
}

}  // namespace arcus::media
