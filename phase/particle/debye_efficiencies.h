#pragma once
// Efficiencies of a large sphere from its partial waves near the edge and its rays inside of it.

#include <complex>

#include "phase/particle/partial_waves.h"
#include "phase/particle/scattering.h"

namespace arcus::phase {

/// forward_amplitude: S(0) of order 0, diffraction and reflection, which decides extinction (the
/// other orders average out over sizes). waves: of the edge, from their first one up; below it
/// rays. Backscatter is left 0. Error of the asymmetry about 1e-4 at x = 1000.
SphereEfficiencies debye_efficiencies(double size_parameter, std::complex<double> relative_index,
                                      double forward_amplitude, const PartialWaves& waves);

}  // namespace arcus::phase
