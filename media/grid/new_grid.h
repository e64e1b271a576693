#pragma once
// Grids that are being made, and how they become a file.

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "media/grid/sparse_grid.h"
#include "media/space/affine.h"
#include "media/space/index.h"

namespace arcus::media {

/// 8³ voxels in the order [x][y][z]; `origin` is the first one's place, a multiple of 8 along each axis.
struct NewBrick {
  Coord origin;
  std::array<float, SparseGrid::brick_voxels> values;
};

struct NewGrid {
  std::string name;
  bool is_fog_volume = true;  ///< else of no class, as sizes are
  Affine world_from_index;
  std::vector<NewBrick> bricks;  ///< voxels of value 0 are inactive, and so is everything outside
  std::vector<std::pair<std::string, std::variant<std::int32_t, float, std::string>>> metadata;
};

/// A species as authors make it: extinction at 550 nm [1/m], and size [µm] in the same bricks where it varies.
struct NewSpecies {
  std::string name;
  std::string recipe;    ///< TOML
  std::string phase_id;
  float size_um = 0;     ///< where there are no sizes
  Affine world_from_index;
  std::vector<NewBrick> extinction, size;  ///< size: empty, or one brick for each of extinction's
};

/// The grids of a species with the metadata by which they are recognised.
std::vector<NewGrid> grids_of(NewSpecies species);

/// Writes a .vdb file, whole or not at all. Throws cannot() where it cannot be written.
void save_grids(const std::string& path, const std::vector<NewGrid>& grids);

/// The same data without a file, as the renderer reads them.
SparseGrid sparse_grid_of(const NewSpecies& species);

}  // namespace arcus::media
