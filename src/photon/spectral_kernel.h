#pragma once
// From the few wavelengths of photons to those of a path: every photon counts at wavelengths near its own.

#include <algorithm>
#include <cmath>

#include "src/photon/photon.h"

namespace arcus::render {

/// Half widths of the triangles by which photons are spread over wavelength [nm]: of photons whose wavelengths parted, and of others, whose
/// share changes slowly with wavelength, as colours of surfaces do. What is spread is the scene's answer alone: the sun's spectrum is taken
/// as it is.
inline constexpr double parted_half_width_nm = 10, smooth_half_width_nm = 40;

/// The triangle around a path's wavelength, cut off where the visible range ends: its integral over the range is 1 everywhere [1/nm].
class SpectralKernel {
 public:
  SpectralKernel(double nm, double half_width_nm) : nm_(nm), per_half_width_(1 / half_width_nm) {
    const auto beyond = [&](double end_nm) {
      const double left = std::max(0.0, 1 - std::fabs(nm - end_nm) * per_half_width_);
      return 0.5 * left * left;
    };
    peak_per_nm_ = per_half_width_ / (1 - beyond(shortest_wavelength_nm) - beyond(longest_wavelength_nm));
  }
  double operator()(double nm) const { return peak_per_nm_ * std::max(0.0, 1 - std::fabs(nm - nm_) * per_half_width_); }

 private:
  double nm_, per_half_width_, peak_per_nm_;
};

/// A path's wavelengths as photons are asked for them.
class SpectralQuery {
 public:
  explicit SpectralQuery(const Wavelengths& wavelengths) : SpectralQuery(wavelengths, parted_half_width_nm) {}
  SpectralQuery(const Wavelengths& wavelengths, double half_width_nm)
      : parted_{SpectralKernel(wavelengths[0], half_width_nm), SpectralKernel(wavelengths[1], half_width_nm),
                SpectralKernel(wavelengths[2], half_width_nm), SpectralKernel(wavelengths[3], half_width_nm)},
        smooth_{SpectralKernel(wavelengths[0], smooth_half_width_nm), SpectralKernel(wavelengths[1], smooth_half_width_nm),
                SpectralKernel(wavelengths[2], smooth_half_width_nm), SpectralKernel(wavelengths[3], smooth_half_width_nm)} {}

  /// An estimate of a photon's share at the path's wavelengths [as Photon::share]. Grey ones, the same at all four, count everywhere.
  Spectrum share(const Photon& photon) const {
    const float least = photon.share.min(), most = photon.share.max();
    if (least > (1 - 1e-5f) * most) return photon.share;
    Spectrum result;
    const SpectralKernel* kernels = photon.is_alone() ? parted_ : smooth_;
    for (int j = 0; j < wavelength_count; ++j) {
      if (!(photon.share[j] > 0)) continue;
      const double nm = photon.wavelengths[j];
      const auto each = photon.share[j] / static_cast<float>(wavelength_count * wavelength_density_per_nm(nm));
      for (int i = 0; i < wavelength_count; ++i) result[i] += each * static_cast<float>(kernels[i](nm));
    }
    return result;
  }

 private:
  SpectralKernel parted_[wavelength_count], smooth_[wavelength_count];
};

}  // namespace arcus::render
