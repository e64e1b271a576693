#pragma once
// What a transparent body does to light on its way through: how it bends, by wavelength, and how much is left.

#include <array>

#include "phase/base/spectrum.h"
#include "phase/base/wavelengths.h"
#include "phase/optics/refractive_index.h"
#include "src/material/smooth_spectrum.h"

namespace arcus::render {

class ClearBody {
 public:
  /// Refractive index relative to the air, with absorption; besides, the colour of a filter: `filter` is what is left of the light
  /// after `filter_m` metres. `enlargement`: the body stands for one that many times smaller, and takes no more light than that. Throws bad_input where the index is not known from 380 to 780 nm.
  ClearBody(const phase::RefractiveIndex& index, const SmoothSpectrum& filter, double filter_m, double enlargement = 1);

  /// True where the index depends on wavelength.
  bool is_dispersive() const { return is_dispersive_; }
  /// Real part of the index at a vacuum wavelength, within the visible range.
  double index(double nm) const { return interpolated(index_, nm); }
  /// Share of the light that is left after a way inside (Beer, Lambert): exp(−a s), a = 4π k / λ and the filter's.
  Spectrum transmittance(double distance_m, const Wavelengths& wavelengths) const;

 private:
  static constexpr int nodes = 401;  // 1 nm apart
  static double interpolated(const std::array<double, nodes>& values, double nm);

  std::array<double, nodes> index_, absorption_per_m_;
  bool is_dispersive_ = false, absorbs_ = false;
};

}  // namespace arcus::render
