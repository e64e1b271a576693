#pragma once
// The four vacuum wavelengths that one path carries, and how they are drawn: one number places all four, a quarter
// of the cumulative density apart, so that each path sees the whole visible range (Wilkie et al., "Hero Wavelength
// Spectral Sampling", EGSR 2014).

#include <array>
#include <cmath>

#include "phase/base/spectrum.h"

namespace arcus {

/// What a picture integrates over [nm, vacuum].
inline constexpr double shortest_wavelength_nm = 380, longest_wavelength_nm = 780;

/// Wavelengths [nm]; the first leads the path (it decides where the path goes), the others follow.
struct Wavelengths {
  std::array<float, wavelength_count> nm{};
  float operator[](int i) const { return nm[static_cast<std::size_t>(i)]; }
};

namespace wavelength_density {
// sech² around 538 nm follows the sum of the colour matching functions (Radziszewski et al., "An Improved
// Technique for Full Spectral Rendering", WSCG 2009); the width is theirs, the range is ours.
inline constexpr double centre_nm = 538, steepness_per_nm = 0.0072;
inline double cumulative(double nm) { return std::tanh(steepness_per_nm * (nm - centre_nm)); }
}  // namespace wavelength_density

/// Probability density of every one of the four wavelengths [1/nm]; integrates to 1 over the range above.
inline double wavelength_density_per_nm(double nm) {
  const double t = wavelength_density::cumulative(nm);
  static const double whole = wavelength_density::cumulative(longest_wavelength_nm) -
                              wavelength_density::cumulative(shortest_wavelength_nm);
  return wavelength_density::steepness_per_nm * (1 - t * t) / whole;
}

/// The four wavelengths for u in [0, 1): the hero at the cumulative share u, the others a quarter further each.
inline Wavelengths draw_wavelengths(double u) {
  static const double low = wavelength_density::cumulative(shortest_wavelength_nm);
  static const double high = wavelength_density::cumulative(longest_wavelength_nm);
  Wavelengths result;
  for (int i = 0; i < wavelength_count; ++i) {
    double share = u + i / static_cast<double>(wavelength_count);
    if (share >= 1) share -= 1;
    const double t = low + (high - low) * share;
    result.nm[static_cast<std::size_t>(i)] = static_cast<float>(
        wavelength_density::centre_nm + std::atanh(t) / wavelength_density::steepness_per_nm);
  }
  return result;
}

}  // namespace arcus
