#pragma once
// Which ray paths make some place of the sky, and how much of its light each has.

#include <functional>
#include <vector>

#include "phase/population/map_rays.h"
#include "phase/population/tabulate_crystals.h"

namespace arcus::phase {

struct CountedPath {
  FacePath path;  ///< empty: diffracted light that met no face
  double light_m2_per_sr = 0;    ///< mean over the place: differential scattering cross-section of a crystal, by weighted wavelengths
  double relative_error = 0;     ///< standard error over the light
};

/// Paths whose light is seen in that place under the sun, brightest first. weights: of the settings' wavelengths, their sum is 1; the
/// first size node counts. name_of: paths of one name become one. Equal for any number of threads.
std::vector<CountedPath> paths_at(const CrystalTableSettings& settings, double sun_elevation_deg, double sun_angular_radius_deg,
                                  const SkyPlace& place, const std::vector<double>& weights,
                                  const std::function<FacePath(const FacePath&)>& name_of);

}  // namespace arcus::phase
