#pragma once
// A shower: a shaft of rain under a cloud base, slanted by the wind, streaked and turbulent, with drops whose size goes
// with the rain rate from voxel to voxel.

#include <string>

#include "media/grid/new_grid.h"
#include "phase/settings/keys.h"

namespace arcus::media {

struct RainSettings {
  std::string species = "rain";
  double rain_mm_per_hour = 20;        ///< in the core, under the cloud
  Vec3 centre_m{0, 2000, 0};           ///< of the shaft at the ground; z is the ground
  double width_m = 5000;               ///< of the shaft, west to east
  double depth_m = 1200;               ///< of the shaft, south to north
  double edge = 0.3;                   ///< share of the half widths over which the rain fades out
  double cloud_base_m = 1500;          ///< above the ground: where the rain begins
  double voxel_m = 20;
  double wind_m_per_s = 6;             ///< at the cloud base, none at the ground: streaks bend
  double wind_azimuth_deg = 90;        ///< where the wind blows to
  double evaporation_per_km = 0.3;     ///< virga: the rain rate falls by this factor e^(−...) a kilometre below the base
  double streaks = 0.6;                ///< strength of fall streaks; 0: none
  double streak_size_m = 300;
  double turbulence = 0.3;             ///< strength of the turbulent density; 0: none
  double turbulence_size_m = 150;
  std::string drops = "marshall_palmer";  ///< marshall_palmer | gamma
  double effective_radius_um = 300;    ///< gamma: of the drops in the core; goes with the rain rate to the power 0.21
  double variance = 0.05;              ///< gamma: effective variance
  long long seed = 1;
};
void list_keys(Keys& keys, RainSettings& rain);

struct AuthoredRain {
  NewSpecies species;
  double water_kg = 0;                     ///< in the air
  double largest_extinction_per_m = 0;     ///< at 550 nm, diffraction included
  double smallest_radius_um = 0, largest_radius_um = 0;
};

/// Makes the shower, on all cores. Rain of Marshall and Palmer (1948): N(D) = N0 exp(−Λ D), N0 = 8000 m⁻³ mm⁻¹,
/// Λ = 4.1 R^−0.21 mm⁻¹; water π ρ N0/Λ⁴, extinction 3 W/(2 ρ r_eff) (efficiency 2), r_eff = 1.5/Λ. Narrower drops
/// (gamma) hold as much water as those at the same rain rate.
/// Throws bad_input where the shaft has no voxel with rain or more than 2·10⁹ voxels.
AuthoredRain author_rain(const RainSettings& settings);

}  // namespace arcus::media
