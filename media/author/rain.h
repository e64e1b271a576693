#pragma once
// A shower: a shaft of rain under a cloud base. The rain rate decides everything else: how much light is stopped, and the
// size of the drops, voxel by voxel.

#include <string>

#include "media/grid/new_grid.h"
#include "phase/settings/keys.h"

namespace arcus::media {

struct RainSettings {
  std::string name = "rain";       ///< of the species: grids NAME.extinction and NAME.size

  // Where.
  Vec3 centre_m{0, 0, 0};          ///< middle of the shaft's foot on the ground (at cloud base, without wind)
  double core_radius_m = 700;      ///< full rain rate within, across the wind
  double edge_width_m = 500;       ///< from there it falls smoothly to nothing
  double stretch = 1;              ///< length along the wind over width across it
  double cloud_base_m = 1200;      ///< height above the ground at which rain begins
  double voxel_m = 20;             ///< edge of the voxels

  // How much.
  double rain_mm_per_hour = 8;     ///< in the core at cloud base, before streaks and turbulence
  double virga_m = 2500;           ///< depth below cloud base at which rain of 1 mm/h has evaporated; 0: no evaporation
  double base_fade_m = 150;        ///< the rain sets in over this depth below the base

  // Wind.
  double wind_m_per_s = 6;         ///< at the ground, relative to the cloud; grows evenly with depth below the base
  double wind_azimuth_deg = 90;    ///< compass direction towards which it blows
  double fall_speed_m_per_s = 0;   ///< of the drops; 0: from the rain rate of the core

  // Texture.
  double streak_contrast = 0.6;    ///< strength of fall streaks
  double streak_width_m = 160;     ///< across
  double turbulence = 0.35;        ///< strength of the fluctuations in all directions
  double turbulence_scale_m = 250; ///< size of the largest
  long long octaves = 4;           ///< each halves the size of the fluctuations
  long long seed = 1;

  // Drops.
  std::string drops = "marshall_palmer";  ///< marshall_palmer | narrow
  double radius_um = 350;          ///< narrow: effective radius at the core's rain rate
  double radius_exponent = 0.21;   ///< narrow: effective radius goes with the rain rate to this power
  double variance = 0.02;          ///< narrow: effective variance of the gamma distribution
  double nodes_per_octave = 0;     ///< size nodes of the recipe for each doubling of the radius; 0: 3, narrow: 7
};
void list_keys(Keys& keys, RainSettings& rain);

struct AuthoredRain {
  NewSpecies species;
  double water_kg = 0;
  float largest_extinction_per_m = 0;
  float smallest_radius_um = 0, largest_radius_um = 0;  ///< effective radii
};

/// Makes the shower, on all cores, equal for any number of them. Throws bad_input where the settings ask for more
/// than 2·10⁹ voxels or leave no rain at all.
AuthoredRain author_rain(const RainSettings& settings);

/// How many drops there are, and how large, at a rain rate.
struct RainDrops {
  double extinction_per_m;     ///< at wavelengths far below the drops' size: twice their cross-section
  double effective_radius_um;
};

/// Marshall & Palmer 1948: N(D) = 8000 exp(−ΛD) per m³ and mm, Λ = 4.1 R^−0.21 per mm; extinction π N₀/Λ³, effective
/// radius 1.5/Λ.
RainDrops marshall_palmer_drops(double rain_mm_per_hour);

/// Drops of nearly one size: as many as carry the rain rate at the fall speed of that size, extinction 3 W/(2 ρ r).
RainDrops narrow_drops(double rain_mm_per_hour, double effective_radius_um);

/// Fall speed of a drop in still air [m/s]: 9.65 − 10.3 exp(−0.6 D), D in mm (Atlas, Srivastava & Sekhon, Rev. Geophys. 11, 1,
/// 1973) above D = 0.6 mm; 8000 r [s⁻¹ m] and 1.19·10⁸ r² [m⁻¹ s⁻¹ m²] below 0.6 and 0.08 mm (Rogers & Yau, A Short
/// Course in Cloud Physics, 3rd ed. 1989, ch. 8). radius above 0; constant beyond 3 mm.
double fall_speed_m_per_s(double radius_um);

}  // namespace arcus::media
