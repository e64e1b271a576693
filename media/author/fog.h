#pragma once
// Fog: cloud on the ground. Radiation fog is thickest below a fuzzy top and thins towards its rim; advection fog fills its domain
// evenly, with large droplets.

#include <string>

#include "media/grid/new_grid.h"
#include "phase/settings/keys.h"

namespace arcus::media {

struct FogSettings {
  std::string kind = "radiation";   ///< radiation | advection: decides what is 0 below, and the profile
  std::string name = "fog";         ///< of the species: grids NAME.extinction and NAME.size
  Vec3 centre_m{0, 0, 0};           ///< middle of the domain, on the ground
  std::vector<double> size_m{2000};  ///< of the domain along x and y; one number: both
  double base_m = 0;                ///< height above the ground where it begins
  double top_m = 0;                 ///< mean height of its top; 0: by kind
  double voxel_m = 5;
  double liquid_g_per_m3 = 0;       ///< greatest liquid water of the mean profile; 0: by kind
  double radius_um = 0;             ///< effective radius there; 0: by kind
  double radius_at_base_um = 0;     ///< and at the base; 0: by kind
  double variance = 0.08;           ///< effective variance of the droplets' sizes at one place
  double patchiness = 0.35;         ///< standard deviation of ln LWC from place to place
  double patch_m = 150;             ///< size of the largest patches
  double waves_m = 0;               ///< standard deviation of the top's height; 0: a tenth of the top's height
  long long seed = 1;
};
void list_keys(Keys& keys, FogSettings& fog);

/// The fog, equal for any number of threads. Throws bad_input where there would be none, or more than 2·10⁹ voxels.
NewSpecies author_fog(const FogSettings& settings);

}  // namespace arcus::media
