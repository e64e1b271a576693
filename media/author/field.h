#pragma once
// An array of numbers from elsewhere as a grid: raw floats, or a list of positions and values.

#include <string>
#include <vector>

#include "media/grid/new_grid.h"
#include "phase/settings/keys.h"
#include "phase/species/recipe.h"

namespace arcus::media {

struct FieldSettings {
  std::string file;                      ///< raw numbers, or columns of text (.csv, .txt)
  std::string size_file;                 ///< raw numbers only: sizes [µm] in the same order
  std::vector<double> dimensions;        ///< number of voxels along x, y and z; columns with positions need none
  std::string order = "z_fastest";       ///< z_fastest | x_fastest: which index runs first through the file
  std::string format = "float32";        ///< of raw numbers: float32 | float64, little-endian
  Vec3 first_m{0, 0, 0};                 ///< position of the first voxel's value
  std::vector<double> voxel_m{1, 1, 1};  ///< distance between neighbours; one number: the same along all axes
  double scale = 1;                      ///< multiplies the values
  std::string name = "density";          ///< of the density grid, or of the species where there is a recipe
  double size_um = 10;                   ///< species: of all particles, where no sizes are given
  std::string phase_file;                ///< recipe: makes a species of it, whose values are extinctions in 1/m
  phase::Recipe phase;
  bool has_phase = false;                ///< a recipe is given
};
void list_keys(Keys& keys, FieldSettings& field);

/// Reads the array. Text has either one column of values in the given order with dimensions, or the columns x, y, z (metres),
/// value and, optionally, size (µm), on a lattice with equal steps along each axis, in any order of lines, positions without a
/// line being empty. `folder`: files are relative to it. Throws bad_input: files that cannot be read or are of
/// another length, values that are negative or not finite (with their place), positions on no lattice or given twice, steps that are
/// not equal.
std::vector<NewGrid> author_field(const FieldSettings& settings, const std::string& folder);

}  // namespace arcus::media
