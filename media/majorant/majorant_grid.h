#pragma once
// Cells that bound extinction from above, and from below: what a ray steps through to find tentative collisions.
//
// Space is cut into equal blocks, in a coordinate system of the grid's own: that of the medium's finest voxel grid,
// however it lies in the world. A block is empty, one cell, or cut into n³ cells, n = 2, 4, 8, ... Which n is chosen block by
// block: small cells bound more tightly, so that fewer tentative collisions are in vain; large cells take fewer steps.

#include <cstdint>
#include <vector>

#include "media/space/affine.h"
#include "media/space/box.h"
#include "media/space/index.h"

namespace arcus::media {

class SparseGrid;

/// Something that scatters, as far as bounds are concerned.
struct MajorantSource {
  const SparseGrid* grid = nullptr;  ///< none: 1 everywhere in `box`
  Box box;                           ///< in index space
  Affine world_from_index;
  float largest_factor = 1;   ///< extinction at any wavelength is at most this times the grid's value
  float smallest_factor = 1;  ///< and at least this
};

/// What it costs to step through a cell and to look at a tentative collision: their ratio decides the cells' sizes.
struct MajorantCosts {
  double cell_ns = 5, collision_ns = 40;
};

class MajorantGrid {
 public:
  explicit MajorantGrid(const std::vector<MajorantSource>& sources, const MajorantCosts& costs = {});

  /// Blocks are cut into at most 2^most_levels cells along an edge.
  static constexpr int most_levels = 6;
  /// One block. n = 2^level cells along each edge.
  struct Block {
    float majorant_per_m = 0;     ///< of the block as a whole; 0: empty
    float minorant_per_m = 0;
    std::uint32_t first_cell = 0; ///< index into cells(), [x][y][z]; without meaning at level 0
    std::uint32_t level = 0;
  };
  struct Cell {
    float majorant_per_m, minorant_per_m;
  };

  /// World to block coordinates: block (i, j, k) fills [i, i+1] × [j, j+1] × [k, k+1].
  const Affine& block_from_world() const { return block_from_world_; }
  /// Number of blocks along each axis; blocks are in the order [x][y][z].
  const Coord& block_count() const { return count_; }
  const std::vector<Block>& blocks() const { return blocks_; }
  const std::vector<Cell>& cells() const { return cells_; }
  const Box& bounds_m() const { return bounds_m_; }

  /// The cell that holds a point; zeros outside.
  Cell at(const Vec3& position_m) const;
  std::size_t memory_bytes() const { return blocks_.size() * sizeof(Block) + cells_.size() * sizeof(Cell); }

 private:
  Affine block_from_world_;
  Coord count_{0, 0, 0};
  Box bounds_m_;
  std::vector<Block> blocks_;
  std::vector<Cell> cells_;
};

}  // namespace arcus::media
