#pragma once
// Spectra that are sums of three given ones: what linear colours become.

#include <algorithm>
#include <array>
#include <vector>

#include "phase/base/spectrum.h"
#include "phase/base/wavelengths.h"

namespace arcus {

class ThreeSpectra {
 public:
  static constexpr std::size_t cells = 400;  ///< of 1 nm over what a picture integrates
  static_assert(longest_wavelength_nm - shortest_wavelength_nm == cells);

  ThreeSpectra() : rows_(cells + 1) {}
  /// [spectrum][nm above the shortest wavelength]; linear between.
  explicit ThreeSpectra(const std::array<std::vector<double>, 3>& values) : rows_(cells + 1) {
    for (std::size_t k = 0; k <= cells; ++k)
      rows_[k] = Spectrum(static_cast<float>(values[0][k]), static_cast<float>(values[1][k]), static_cast<float>(values[2][k]), 0);
  }

  /// The three values at a vacuum wavelength [nm].
  Spectrum at(double nm) const {
    const double place = std::clamp(nm - shortest_wavelength_nm, 0.0, static_cast<double>(cells));
    const std::size_t k = std::min(static_cast<std::size_t>(place), cells - 1);
    return rows_[k] + (rows_[k + 1] - rows_[k]) * static_cast<float>(place - static_cast<double>(k));
  }
  /// The sum with these shares at a vacuum wavelength [nm].
  float sum(const float* shares, double nm) const {
    const Spectrum three = at(nm);
    return three[0] * shares[0] + three[1] * shares[1] + three[2] * shares[2];
  }
  Spectrum sum(const float* shares, const Wavelengths& wavelengths) const {
    Spectrum result;
    for (int i = 0; i < wavelength_count; ++i) result[i] = sum(shares, static_cast<double>(wavelengths[i]));
    return result;
  }

 private:
  std::vector<Spectrum> rows_;
};

}  // namespace arcus
