#pragma once
// The scattering matrix of one recipe at one size and wavelength, computed directly: no clipped lobe, no sun's disc, and but
// for crystals no table and no nodes. What `arcus phase eval` prints, and what tables are held against.

#include <span>
#include <vector>

#include "phase/species/recipe.h"

namespace arcus::phase {

/// [angle], 1/sr, all in the normalisation in which the integral of p11 over the sphere is 1.
struct MatrixRow {
  std::vector<double> p11, p12, p33, p34;
  double extinction_m2 = 0, scattering_m2 = 0;  ///< mean cross-sections of a particle; 0 for functions in closed form
  double asymmetry = 0;                         ///< mean cosine
  double forward_fraction = 0;  ///< share of the extinction that goes straight on and is in no element; crystals only
};

/// recipe: not of type table. size_um: effective radius of the population, mean maximum dimension of crystals, which must lie at
/// random: they are traced, which takes seconds, and their p33 and p34 are unknown and 0; ignored by functions in closed form, whose
/// polarisation is known for rayleigh alone (p12 = p34 = 0, p33 = p11 for hg and isotropic). Angles in any order,
/// 0 to 180. Throws bad_input for values outside of these.
MatrixRow evaluate_recipe(const Recipe& recipe, double size_um, double wavelength_nm, std::span<const double> angle_deg);

}  // namespace arcus::phase
