#pragma once
// Reflectances and transmittances between 0 and 1 that vary smoothly with wavelength: a sigmoid of a parabola (W. Jakob and J. Hanika, "A
// Low-Dimensional Function Space for Efficient Spectral Upsampling", Computer Graphics Forum 38(2), 2019). What a colour in the
// scene file becomes.

#include <array>
#include <cmath>

#include "phase/base/spectrum.h"
#include "phase/base/wavelengths.h"

namespace arcus::render {

/// f(λ) = S(c0 t² + c1 t + c2), t = (λ − 380 nm)/400 nm, S(x) = 1/2 + x / (2 √(1 + x²)). Constant ones are exact, 0 and 1 included.
class SmoothSpectrum {
 public:
  /// The same at every wavelength, 0 to 1.
  SmoothSpectrum(double constant = 0) : is_constant_(true), constant_(static_cast<float>(constant)) {}
  explicit SmoothSpectrum(const std::array<double, 3>& c) : c_(c) {}

  bool is_constant() const { return is_constant_; }
  /// At a vacuum wavelength [nm]; 0 to 1.
  double at(double nm) const {
    if (is_constant_) return constant_;
    const double t = (nm - shortest_wavelength_nm) / (longest_wavelength_nm - shortest_wavelength_nm);
    const double x = (c_[0] * t + c_[1]) * t + c_[2];
    return 0.5 + 0.5 * x / std::sqrt(1 + x * x);
  }
  Spectrum at(const Wavelengths& wavelengths) const {
    if (is_constant_) return Spectrum::filled(constant_);
    Spectrum result;
    for (int i = 0; i < wavelength_count; ++i) result[i] = static_cast<float>(at(wavelengths[i]));
    return result;
  }

 private:
  bool is_constant_ = false;
  float constant_ = 0;
  std::array<double, 3> c_{};
};

}  // namespace arcus::render
