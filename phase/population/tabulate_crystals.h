#pragma once
// Tables of crystals, by tracing rays through them.

#include <functional>
#include <vector>

#include "phase/crystal/crystal_beam.h"
#include "phase/crystal/crystal_population.h"
#include "phase/crystal/path_filter.h"
#include "phase/optics/sun_disc.h"
#include "phase/population/map_rays.h"
#include "phase/population/oriented_table.h"
#include "phase/population/scattering_table.h"

namespace arcus::phase {

/// What tables of crystals are made of.
struct CrystalTableSettings {
  CrystalSettings crystals;
  std::vector<double> size_um;      ///< nodes: mean maximum dimension
  double size_spread = 0;           ///< standard deviation of ln size around a node
  std::vector<CrystalWave> waves;   ///< by wavelength node, ascending
  bool diffraction = true;          ///< false: rays only, extinction efficiency 1
  bool remove_forward = true;       ///< light that goes straight on counts as not stopped
  double rays = 4e6;                ///< at each wavelength
  double map_step_deg = 0.1;        ///< oriented
  double map_noise = 0.03;          ///< oriented: relative standard error up to which the map is smoothed
  DiscKind disc = DiscKind::limb_darkened;  ///< oriented: of the light in the map
  PathFilter map_paths;             ///< oriented: other light is not in the map; extinction and albedo are those of all
};

/// Randomly oriented ones: a table by scattering angle. Equal for any number of threads. `progress` gets the share done.
ScatteringTable tabulate_random_crystals(const CrystalTableSettings& settings, const std::function<void(double)>& progress = {});

/// How the rays of a map are handled; faces met are left at their default.
MapOptions map_options_of(const CrystalTableSettings& settings, const CrystalPopulation& crystals);

/// Any orientation under the sun at an elevation; sun_angular_radius_deg may be 0.
OrientedTable tabulate_oriented_crystals(const CrystalTableSettings& settings, double sun_elevation_deg, double sun_angular_radius_deg,
                                         const std::function<void(double)>& progress = {});

}  // namespace arcus::phase
