#pragma once
// Liquid water on the lattice of a cloud model, and the droplets that it becomes.

#include <string>
#include <vector>

#include "media/grid/new_grid.h"
#include "phase/settings/keys.h"

namespace arcus::media {

/// Liquid water in the cells of a model: even steps along x and y, layers of any thickness.
struct WaterField {
  std::string where;  ///< names the source in messages
  Coord count;
  double first_x_m = 0, first_y_m = 0, step_x_m = 1, step_y_m = 1;  ///< middles of the cells
  std::vector<double> level_m;  ///< bounds of the layers, ascending: count.z + 1
  std::vector<float> water_g_per_m3;  ///< [x][y][z], z fastest
  std::vector<float> radius_um;       ///< effective radii, where given; else
  std::vector<float> drops_per_cm3;   ///< numbers, where given; both empty: settings say

  std::size_t place(const Coord& c) const {
    return (static_cast<std::size_t>(c.x) * static_cast<std::size_t>(count.y) + static_cast<std::size_t>(c.y)) *
               static_cast<std::size_t>(count.z) +
           static_cast<std::size_t>(c.z);
  }
};

/// How water becomes droplets.
struct DropletSettings {
  double drops_per_cm3 = 0;           ///< everywhere; 0: not given
  double size_um = 10;                ///< effective radius everywhere, where nothing else is given; no key of its own
  double variance = 0.1;              ///< effective variance of the droplets' sizes at one place
  double smallest_um = 2, largest_um = 50;  ///< effective radii outside count as these
  double least_water_g_per_m3 = 1e-4; ///< less counts as none
  double layer_m = 0;                 ///< height of the voxels; 0: of the thinnest layer
};
void list_keys(Keys& keys, DropletSettings& droplets);

/// Bounds of layers half-way between the levels; the outer ones as far outside as the next ones inside. A single level gets
/// `alone_m`. Levels ascending.
std::vector<double> bounds_between(const std::vector<double>& level_m, double alone_m);

struct WaterSpecies {
  NewSpecies species;  ///< without a name
  std::vector<std::string> notes;  ///< what a user should be told
};

/// Layers of one thickness become voxels as they are. Others are cut into even ones so that the water and the optical depth of
/// every column stay what they were: a voxel has the mean of LWC and of LWC/r_e over the layers that it overlaps, and the size
/// that is their ratio. Throws bad_input: water that is negative or not finite (with its place; what is negative by less than 10⁻⁶ of
/// the largest counts as 0), radii or numbers that are not above 0 where there is water, no water at all.
WaterSpecies species_of_water(const WaterField& field, const DropletSettings& settings);

}  // namespace arcus::media
