#pragma once
// Scattering by one homogeneous sphere: the Lorenz-Mie series (Bohren & Huffman 1983, chapter 4),
// accurate rather than fast. For whole tables see mie_block.h, which is tested against this.

#include <complex>
#include <span>

#include "phase/particle/scattering.h"

namespace arcus::phase {

/// Efficiencies and amplitudes of one sphere.
///
/// size_parameter: x = 2 pi r / wavelength in the surroundings, 1e-20 ... 1e6.
/// relative_index: m = n + ik relative to the surroundings, n > 0, k >= 0 absorbs; any strength of
///   absorption, |m| x up to 1e8.
/// scattering_angles_rad: 0 (straight on) ... pi, in any order, possibly none.
///
/// Accuracy, relative, against arbitrary precision: 1e-8 up to x = 1e3 and 1e-6 up to x = 2e4 for
/// the efficiencies and for the complex amplitudes, also for n < 1, for |m - 1| = 1e-6, and for
/// absorption so weak that extinction - scattering is tiny: scattering and absorption are separate
/// sums of positive terms.
/// Cost: about x (|m| + 1) 0.2 us, ten times that where |m - 1| < 1e-3, and x 2 ns for each angle.
/// Throws bad_input for values outside these ranges.
SphereAmplitudes mie_sphere(double size_parameter, std::complex<double> relative_index,
                            std::span<const double> scattering_angles_rad);

}  // namespace arcus::phase
