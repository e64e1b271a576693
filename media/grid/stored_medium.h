#pragma once
// What a .vdb file offers to a renderer: species that carry the recipe of their phase functions, or plain density grids
// of other programs.

#include <memory>
#include <string>
#include <vector>

#include "media/grid/sparse_grid.h"
#include "media/space/affine.h"

namespace arcus::media {

struct StoredMedium {
  std::string name;  ///< the species, or the density grid's name
  std::shared_ptr<const SparseGrid> grid;
  Affine world_from_index;  ///< index coordinates to metres, as the file says
  /// A species with a recipe; otherwise values are densities, which mean whatever their author chose.
  bool is_species = false;
  std::string recipe;    ///< TOML of the phase functions; species only
  std::string phase_id;  ///< what the recipe's tables were called when the file was made; may be empty
  float size_um = 0;     ///< of all particles, where the grid has no sizes; 0: not given
  /// Of all voxels that scatter; 0 where nothing is known about sizes.
  float smallest_size_um = 0, largest_size_um = 0;
};

struct StoredMedia {
  std::vector<StoredMedium> media;
  /// What a user should be told: a grid chosen by default, doubles read as floats, ...
  std::vector<std::string> notes;
};

/// Reads from a .vdb file. `choice`: a species S, a grid's name, or name[index] where the name is not unique. Empty: all
/// species; without species the grid "density", or the only float fog volume.
///
/// Only active voxels count; values between them are interpolated towards 0 outside. Throws bad_input, naming the file and the
/// grid and what would do instead: no such grid, an ambiguous name, another type than float or double, a level
/// set, a frustum or flat transform, a background that is not 0, no active voxels, a value that is NaN, infinite or negative
/// (with the first voxel that has one), sizes missing where something scatters, a format version that is not known, and everything
/// that VdbReader refuses.
StoredMedia read_media(const std::string& path, const std::string& choice);

}  // namespace arcus::media
