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

/// Optical depth along a ray by quadrature, exact to rounding: the ray is cut where it crosses planes of voxels, between
/// which the interpolated extinction is a cubic polynomial at most. Slow, deterministic, and independent of majorants.
double optical_depth(const Medium&, const Ray&, double wavelength_nm);

}  // namespace arcus::media
