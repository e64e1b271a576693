#pragma once
// The radii at which single spheres are computed so that their weighted sums stand for whole populations. All size
// nodes of a table share them; each has its own weights. Spheres have narrow resonances and interfere with themselves,
// so thousands are needed where waves are summed; large drops are computed by a method that is smooth in the radius.

#include <span>
#include <vector>

#include "phase/population/sizes.h"

namespace arcus::phase {

/// Radii and what each counts in each population.
struct RadiusGrid {
  std::vector<double> radius_um;  ///< ascending; may be empty
  /// [size][radius], radius fastest: sum_i weight_i f(r_i) stands for the mean of f over a particle of that size node.
  std::vector<double> weight;
  /// [radius]: distance to the neighbours over the radius; 0 in populations of one radius.
  std::vector<double> relative_step;
};

struct RadiusGrids {
  RadiusGrid wave, large;
};

/// Grids for the populations of all size nodes at one wavelength, which join at a size parameter: waves below, large
/// drops above. `radii`: how many spheres the wave grid has, or in proportion less where no population lies wholly below
/// the border; they lie where any of the populations has its
/// cross-section, in steps that grow with the size parameter at first and then stay even. A hundred-thousandth of the
/// geometric cross-section is left out, and weights are scaled up for it. Populations of one radius each (all or
/// none are) get that radius.
RadiusGrids radius_grids(std::span<const Sizes> sizes, double wavelength_nm, double border_size_parameter,
                         long long radii);

}  // namespace arcus::phase
