#pragma once
// Clouds of ice. Generating cells near the top of a layer snow crystals, which the wind's shear draws out into fall streaks until they
// sublimate: cirrus uncinus, mares' tails. A. J. Heymsfield, J. Atmos. Sci. 32, 799 (1975). Where cells are everywhere: a sheet.

#include <string>

#include "media/author/ice_mixture.h"

namespace arcus::media {

struct CirrusSettings {
  std::string kind = "uncinus";      ///< uncinus | fibratus | cirrostratus: decides what is 0 below
  std::string name = "cirrus";       ///< of the species NAME_HABIT: grids NAME_HABIT.extinction and NAME_HABIT.size

  // Where.
  Vec3 centre_m{0, 0, 0};            ///< middle of the domain, on the ground
  std::vector<double> size_m{16000}; ///< of the domain along x and y; one number: both
  double base_m = 7000;              ///< height over the ground at which the longest streaks end
  double top_m = 9000;
  double voxel_m = 50;

  // How much, and how large.
  double ground_temperature_c = 15;
  double lapse_k_per_km = 6.5;       ///< how fast it gets colder with height
  double ice_factor = 1;             ///< ice water content over the mean of such a temperature
  double optical_depth = 0;          ///< vertical, mean over the domain; above 0 it decides how much ice there is
  double length_over_width = 2.5;     ///< maximum dimension of the crystals over the mean width of such a temperature

  // Cells and streaks.
  double cover = 0;                  ///< share of the domain under cells; 0: by kind
  double cell_m = 0;                 ///< distance between cells; 0: by kind
  double cell_depth_m = 0;           ///< of the layer of cells below the top; 0: by kind
  double cell_life_min = 120;        ///< how long a cell snows; 0: for ever
  double shear_m_per_s_km = 2.5;      ///< wind relative to the cells at 1 km below them; grows evenly
  double shear_azimuth_deg = 270;    ///< compass direction to which it draws the streaks
  double shear_turn_deg = 25;        ///< by which it turns clockwise down to the base
  double fall_speed_m_per_s = 0;     ///< 0: that of the crystals
  double fibre_m = 300;              ///< width of the fibres in a streak
  double texture = 1;                ///< strength of fibres and of the cells' billows; 0: smooth
  long long seed = 1;

  IceMixtureSettings crystals;
};
void list_keys(Keys& keys, CirrusSettings& cirrus);

double temperature_c(const CirrusSettings& settings, double height_m);
/// Maximum dimension of the crystals at a height over the ground, before they sublimate.
double crystal_size_um(const CirrusSettings& settings, double height_m);

/// The cloud, equal for any number of threads. Throws bad_input where there would be none, or more than 2·10⁹ voxels.
AuthoredIce author_cirrus(const CirrusSettings& settings);

}  // namespace arcus::media
