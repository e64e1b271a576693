#pragma once
// Tables of populations of spheres: angle nodes from pilot wavelengths, means at every wavelength, normalisation, and
// how much of the light the forward lobe of large drops takes away.

#include <complex>
#include <functional>
#include <vector>

#include "phase/population/progress.h"
#include "phase/population/scattering_table.h"
#include "phase/population/sizes.h"

namespace arcus::phase {

struct Population {
  std::vector<double> size_um;                  ///< size nodes, ascending
  SizesSettings distribution;                   ///< of the radii around each
  std::vector<double> wavelength_nm;            ///< ascending
  std::vector<std::complex<double>> index;      ///< [wavelength] n + ik, relative to air
  std::function<std::complex<double>(double wavelength_nm)> index_at;  ///< the same between the nodes
  long long radii = 10000;                      ///< see radius_grids
  bool remove_forward_lobe = true;              ///< of drops from least_lobeless_um on
};

/// From this effective radius on the forward lobe is narrower than the sun: 40 % of it is within 0.267 degrees.
inline constexpr double least_lobeless_um = 50;
/// Where the lobe is clipped [degrees]: just outside of the sun's disc, so that aureoles outside of it remain.
inline constexpr double lobe_angle_deg = 0.5;

/// The table by wave optics. Relative error of p11 between its angle nodes below 0.2 %, see angle_error of the table.
/// Runs on all cores; the result does not depend on their number. Throws bad_input for what the solvers do not take.
ScatteringTable tabulate(const Population& population, const Progress& progress = {});

/// The table by geometric optics: rays only, extinction efficiency 1, no diffraction and no interference; drops of the
/// effective radius stand for their population (without absorption all are alike). Needs n above 1.
ScatteringTable tabulate_rays(const Population& population);

}  // namespace arcus::phase
