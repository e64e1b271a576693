// How OpenVDB's trees become the renderer's bricks.

#include <openvdb/openvdb.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "media/grid/vdb_grid.h"
#include "phase/base/error.h"
#include "phase/settings/number_text.h"

namespace arcus::media {
namespace {

constexpr int edge = SparseGrid::brick_edge;

Coord coord_of(const openvdb::Coord& c) { return {c.x(), c.y(), c.z()}; }

std::string words(const Coord& c) {
  return "(" + std::to_string(c.x) + ", " + std::to_string(c.y) + ", " + std::to_string(c.z) + ")";
}
std::string words(double x) {
  return std::isnan(x) ? "NaN" : std::isinf(x) ? (x < 0 ? "-infinity" : "infinity") : number_text(x);
}

bool is_extinction(double x) { return x >= 0 && x <= std::numeric_limits<float>::max(); }
bool is_size(double x) { return x > 0 && x <= std::numeric_limits<float>::max(); }

/// The first voxel, in the order of coordinates, that holds what it should not.
class Complaint {
 public:
  void offer(const Coord& voxel, double value) {
    if (is_given_ && !(voxel < voxel_)) return;
    voxel_ = voxel;
    value_ = value;
    is_given_ = true;
  }
  void offer(const Complaint& other) {
    if (other.is_given_) offer(other.voxel_, other.value_);
  }
  void raise(const std::string& where, const std::string& expected) const {
    if (is_given_) throw bad_input(where, words(value_) + " at voxel " + words(voxel_), expected);
  }

 private:
  Coord voxel_;
  double value_ = 0;
  bool is_given_ = false;
};

/// An active region of one value above the leaves: a cube of 8, 128 or 4096 voxels' edge.
struct Tile {
  IndexBox box;
  float value;
};

/// The leaves and active tiles of a tree.
template <class Grid>
struct Parts {
  using Leaf = typename Grid::TreeType::LeafNodeType;
  std::vector<const Leaf*> leaves;
  std::vector<Tile> tiles;

  /// wanted(value): whether an active voxel may hold that.
  template <class Wanted>
  Parts(const Grid& grid, const Wanted& wanted, const std::string& where, const std::string& expected) {
    for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf) leaves.push_back(leaf.getLeaf());
    std::vector<Complaint> complaints(leaves.size());
    tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t i) {
      const Leaf& leaf = *leaves[i];
      for (openvdb::Index v = 0; v < SparseGrid::brick_voxels; ++v)
        if (const auto value = static_cast<double>(leaf.getValue(v)); !wanted(value) && leaf.isValueOn(v))
          complaints[i].offer(coord_of(leaf.offsetToGlobalCoord(v)), value);
    });
    Complaint first;
    for (const Complaint& complaint : complaints) first.offer(complaint);
    auto value = grid.tree().cbeginValueOn();
    value.setMaxDepth(value.getLeafDepth() - 1);
    for (; value; ++value) {
      const openvdb::CoordBBox box = value.getBoundingBox();
      tiles.push_back({{coord_of(box.min()), coord_of(box.max())}, static_cast<float>(*value)});
      if (!wanted(static_cast<double>(*value))) first.offer(coord_of(box.min()), static_cast<double>(*value));
    }
    first.raise(where, expected);
  }
};

template <class Leaf>
IndexBox box_of_values(const Leaf& leaf, bool inactive_too) {
  IndexBox box;
  for (openvdb::Index i = 0; i < SparseGrid::brick_voxels; ++i)
    if ((inactive_too || leaf.isValueOn(i)) && leaf.getValue(i) != 0) box.include(coord_of(leaf.offsetToGlobalCoord(i)));
  return box;
}

/// Calls visit(first voxel) for every cube of `step` voxels' edge in a box made of such cubes.
template <class Visit>
void for_cubes(const IndexBox& box, int step, const Visit& visit) {
  for (int x = box.low.x; x <= box.high.x; x += step)
    for (int y = box.low.y; y <= box.high.y; y += step)
      for (int z = box.low.z; z <= box.high.z; z += step) visit(Coord{x, y, z});
}

/// The sizes of a brick's voxels, in their order; 0 stands for the size elsewhere.
const float* sizes_of_brick(const SizeField& sizes, const Coord& first) { return sizes.grid.address(first.x, first.y, first.z); }

/// The one size of all voxels in a cube, where there is one.
std::optional<float> common_size(const SizeField* sizes, const Coord& first, int step) {
  if (!sizes) return 0.f;
  const SparseGrid::Range range =
      sizes->grid.range({first, {first.x + step - 1, first.y + step - 1, first.z + step - 1}}, false);
  if (range.smallest != range.largest) return std::nullopt;
  return range.largest == 0 ? sizes->elsewhere : range.largest;
}

template <class Grid>
SparseGrid convert(const Parts<Grid>& parts, const SizeField* sizes, bool inactive_too, const std::string& where) {
  using Leaf = typename Grid::TreeType::LeafNodeType;
  IndexBox box;
  std::vector<const Leaf*> leaves;
  std::vector<IndexBox> boxes(parts.leaves.size());
  tbb::parallel_for(std::size_t{0}, boxes.size(), [&](std::size_t i) { boxes[i] = box_of_values(*parts.leaves[i], inactive_too); });
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (!boxes[i].is_empty()) leaves.push_back(parts.leaves[i]);
    box.include(boxes[i]);
  }
  for (const Tile& tile : parts.tiles)
    if (tile.value != 0) box.include(tile.box);

  SparseGridBuilder builder(box, sizes != nullptr, where);
  std::vector<std::uint32_t> numbers;
  for (const Leaf* leaf : leaves) numbers.push_back(builder.add_brick(coord_of(leaf->origin())));
  struct UnevenBrick {  // one extinction, several sizes
    std::uint32_t number;
    Coord first;
    float value;
  };
  std::vector<UnevenBrick> uneven;
  Complaint no_size;
  const auto place_brick = [&](const Coord& first, float value) {
    if (const auto size = common_size(sizes, first, edge)) {
      if (sizes && !is_size(*size)) no_size.offer(first, *size);
      builder.set_constant_brick(first, {value, *size});
    } else {
      uneven.push_back({builder.add_brick(first), first, value});
    }
  };
  for (const Tile& tile : parts.tiles) {
    if (tile.value == 0) continue;
    if (tile.box.size(0) == edge) {
      place_brick(tile.box.low, tile.value);
      continue;
    }
    for_cubes(tile.box, SparseGrid::block_edge, [&](const Coord& first) {
      constexpr int last = SparseGrid::block_edge - 1;
      if (const auto size = common_size(sizes, first, SparseGrid::block_edge); size && (!sizes || is_size(*size))) {
        builder.set_constant_block(first, {tile.value, *size});
      } else {
        for_cubes({first, {first.x + last, first.y + last, first.z + last}}, edge,
                  [&](const Coord& brick) { place_brick(brick, tile.value); });
      }
    });
  }
  builder.allocate();

  std::vector<Complaint> complaints(leaves.size());
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t b) {
    const Leaf& leaf = *leaves[b];
    float* out = builder.values(numbers[b]);
    const float* own = sizes ? sizes_of_brick(*sizes, coord_of(leaf.origin())) : nullptr;
    for (openvdb::Index i = 0; i < SparseGrid::brick_voxels; ++i) {
      const float value = inactive_too || leaf.isValueOn(i) ? static_cast<float>(leaf.getValue(i)) : 0.f;
      *out++ = value;
      if (!sizes) continue;
      const float size = value > 0 ? own[i] == 0 ? sizes->elsewhere : own[i] : 0.f;
      if (value > 0 && !is_size(size)) complaints[b].offer(coord_of(leaf.offsetToGlobalCoord(i)), size);
      *out++ = size;
    }
  });
  for (const UnevenBrick& brick : uneven) {
    float* out = builder.values(brick.number);
    const float* own = sizes_of_brick(*sizes, brick.first);
    for (int i = 0; i < SparseGrid::brick_voxels; ++i) {
      const float size = own[i] == 0 ? sizes->elsewhere : own[i];
      if (!is_size(size)) no_size.offer({brick.first.x + (i >> 6), brick.first.y + (i >> 3 & 7), brick.first.z + (i & 7)}, size);
      *out++ = brick.value;
      *out++ = size;
    }
  }
  for (const Complaint& complaint : complaints) no_size.offer(complaint);
  no_size.raise(where, "a size above 0 expected in its size grid wherever extinction is above 0");
  return builder.finish();
}

/// Calls visit with the grid as what it is, float or double.
template <class Visit>
auto visit_numbers(const std::shared_ptr<void>& grid, const Visit& visit) {
  const auto& base = *static_cast<const openvdb::GridBase*>(grid.get());
  if (base.isType<openvdb::DoubleGrid>()) return visit(static_cast<const openvdb::DoubleGrid&>(base));
  return visit(static_cast<const openvdb::FloatGrid&>(base));
}

}  // namespace

SparseGrid VdbGrid::sparse_grid(const SizeField* sizes) const {
  return visit_numbers(grid_, [&](const auto& grid) {
    using Grid = std::decay_t<decltype(grid)>;
    if (grid.background() != 0)
      throw bad_input(where_, "a background of " + words(static_cast<double>(grid.background())), "0 expected",
                      "A medium without end cannot be rendered: set its background to 0");
    const Parts<Grid> parts(grid, is_extinction, where_, "finite values that are not negative expected");
    if (grid.tree().empty() || grid.activeVoxelCount() == 0)
      throw bad_input(where_, "no active voxel", "at least one expected", "Only active voxels scatter light");
    return convert(parts, sizes, false, where_);
  });
}

SizeField VdbGrid::size_field() const {
  return visit_numbers(grid_, [&](const auto& grid) {
    using Grid = std::decay_t<decltype(grid)>;
    const Parts<Grid> parts(grid, [](double) { return true; }, where_, "");
    const float elsewhere = static_cast<float>(grid.background());
    return SizeField{convert(parts, nullptr, true, where_), elsewhere};
  });
}

}  // namespace arcus::media
