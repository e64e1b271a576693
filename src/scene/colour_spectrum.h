#pragma once
// From the colours of a scene file to spectra.

#include <vector>

#include "src/material/smooth_spectrum.h"

namespace arcus::render {

/// A smooth reflectance or transmittance for one number (the same at every wavelength) or linear Rec.709 R, G, B, each 0 to 1: that
/// under equal-energy light, seen by an eye adapted to it, it has that colour, to 1e-4 where a smooth spectrum can, else as near as one comes.
/// W. Jakob and J. Hanika (2019), as cited in src/material/smooth_spectrum.h; the coefficients are found by damped Gauss-Newton steps.
SmoothSpectrum spectrum_of_colour(const std::vector<double>& colour);

}  // namespace arcus::render
