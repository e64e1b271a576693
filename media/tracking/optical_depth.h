#pragma once
// Optical depth by quadrature: slow, deterministic, and without majorants. What the estimators are held against.

#include "media/medium/medium.h"
#include "media/space/ray.h"
#include "phase/base/spectrum.h"
#include "phase/base/wavelengths.h"

namespace arcus::media {

/// Optical depth along a ray, exact to rounding: the ray is cut where it crosses planes of voxels, between which the
/// interpolated extinction is a polynomial of third degree at most, and two Gauss points are exact for that. Of oriented or
/// wide-lobed particles it counts what the renderer counts (the species' extinction ratio). The ray may be endless.
Spectrum optical_depth(const Medium& medium, const Ray& ray, const Wavelengths& wavelengths);

/// The same at one wavelength.
double optical_depth(const Medium& medium, const Ray& ray, double wavelength_nm);

}  // namespace arcus::media
