#pragma once
// Partial waves of eight spheres at once, and the amplitudes S1 and S2 that they make as Legendre
// series.

#include <complex>
#include <span>

#include "phase/particle/instructions.h"
#include "phase/particle/lanes.h"
#include "phase/particle/scattering.h"

namespace arcus::phase {

/// Terms of the series for one sphere, with 3e-11 left out of any amplitude coefficient.
int mie_block_terms(double size_parameter);

/// Eight spheres of one material.
struct EightSpheres {
  double size_parameter[lanes];
  std::complex<double> relative_index;

  /// The largest mie_block_terms.
  int terms() const;
};

/// Legendre coefficients of S1 and S2: S(theta) = sum over k of coefficient[k] P_k(cos theta).
/// coefficients: [terms + 1][4][lanes], the four being Re S1, Im S1, Re S2, Im S2.
/// efficiencies: [lanes].
/// inverse: 1/n for n = 0 ... terms + 2 (the first is not used).
void legendre_coefficients(const EightSpheres& spheres, std::span<const double> inverse,
                           double* coefficients, SphereEfficiencies* efficiencies,
                           Instructions instructions);

}  // namespace arcus::phase
