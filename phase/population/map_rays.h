#pragma once
// Rays of one wavelength through oriented crystals into a map of the sky.

#include <unordered_map>
#include <vector>

#include "phase/crystal/airy_columns.h"
#include "phase/crystal/crystal_shower.h"
#include "phase/crystal/path_filter.h"
#include "phase/population/sky_grid.h"
#include "phase/population/sun_light.h"

namespace arcus::phase {

/// Light that fell into one cell: sum over rays of cross-sections [um2], and of their squares.
struct MapCell {
  float light = 0, squares = 0;
};

/// Means over rays [um2].
struct RayAccount {
  double shadow = 0;    ///< of a crystal
  double straight = 0;  ///< of it: light that goes on as it came
  double absorbed = 0, cut_off = 0;
};

struct MapOptions {
  bool keep_straight = false;    ///< in the map
  bool blur = false;             ///< by the diffraction of every crystal's shadow
  bool diffracted_light = false; ///< in the map: as much again as the shadow
  double size_spread = 0;        ///< standard deviation of ln size; the population's size is the mean
  int events = 10;
  PathFilter paths;              ///< other light is not in the map
};

/// Adds at least that many rays to the cells, row by row from the lowest elevation. Returns their number.
double add_rays(const CrystalPopulation& crystals, const CrystalWave& wave, const MapOptions& options, const SunLight& sun,
                const SkyGrid& grid, double rays, RandomColumns& random, std::vector<MapCell>& cells, RayAccount& account);

/// A round part of the sky.
struct SkyPlace {
  double azimuth_deg = 0;  ///< from the sun's, clockwise
  double elevation_deg = 0, radius_deg = 0.5;
};

/// Light of one path that is seen in some place.
struct PathLight {
  double light_um2 = 0, squares_um4 = 0;  ///< sum over rays of cross-sections, and of their squares
  long long rays = 0;
};
using LightByPath = std::unordered_map<FacePath, PathLight>;

/// Adds what of at least that many rays is seen in a place, by path; diffracted light that has none under the empty one. Returns the
/// number of rays. Sums are of a population's own size, as those of add_rays.
double add_paths(const CrystalPopulation& crystals, const CrystalWave& wave, const MapOptions& options, const SunLight& sun,
                 const SkyPlace& place, double rays, RandomColumns& random, LightByPath& paths);

/// Faces met from inside after which light of that direction has left but for 0.3 % of what does not go straight on; at most 48.
int sufficient_events(const CrystalPopulation& crystals, const CrystalWave& wave, double sine_elevation);

/// What becomes of light whose direction has that sine of elevation.
RayAccount account_of(const CrystalPopulation& crystals, const CrystalWave& wave, const MapOptions& options, double sine_elevation,
                      int rays, RandomColumns& random);

}  // namespace arcus::phase
