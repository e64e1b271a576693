#pragma once
// Water clouds: cumulus, stratocumulus, stratus. Liquid water grows with height over the base as in a rising parcel of air, at a
// constant number of droplets, so that droplets grow with height from voxel to voxel.

#include <string>

#include "media/grid/new_grid.h"
#include "phase/settings/keys.h"

namespace arcus::media {

struct CloudSettings {
  std::string kind = "cumulus";     ///< cumulus | stratocumulus | stratus: decides what is 0 below
  std::string name = "cloud";       ///< of the species: grids NAME.extinction and NAME.size
  Vec3 centre_m{0, 0, 0};           ///< middle of the domain, on the ground
  std::vector<double> size_m{4000};  ///< of the domain along x and y; one number: both
  double base_m = 800;              ///< height of the condensation level
  double depth_m = 0;               ///< of the deepest cloud; 0: by kind
  double cover = 0;                 ///< share of the domain under cloud; 0: by kind
  double cell_m = 0;                ///< distance between clouds, or cells of a deck; 0: by kind
  double voxel_m = 20;
  double detail = 0;                ///< how deep billows go, in depths of the cloud; 0: by kind
  long long octaves = 5;            ///< each halves the size of the billows
  double liquid_gradient_g_per_m3_km = 2;  ///< adiabatic: 1 in cold air, 2.5 in warm
  double adiabatic_share = 0.8;     ///< of that liquid water in the core, the rest lost by mixing
  double drops_per_cm3 = 100;       ///< 50 over sea, 300 and more over land
  double variance = 0.1;            ///< effective variance of the droplets' sizes at one place
  double smallest_um = 3;           ///< effective radius below which droplets are not followed
  long long seed = 1;
};
void list_keys(Keys& keys, CloudSettings& cloud);

/// The cloud, equal for any number of threads. Throws bad_input where there would be none, or more than 2·10⁹ voxels.
NewSpecies author_cloud(const CloudSettings& settings);

}  // namespace arcus::media
