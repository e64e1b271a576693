#pragma once
// Three spectra for the primaries of Rec.709, for pictures whose pixels become light or reflectances: a pixel's spectrum is the sum of the
// three, weighted by its linear R, G and B, so that a picture's colours come back exactly, and what is interpolated between pixels, too.
//
// The three are 0 or more and as smooth as they can be while each has the colour of its primary (I. Mallett and C. Yuksel, "Spectral Primary
// Decomposition for Rendering with sRGB Reflectance", EGSR 2019, there for reflectances under D65). Here: the sum of squared second differences
// over nodes of 5 nm, least under these conditions, found by a primal-dual active set (M. Hintermüller, K. Ito and K. Kunisch, SIAM J. Optim.
// 13(3), 865, 2003).

#include <functional>

#include "phase/base/three_spectra.h"
#include "src/film/colour.h"

namespace arcus::render {

/// For light: by to_rgb, the three have (1, 0, 0), (0, 1, 0) and (0, 0, 1), and their sum has the shape of `white` [any unit, above 0 somewhere]
/// where to_rgb shows that as white, else of `white` times the smoothest factor that makes it so. Throws bad_input for whites that no such three exist for.
ThreeSpectra light_basis(const ToRgb& to_rgb, const std::function<double(double nm)>& white);

/// For reflectances: under equal-energy light, the eye adapted to it; their sum is 1 at every wavelength. Shares from 0 to 1 make reflectances
/// from 0 to 1.
ThreeSpectra reflectance_basis();

}  // namespace arcus::render
