#include "media/majorant/majorant_grid.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "media/grid/sparse_grid.h"

namespace arcus::media {
namespace {

using Cell = MajorantGrid::Cell;

constexpr std::int64_t most_blocks = std::int64_t{1} << 22;  // 64 MiB of blocks
constexpr std::size_t most_cells = std::size_t{1} << 24;     // 128 MiB of cells
constexpr int block_voxels = 64;
constexpr float least_majorant_per_m = 1e-30f;  // less is nothing over any distance, and its inverse no float

/// Where the voxels lie that interpolation, linear or nearest, can read in a box: reading at p takes voxels ⌊p⌋ and ⌊p⌋ + 1, or
/// ⌊p + ½⌋. A face within rounding of a plane of voxels counts as lying in it, else every cell would reach one plane too far.
IndexBox footprint(const Box& box) {
  static constexpr double rounding = 1e-6, limit = 1 << 30;
  const auto down = [](double x) { return static_cast<int>(std::floor(std::clamp(x, -limit, limit) + rounding)); };
  const auto up = [](double x) { return static_cast<int>(std::ceil(std::clamp(x, -limit, limit) - rounding)); };
  return {{down(box.low.x), down(box.low.y), down(box.low.z)}, {up(box.high.x), up(box.high.y), up(box.high.z)}};
}

/// A source seen from block coordinates.
struct SourceInBlocks {
  MajorantSource source;
  Affine index_from_block;

  /// Bounds over a box of block space.
  Cell bounds(const Box& box, bool exact) const {
    const Box in_index = bounds_of(index_from_block, box);
    if (source.grid) {
      const SparseGrid::Range range = source.grid->range(footprint(in_index), exact);
      return {range.largest * source.largest_factor, range.smallest * source.smallest_factor};
    }
    const Box& own = source.box;
    for (int axis = 0; axis < 3; ++axis)
      if (in_index.low[axis] > own.high[axis] || in_index.high[axis] < own.low[axis]) return {0, 0};
    const bool whole = own.contains(in_index.low) && own.contains(in_index.high);
    return {source.largest_factor, whole ? source.smallest_factor : 0};
  }
};

/// Where a source can scatter, in index space.
Box support_of(const MajorantSource& source) {
  if (!source.grid) return source.box;
  return source.grid->voxels().is_empty() ? Box{} : source.grid->voxels().box().grown_by(1);
}

/// Bounds at every level of one block, level L as n³ cells [x][y][z] with n = 2^L.
class BlockPyramid {
 public:
  /// Parts in which majorant and minorant differ by less than `enough_per_m` · 2^level are not cut further.
  BlockPyramid(const std::vector<SourceInBlocks>& sources, int levels, double enough_per_m)
      : candidates_(static_cast<std::size_t>(levels) + 2), enough_per_m_(enough_per_m) {
    for (const SourceInBlocks& source : sources) candidates_[0].push_back(&source);
    for (int level = 0; level <= levels; ++level) cells_.emplace_back(std::size_t{1} << 3 * level);
  }

  void fill(const Vec3& block_low) {
    low_ = block_low;
    deepest_ = 0;
    fill(0, 0, 0, 0);
  }
  /// The finest level that tells more than the one above it.
  int deepest() const { return deepest_; }
  const std::vector<Cell>& level(int l) const { return cells_[static_cast<std::size_t>(l)]; }
  double mean_majorant(int l) const {
    double sum = 0;
    for (const Cell& cell : level(l)) sum += cell.majorant_per_m;
    return sum / static_cast<double>(level(l).size());
  }

 private:
  Cell fill(int level, int x, int y, int z) {
    const int n = 1 << level;
    const bool is_finest = level + 1 == static_cast<int>(cells_.size());
    const Box box{low_ + Vec3(x, y, z) * (1.0 / n), low_ + Vec3(x + 1, y + 1, z + 1) * (1.0 / n)};
    Cell bounds{0, 0};
    std::vector<const SourceInBlocks*>& here = candidates_[static_cast<std::size_t>(level) + 1];
    here.clear();
    for (const SourceInBlocks* source : candidates_[static_cast<std::size_t>(level)]) {
      const Cell own = source->bounds(box, is_finest);
      if (own.majorant_per_m == 0) continue;
      here.push_back(source);
      bounds.majorant_per_m += own.majorant_per_m;
      bounds.minorant_per_m += own.minorant_per_m;
    }
    if (bounds.majorant_per_m < least_majorant_per_m) bounds = {0, 0};
    Cell& cell = cells_[static_cast<std::size_t>(level)][static_cast<std::size_t>((x * n + y) * n + z)];
    if (is_finest || bounds.majorant_per_m - bounds.minorant_per_m <= enough_per_m_ * n) {
      bounds.majorant_per_m *= 1 + 1e-6f;  // outlives the rounding of sums and products above and at lookups
      bounds.minorant_per_m *= 1 - 1e-6f;
      if (level > 0) spread(bounds, level, x, y, z);
      return cell = bounds;
    }
    deepest_ = std::max(deepest_, level + 1);
    bounds = {0, std::numeric_limits<float>::infinity()};
    for (int i = 0; i < 8; ++i) {
      const Cell part = fill(level + 1, 2 * x + (i >> 2), 2 * y + (i >> 1 & 1), 2 * z + (i & 1));
      bounds.majorant_per_m = std::max(bounds.majorant_per_m, part.majorant_per_m);
      bounds.minorant_per_m = std::min(bounds.minorant_per_m, part.minorant_per_m);
    }
    return cell = bounds;  // the parts know better than the whole
  }

  /// Gives all cells below one the same bounds.
  void spread(const Cell& bounds, int level, int x, int y, int z) {
    for (int below = level + 1; below < static_cast<int>(cells_.size()); ++below) {
      const int factor = 1 << (below - level), n = 1 << below;
      for (int i = 0; i < factor; ++i)
        for (int j = 0; j < factor; ++j) {
          Cell* row = cells_[static_cast<std::size_t>(below)].data() +
                      ((x * factor + i) * n + y * factor + j) * n + z * factor;
          std::fill(row, row + factor, bounds);
        }
    }
  }

  std::vector<std::vector<const SourceInBlocks*>> candidates_;  // [level]: what may scatter in the cell being filled
  std::vector<std::vector<Cell>> cells_;                        // [level]
  double enough_per_m_;
  int deepest_ = 0;
  Vec3 low_{0, 0, 0};
};

/// Level with the least expected cost for a line that crosses the block: an isotropic line crosses n³ cells in about n
/// steps (mean chord 2/3 of the edge, 3/2 faces per edge length) and meets majorant × chord tentative collisions.
int cheapest_level(const BlockPyramid& pyramid, double edge_m, const MajorantCosts& costs) {
  int best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int level = 0; level <= pyramid.deepest(); ++level) {
    const double cost =
        costs.cell_ns * (1 << level) + costs.collision_ns * pyramid.mean_majorant(level) * edge_m * (2.0 / 3);
    if (cost < least) {
      least = cost;
      best = level;
    }
  }
  return best;
}

/// Edge of a voxel or, without voxels, of what a box would be cut into [m].
double finest_edge_m(const MajorantSource& source) {
  return std::cbrt(std::fabs(source.world_from_index.determinant()));
}

}  // namespace

MajorantGrid::MajorantGrid(const std::vector<MajorantSource>& given, const MajorantCosts& costs) {
  std::vector<MajorantSource> sources;
  for (const MajorantSource& source : given)
    if (source.largest_factor > 0 && !support_of(source).is_empty()) sources.push_back(source);
  if (sources.empty()) return;

  // The grid with the finest voxels lends its axes. Without a grid, a lone block of matter is one cell and several
  // are cut along the world's axes.
  const MajorantSource* leading = nullptr;
  for (const MajorantSource& source : sources)
    if (source.grid && (!leading || finest_edge_m(source) < finest_edge_m(*leading))) leading = &source;
  Affine world_from_frame;
  Vec3 edge(block_voxels);  // of a block, in the frame's units
  if (leading) {
    world_from_frame = leading->world_from_index;
  } else if (sources.size() == 1) {
    world_from_frame = sources[0].world_from_index;
    edge = sources[0].box.size();
  } else {
    Box all;
    for (const MajorantSource& source : sources) all.include(bounds_of(source.world_from_index, support_of(source)));
    edge = all.size() * (1.0 / 8);
  }
  const Affine frame_from_world = world_from_frame.inverse();
  Box extent;  // in the frame
  for (const MajorantSource& source : sources) {
    extent.include(bounds_of(frame_from_world * source.world_from_index, support_of(source)));
    bounds_m_.include(bounds_of(source.world_from_index, support_of(source)));
  }
  Vec3 base = extent.low;
  if (leading)  // cells end at planes of voxels between bricks: then linear and nearest lookups read the fewest
    for (int axis = 0; axis < 3; ++axis) base[axis] = std::floor(extent.low[axis] / 8 + 1e-9) * 8;
  int levels = leading ? 4 : sources.size() == 1 ? 0 : 3;
  std::int64_t blocks = 0;
  while (true) {
    double product = 1;
    for (int axis = 0; axis < 3; ++axis) {
      if (!(edge[axis] > 0)) edge[axis] = 1;  // a flat box still has one block
      const double n = std::max(1.0, std::ceil((extent.high[axis] - base[axis]) / edge[axis] - 1e-9));
      product *= n;
      (axis == 0 ? count_.x : axis == 1 ? count_.y : count_.z) = static_cast<int>(std::min(n, 1e9));
    }
    if (product <= static_cast<double>(most_blocks)) {
      blocks = std::int64_t{count_.x} * count_.y * count_.z;
      break;
    }
    edge *= 2;
    levels = std::min(levels + 1, most_levels);
  }
  const Affine world_from_block = world_from_frame * Affine::translation(base) * Affine::scaling(edge);
  block_from_world_ = world_from_block.inverse();
  const double edge_m = std::cbrt(std::fabs(world_from_block.determinant()));

  std::vector<SourceInBlocks> in_blocks;
  for (const MajorantSource& source : sources)
    in_blocks.push_back({source, source.world_from_index.inverse() * world_from_block});

  // Twice over all blocks: first to choose levels, then, with every block's place known, to keep the cells.
  blocks_.resize(static_cast<std::size_t>(blocks));
  const auto low_of = [&](std::int64_t b) {
    return Vec3(static_cast<double>(b / count_.z / count_.y), static_cast<double>(b / count_.z % count_.y),
                static_cast<double>(b % count_.z));
  };
  const auto for_slabs = [&](const auto& work) {
    tbb::parallel_for(tbb::blocked_range<std::int64_t>(0, blocks), [&](const tbb::blocked_range<std::int64_t>& range) {
      // What the best refinement of a part could save is (majorant − minorant) × its chord, 2/3 of its edge, of collisions; it
      // costs a step through a cell.
      BlockPyramid pyramid(in_blocks, levels, costs.cell_ns / (costs.collision_ns * edge_m * (2.0 / 3)));
      for (std::int64_t b = range.begin(); b < range.end(); ++b) work(pyramid, b);
    });
  };
  for_slabs([&](BlockPyramid& pyramid, std::int64_t b) {
    pyramid.fill(low_of(b));
    Block& block = blocks_[static_cast<std::size_t>(b)];
    block.majorant_per_m = pyramid.level(0)[0].majorant_per_m;
    block.minorant_per_m = pyramid.level(0)[0].minorant_per_m;
    block.level = static_cast<std::uint32_t>(cheapest_level(pyramid, edge_m, costs));
  });
  std::size_t total = 0;
  for (int most = levels; most >= 0; --most) {
    total = 0;
    for (Block& block : blocks_) {
      block.level = std::min(block.level, static_cast<std::uint32_t>(most));
      block.first_cell = static_cast<std::uint32_t>(total);
      if (block.level > 0) total += std::size_t{1} << 3 * block.level;
    }
    if (total <= most_cells) break;
  }
  cells_.resize(total);
  for_slabs([&](BlockPyramid& pyramid, std::int64_t b) {
    const Block& block = blocks_[static_cast<std::size_t>(b)];
    if (block.level == 0) return;
    pyramid.fill(low_of(b));
    const std::vector<Cell>& cells = pyramid.level(static_cast<int>(block.level));
    std::copy(cells.begin(), cells.end(), cells_.begin() + block.first_cell);
  });
}

Cell MajorantGrid::at(const Vec3& position_m) const {
  const Vec3 p = block_from_world_.point(position_m);
  const auto inside = [](double x, int n) { return x >= 0 && x < n; };
  if (!inside(p.x, count_.x) || !inside(p.y, count_.y) || !inside(p.z, count_.z)) return {0, 0};
  const int x = static_cast<int>(p.x), y = static_cast<int>(p.y), z = static_cast<int>(p.z);
  const Block& block = blocks_[(static_cast<std::size_t>(x) * count_.y + y) * count_.z + z];
  if (block.level == 0) return {block.majorant_per_m, block.minorant_per_m};
  const int n = 1 << block.level;
  const int cx = static_cast<int>((p.x - x) * n), cy = static_cast<int>((p.y - y) * n), cz = static_cast<int>((p.z - z) * n);
  return cells_[block.first_cell + static_cast<std::size_t>((cx * n + cy) * n + cz)];
}

}  // namespace arcus::media
