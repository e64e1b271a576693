#pragma once
// The wavelengths at which the renderer's tables hold their values: nodes uniform in 1/wavelength². Dispersion moves
// the bows of drops by equal steps on it, nearly: 0.1° per 10 nm in the violet, 0.03° in the red.

#include <cmath>
#include <cstring>

#include "phase/base/spectrum.h"
#include "phase/base/wavelengths.h"

namespace arcus::phase {

class WavelengthGrid {
 public:
  WavelengthGrid() = default;
  /// From the first to the last wavelength [nm, > 0], both included. count ≥ 2; equal ends make equal nodes.
  WavelengthGrid(double first_nm, double last_nm, int count)
      : count_(count), first_(1 / (first_nm * first_nm)), last_(1 / (last_nm * last_nm)),
        per_step_(first_ > last_ ? static_cast<float>((count - 1) / (first_ - last_)) : 0.0f) {}

  int count() const { return count_; }
  /// Wavelength at a position [nm]; whole positions are nodes.
  double wavelength_nm(double position) const {
    return 1 / std::sqrt(first_ + (last_ - first_) * position / (count_ - 1));
  }
  /// Positions between the nodes, 0 to count − 1; wavelengths beyond the grid are taken at its ends.
  Spectrum positions(const Wavelengths& wavelengths) const {
    Spectrum nm;
    std::memcpy(&nm.lanes, wavelengths.nm.data(), sizeof nm.lanes);
    const Spectrum none, last = Spectrum::filled(static_cast<float>(count_ - 1));
    const auto x = (Spectrum::filled(static_cast<float>(first_)) -
                    Spectrum::filled(1) / (nm * nm)).lanes * per_step_;
    const auto above = x > none.lanes ? x : none.lanes;
    return above < last.lanes ? above : last.lanes;
  }

 private:
  int count_ = 2;
  double first_ = 1, last_ = 1;  // 1/wavelength² [1/nm²]
  float per_step_ = 0;           // nodes per 1/nm²
};

}  // namespace arcus::phase
