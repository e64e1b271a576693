#pragma once
// How much light gets through.

#include "media/medium/medium.h"
#include "media/space/ray.h"
#include "phase/base/random.h"
#include "phase/base/spectrum.h"
#include "phase/base/wavelengths.h"

namespace arcus::media {

/// Unbiased estimate of the transmittance along a ray at each wavelength: residual ratio tracking (Novák, Selle and Jarosz,
/// "Residual Ratio Tracking for Estimating Attenuation in Participating Media", SIGGRAPH Asia 2014). The smallest extinction of every
/// cell dims the ray by an exponential; only what lies above it is tracked. Roulette where little is left. Each value is ≥ 0, its mean is exp(−optical depth); roulette may let single values
/// exceed 1 slightly.
Spectrum ratio_transmittance(const Medium&, const Ray&, const Wavelengths&, Random&);

}  // namespace arcus::media
