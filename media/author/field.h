#pragma once
// An array of numbers from elsewhere as a grid: raw floats, or a list of positions and values; or the liquid water of a cloud
// model as a species of droplets.

#include <string>
#include <vector>

#include "media/author/fill.h"
#include "media/author/model_output.h"
#include "media/author/water_field.h"
#include "media/grid/new_grid.h"
#include "phase/settings/keys.h"
#include "phase/species/recipe.h"

namespace arcus::media {

struct FieldSettings {
  std::string file;                      ///< raw numbers, columns of text, NetCDF or an LWC file
  std::string size_file;                 ///< raw numbers only: sizes [µm] in the same order
  std::vector<double> dimensions;        ///< number of voxels along x, y and z; columns with positions need none
  std::string order = "z_fastest";       ///< z_fastest | x_fastest: which index runs first through the file
  std::string format = "auto";           ///< auto (by the ending) | float32 | float64 (raw, little-endian) | columns | netcdf | lwc
  Vec3 first_m{0, 0, 0};                 ///< position of the first voxel's value
  std::vector<double> voxel_m{1, 1, 1};  ///< distance between neighbours; one number: the same along all axes
  double scale = 1;                      ///< multiplies the values
  std::string name = "density";          ///< of the density grid, or of the species where there is a recipe
  double size_um = 10;                   ///< species: of all particles, where no sizes are given
  std::string phase_file;                ///< recipe: makes a species of it, whose values are extinctions in 1/m
  phase::Recipe phase;
  bool has_phase = false;                ///< a recipe is given
  // Liquid water (netcdf, lwc):
  ModelSettings model;
  DropletSettings droplets;
  bool has_size = false, has_voxel = false;  ///< size_um or voxel_m is given

  /// The format, with auto resolved by the ending of the file.
  std::string real_format() const;
  /// The file holds liquid water.
  bool is_water() const { return real_format() == "netcdf" || real_format() == "lwc"; }
};
void list_keys(Keys& keys, FieldSettings& field);

struct AuthoredField {
  std::vector<NewGrid> grids;
  std::vector<std::string> notes;  ///< what a user should be told
  FilledRange range;               ///< of a species with sizes
};

/// Reads the array. Text has either one column of values in the given order with dimensions, or the columns x, y, z (metres),
/// value and, optionally, size (µm), on a lattice with equal steps along each axis, in any order of lines, positions without a
/// line being empty. `folder`: files are relative to it. Throws bad_input: files that cannot be read or are of
/// another length, values that are negative or not finite (with their place), positions on no lattice or given twice, steps that are
/// not equal. Liquid water: see read_model_output, read_lwc_file and species_of_water.
AuthoredField author_field(const FieldSettings& settings, const std::string& folder);

}  // namespace arcus::media
