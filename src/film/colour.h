#pragma once
// From spectra to colours: CIE 1931 XYZ of the 2 degree observer, white points, and linear Rec.709.
//
// XYZ here is scaled so that Y is the mean of the spectral radiance weighted with ybar over 380 to
// 780 nm (vacuum), in the unit of the radiance: equal-energy light of radiance L has Y = L. The
// colour matching functions are tabulated against wavelength in standard air; they are looked up at
// lambda / n_air(lambda).

#include <array>
#include <functional>
#include <string>

#include "phase/base/spectrum.h"
#include "phase/base/wavelengths.h"

namespace arcus::render {

struct Xyz {
  double x = 0, y = 0, z = 0;
  Xyz& operator+=(const Xyz& o) {
    x += o.x, y += o.y, z += o.z;
    return *this;
  }
  friend Xyz operator*(const Xyz& a, double s) { return {a.x * s, a.y * s, a.z * s}; }
};

struct Rgb {
  double r = 0, g = 0, b = 0;
};

/// Estimate of XYZ from the radiances at wavelengths drawn by draw_wavelengths: the mean over the
/// four of radiance x matching function / density. Unbiased: its expectation is xyz_of(the
/// spectrum). Costs a few nanoseconds: matching function over density is tabulated at 1 nm and
/// interpolated linearly.
Xyz xyz_of_sample(const Spectrum& radiance, const Wavelengths& wavelengths);

/// XYZ of a spectrum given at vacuum wavelengths [nm], by quadrature over 380 to 780 nm with
/// exactly the matching functions that xyz_of_sample has. The spectrum is asked at 4 points a
/// nanometre.
Xyz xyz_of(const std::function<double(double nm)>& spectrum);

/// XYZ to linear Rec.709.
struct ToRgb {
  std::array<std::array<double, 3>, 3> matrix;
  Rgb operator()(const Xyz& c) const {
    const auto row = [&](std::size_t i) {
      return matrix[i][0] * c.x + matrix[i][1] * c.y + matrix[i][2] * c.z;
    };
    return {row(0), row(1), row(2)};
  }
};

/// Light of the chromaticity of `white` becomes R = G = B = Y: Bradford adaptation from `white` to
/// D65, then the inverse of Rec.709's primaries. Throws bad_input where `white` is no colour that
/// an eye can adapt to (a cone response that is not positive).
ToRgb to_rgb_from_white(const Xyz& white);

/// Equal-energy light of radiance 1.
Xyz equal_energy_white();
/// CIE D65, the white of Rec.709 itself: chromaticity (0.3127, 0.3290), Y = 1.
Xyz d65_white();
/// Planck radiator of a temperature in K, Y = 1.
Xyz planck_white(double temperature_k);

/// White for a setting `film.white`: auto | D65 | equal_energy, or a temperature in K (of a Planck
/// radiator). `sun` is XYZ of the sun's spectrum; where it is black, auto means equal_energy.
/// Throws bad_input for another word or a temperature outside 1000 to 100000 K.
Xyz white_of(const std::string& setting, const Xyz& sun);

}  // namespace arcus::render
