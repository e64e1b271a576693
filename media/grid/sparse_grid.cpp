#include "media/grid/sparse_grid.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <string>

#include "phase/base/error.h"

namespace arcus::media {
namespace {

// 2²⁴ root entries are 64 MiB.
constexpr std::int64_t most_blocks = std::int64_t{1} << 24;

int block_of(int voxel) { return voxel >> 6; }

/// Calls visit(x, y, z) for every brick of a box of voxels.
template <class Visit>
void visit_bricks(const IndexBox& box, const Visit& visit) {
  for (int x = box.low.x >> 3; x <= box.high.x >> 3; ++x)
    for (int y = box.low.y >> 3; y <= box.high.y >> 3; ++y)
      for (int z = box.low.z >> 3; z <= box.high.z >> 3; ++z)
        visit(x, y, z);
}

IndexBox intersection(const IndexBox& a, const IndexBox& b) {
  return {{std::max(a.low.x, b.low.x), std::max(a.low.y, b.low.y), std::max(a.low.z, b.low.z)},
          {std::min(a.high.x, b.high.x), std::min(a.high.y, b.high.y), std::min(a.high.z, b.high.z)}};
}

}  // namespace

std::uint32_t SparseGrid::brick_at(int bx, int by, int bz) const {
  const auto dx = static_cast<unsigned>(bx * 8) - origin_x_, dy = static_cast<unsigned>(by * 8) - origin_y_,
             dz = static_cast<unsigned>(bz * 8) - origin_z_;
  if ((dx >> 6) >= blocks_x_ || (dy >> 6) >= blocks_y_ || (dz >> 6) >= blocks_z_) return 0;
  const std::size_t block = (std::size_t{dx >> 6} * blocks_y_ + (dy >> 6)) * blocks_z_ + (dz >> 6);
  return tables_[std::size_t{root_[block]} * 512 + ((dx >> 3 & 7) << 6 | (dy >> 3 & 7) << 3 | (dz >> 3 & 7))];
}

SparseGrid::Range SparseGrid::range(const IndexBox& box, bool exact) const {
  const IndexBox inside = intersection(box, voxels_);
  if (inside.is_empty()) return {0, 0};
  Range range{inside == box ? largest_ : 0, 0};
  visit_bricks(inside, [&](int bx, int by, int bz) {
    const Range brick = brick_ranges_[brick_at(bx, by, bz)];
    if (brick.largest <= range.largest && brick.smallest >= range.smallest) return;
    if (!exact || brick.largest == brick.smallest) {
      range = {std::min(range.smallest, brick.smallest), std::max(range.largest, brick.largest)};
      return;
    }
    const IndexBox part = intersection(inside, {{bx * 8, by * 8, bz * 8}, {bx * 8 + 7, by * 8 + 7, bz * 8 + 7}});
    for (int x = part.low.x; x <= part.high.x; ++x)
      for (int y = part.low.y; y <= part.high.y; ++y) {
        const float* value = address(x, y, part.low.z);
        for (int z = part.low.z; z <= part.high.z; ++z, value += channels_) {
          range.smallest = std::min(range.smallest, *value);
          range.largest = std::max(range.largest, *value);
        }
      }
  });
  return range;
}

SparseGrid::Range SparseGrid::size_range() const {
  Range range{0, 0};
  if (!has_size()) return range;
  for (std::size_t i = 0; i < values_.size(); i += 2) {
    const float extinction = values_[i], size = values_[i + 1];
    if (!(extinction > 0)) continue;
    range.smallest = range.largest == 0 ? size : std::min(range.smallest, size);
    range.largest = std::max(range.largest, size);
  }
  return range;
}

std::size_t SparseGrid::memory_bytes() const {
  return values_.bytes() + (root_.size() + tables_.size()) * 4 + brick_ranges_.size() * sizeof(Range);
}

SparseGridBuilder::SparseGridBuilder(const IndexBox& voxels, bool with_size, const std::string& where) {
  grid_.voxels_ = voxels;
  grid_.channels_ = with_size ? 2 : 1;
  grid_.tables_.assign(512, 0);
  if (voxels.is_empty()) return;
  const std::int64_t nx = block_of(voxels.high.x) - block_of(voxels.low.x) + 1,
                     ny = block_of(voxels.high.y) - block_of(voxels.low.y) + 1,
                     nz = block_of(voxels.high.z) - block_of(voxels.low.z) + 1;
  // Each factor is below 2²⁷; two of them cannot overflow, and the third is only multiplied when they are small.
  if (nx * ny > most_blocks || nx * ny * nz > most_blocks)
    throw bad_input(where,
                    "a box of " + std::to_string(voxels.size(0)) + " x " + std::to_string(voxels.size(1)) + " x " +
                        std::to_string(voxels.size(2)) + " voxels",
                    "it may span at most 2^24 blocks of 64 x 64 x 64 voxels",
                    "Crop it, or cut it into several files, each a [[medium]] of its own");
  grid_.origin_x_ = static_cast<unsigned>(block_of(voxels.low.x) * 64);
  grid_.origin_y_ = static_cast<unsigned>(block_of(voxels.low.y) * 64);
  grid_.origin_z_ = static_cast<unsigned>(block_of(voxels.low.z) * 64);
  grid_.blocks_x_ = static_cast<unsigned>(nx);
  grid_.blocks_y_ = static_cast<unsigned>(ny);
  grid_.blocks_z_ = static_cast<unsigned>(nz);
  grid_.root_.assign(static_cast<std::size_t>(nx * ny * nz), 0);
}

std::size_t SparseGridBuilder::block(const Coord& voxel) const {
  const auto dx = static_cast<unsigned>(voxel.x) - grid_.origin_x_, dy = static_cast<unsigned>(voxel.y) - grid_.origin_y_,
             dz = static_cast<unsigned>(voxel.z) - grid_.origin_z_;
  assert((dx >> 6) < grid_.blocks_x_ && (dy >> 6) < grid_.blocks_y_ && (dz >> 6) < grid_.blocks_z_);
  return (std::size_t{dx >> 6} * grid_.blocks_y_ + (dy >> 6)) * grid_.blocks_z_ + (dz >> 6);
}

std::uint32_t& SparseGridBuilder::slot(const Coord& voxel) {
  std::uint32_t& table = grid_.root_[block(voxel)];
  if (table == 0) {
    table = static_cast<std::uint32_t>(grid_.tables_.size() / 512);
    grid_.tables_.resize(grid_.tables_.size() + 512, 0);
  }
  return grid_.tables_[std::size_t{table} * 512 +
                       static_cast<std::size_t>((voxel.x >> 3 & 7) << 6 | (voxel.y >> 3 & 7) << 3 | (voxel.z >> 3 & 7))];
}

std::uint32_t SparseGridBuilder::add_brick(const Coord& voxel) {
  std::uint32_t& brick = slot(voxel);
  assert(brick == 0);
  return brick = bricks_++;
}

std::uint32_t SparseGridBuilder::constant_brick(Voxel value) {
  if (value.extinction == 0) return 0;
  if (grid_.channels_ == 1) value.size_um = 0;
  const std::uint64_t key =
      std::uint64_t{std::bit_cast<std::uint32_t>(value.extinction)} << 32 | std::bit_cast<std::uint32_t>(value.size_um);
  const auto [entry, is_new] = constant_bricks_.try_emplace(key, bricks_);
  if (is_new) constants_.emplace_back(bricks_++, value);
  return entry->second;
}

void SparseGridBuilder::set_constant_brick(const Coord& voxel, Voxel value) {
  if (const std::uint32_t brick = constant_brick(value)) slot(voxel) = brick;
}

void SparseGridBuilder::set_constant_block(const Coord& voxel, Voxel value) {
  const std::uint32_t brick = constant_brick(value);
  if (brick == 0) return;
  const auto [entry, is_new] =
      constant_tables_.try_emplace(brick, static_cast<std::uint32_t>(grid_.tables_.size() / 512));
  if (is_new) grid_.tables_.resize(grid_.tables_.size() + 512, brick);
  grid_.root_[block(voxel)] = entry->second;
}

void SparseGridBuilder::allocate() {
  grid_.values_ = LargeArray<float>(std::size_t{bricks_} * 512 * grid_.channels_);
  for (const auto& [brick, value] : constants_) {
    float* out = values(brick);
    for (int i = 0; i < SparseGrid::brick_voxels; ++i) {
      *out++ = value.extinction;
      if (grid_.channels_ == 2) *out++ = value.size_um;
    }
  }
}

SparseGrid SparseGridBuilder::finish() {
  grid_.brick_ranges_.resize(bricks_);
  tbb::parallel_for(std::uint32_t{0}, bricks_, [&](std::uint32_t brick) {
    const float* in = values(brick);
    float largest = 0, smallest = in[0];
    for (int i = 0; i < SparseGrid::brick_voxels; ++i, in += grid_.channels_) {
      largest = std::max(largest, *in);
      smallest = std::min(smallest, *in);
    }
    grid_.brick_ranges_[brick] = {smallest, largest};
  });
  for (const SparseGrid::Range& range : grid_.brick_ranges_) grid_.largest_ = std::max(grid_.largest_, range.largest);
  return std::move(grid_);
}

SparseGrid make_sparse_grid(const IndexBox& voxels, bool with_size, const std::function<Voxel(const Coord&)>& value) {
  SparseGridBuilder builder(voxels, with_size, "grid");
  std::vector<std::pair<std::uint32_t, Coord>> bricks;
  visit_bricks(voxels, [&](int bx, int by, int bz) {
    const Coord first{bx * 8, by * 8, bz * 8};
    bricks.emplace_back(builder.add_brick(first), first);
  });
  builder.allocate();
  for (const auto& [brick, first] : bricks) {
    float* out = builder.values(brick);
    for (int i = 0; i < SparseGrid::brick_voxels; ++i) {
      const Coord c{first.x + (i >> 6), first.y + (i >> 3 & 7), first.z + (i & 7)};
      const Voxel v = voxels.contains(c) ? value(c) : Voxel{};
      *out++ = v.extinction;
      if (with_size) *out++ = v.size_um;
    }
  }
  return builder.finish();
}

}  // namespace arcus::media
