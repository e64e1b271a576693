#pragma once
// How much light gets through.

#include "media/medium/medium.h"
#include "media/space/ray.h"
#include "phase/base/random.h"
#include "phase/base/spectrum.h"
#include "phase/base/wavelengths.h"

namespace arcus::media {

/// Unbiased estimate of the transmittance along a ray at each wavelength: ratio tracking (Novák et al. 2014), with
/// roulette where little is left. Each value is ≥ 0, its mean is exp(−optical depth); roulette may let single values
/// exceed 1 slightly.
Spectrum ratio_transmittance(const Medium&, const Ray&, const Wavelengths&, Random&);

}  // namespace arcus::media
