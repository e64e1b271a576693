#pragma once
// Extinction and size by voxel as the renderer reads them: bricks of 8³ voxels, found through two tables. A grid is
// immutable once built.
//
// root (dense, one entry a block of 64³ voxels) → table of the block's 8³ bricks → brick of 8³ voxels. Empty space and
// regions of one value share one table and one brick, so a lookup has no special cases. Extinction and size of a voxel
// lie side by side, so that both cost one memory access. (Why not NanoVDB: docs in media/README.md.)

#include <cstdint>
#include <functional>
#include <memory>
#include <unordered_map>
#include <vector>

#include "media/grid/large_array.h"
#include "media/space/index.h"

namespace arcus::media {

/// What a voxel holds.
struct Voxel {
  float extinction = 0;  ///< or density: whatever the file holds
  float size_um = 0;     ///< 0 where the grid has no sizes
};

class SparseGrid {
 public:
  static constexpr int brick_edge = 8, block_edge = 64, brick_voxels = 512;

  /// Zero outside voxels().
  Voxel at(int x, int y, int z) const {
    const float* values = address(x, y, z);
    return {values[0], channels_ == 2 ? values[1] : 0.f};
  }
  /// Where a voxel's extinction lies, followed by its size where has_size(); zeros outside voxels().
  const float* address(int x, int y, int z) const {
    const auto dx = static_cast<unsigned>(x) - origin_x_, dy = static_cast<unsigned>(y) - origin_y_,
               dz = static_cast<unsigned>(z) - origin_z_;
    if ((dx >> 6) >= blocks_x_ || (dy >> 6) >= blocks_y_ || (dz >> 6) >= blocks_z_) return values_.data();
    const std::size_t block = (std::size_t{dx >> 6} * blocks_y_ + (dy >> 6)) * blocks_z_ + (dz >> 6);
    const std::size_t slot = std::size_t{root_[block]} * 512 + ((dx >> 3 & 7) << 6 | (dy >> 3 & 7) << 3 | (dz >> 3 & 7));
    const std::size_t voxel = std::size_t{tables_[slot]} * 512 + ((dx & 7) << 6 | (dy & 7) << 3 | (dz & 7));
    return values_.data() + voxel * channels_;
  }

  bool has_size() const { return channels_ == 2; }
  /// All voxels that are not zero lie within; empty where there are none.
  const IndexBox& voxels() const { return voxels_; }
  /// Smallest and largest extinction of the voxels in a box. Where it need not be exact, bricks count as a whole: wider,
  /// but quick for large boxes.
  struct Range {
    float smallest, largest;
  };
  Range range(const IndexBox& box, bool exact) const;
  float largest_extinction() const { return largest_; }
  /// Sizes of the voxels whose extinction is above 0; zeros without sizes or without such voxels.
  Range size_range() const;
  std::size_t brick_count() const { return brick_ranges_.size(); }
  std::size_t memory_bytes() const;

 private:
  friend class SparseGridBuilder;
  std::uint32_t brick_at(int bx, int by, int bz) const;  // coordinates / 8

  unsigned origin_x_ = 0, origin_y_ = 0, origin_z_ = 0;  // of the first block; arithmetic modulo 2³² is intended
  unsigned blocks_x_ = 0, blocks_y_ = 0, blocks_z_ = 0;
  unsigned channels_ = 1;
  IndexBox voxels_;
  float largest_ = 0;
  std::vector<std::uint32_t> root_, tables_;        // 0: the table, or the brick, that is empty
  std::vector<Range> brick_ranges_;                 // [brick], of extinction
  LargeArray<float> values_;                        // [brick][x][y][z][channel]
};

/// Fills a grid: first every brick is announced, then allocate(), then values.
class SparseGridBuilder {
 public:
  /// For voxels in a box; `where` names the grid in messages. Throws bad_input where the box is larger than the tables can
  /// address (about 16,000 voxels in every direction, or more along fewer).
  SparseGridBuilder(const IndexBox& voxels, bool with_size, const std::string& where);

  /// A brick of its own for the voxel's surroundings; its number. Not for a brick that was named before.
  std::uint32_t add_brick(const Coord& voxel);
  /// A brick with the same value everywhere.
  void set_constant_brick(const Coord& voxel, Voxel value);
  /// A whole block of 64³ voxels with the same value everywhere; nothing else may be said about voxels of that block.
  void set_constant_block(const Coord& voxel, Voxel value);

  /// To be called once, after all bricks are known.
  void allocate();
  /// Values of a brick, [x][y][z][channel]; different bricks may be written by different threads.
  float* values(std::uint32_t brick) { return grid_.values_.data() + std::size_t{brick} * 512 * grid_.channels_; }

  SparseGrid finish();

 private:
  std::uint32_t constant_brick(Voxel value);
  std::uint32_t& slot(const Coord& voxel);
  std::size_t block(const Coord& voxel) const;
  SparseGrid grid_;
  std::uint32_t bricks_ = 1;
  std::vector<std::pair<std::uint32_t, Voxel>> constants_;
  std::unordered_map<std::uint64_t, std::uint32_t> constant_bricks_, constant_tables_;
};

/// A grid from a function of the voxel: for tests and for small blocks.
SparseGrid make_sparse_grid(const IndexBox& voxels, bool with_size, const std::function<Voxel(const Coord&)>& value);

}  // namespace arcus::media
