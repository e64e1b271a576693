#pragma once
// Scattering angles at which tables of crystals hold their values.

#include <vector>

#include "phase/crystal/crystal_population.h"

namespace arcus::phase {

/// Angle of least deviation [degrees] of light that passes through two faces whose normals are `cosine` apart: the inner edge of
/// their halo. Below 0 where no light gets through, or the faces are parallel.
double least_deviation_deg(double cosine_of_normals, double n);

/// Nodes from 0 to 180 [degrees]. Halos begin with a jump at the least deviation of two faces: there nodes lie closely, for all
/// indices between the two given; away from all of them ever wider apart, so that each collects enough rays. lobe_width_deg: full
/// width of a forward lobe that the table keeps, which is resolved, or 0.
std::vector<double> crystal_angles_deg(const CrystalPopulation& crystals, double least_n, double largest_n, double lobe_width_deg);

}  // namespace arcus::phase
