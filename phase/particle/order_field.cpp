#include "phase/particle/order_field.h"

#include <cmath>

namespace arcus::phase {

double fringe_left(double relative_step, double turn) {
  const double exponent = relative_step * relative_step * turn * turn / 12;
  return exponent < 12 ? std::exp(-exponent) : 0;
}

void OrderField::clear() {
  for (int i = 0; i < extras_; ++i) waves_[i] = {};
  extras_ = 4;
}

void OrderField::apply_phases() {
  for (int i = 0; i < extras_; ++i) {
    Wave& wave = waves_[i];
    if (!wave.used || wave.phased) continue;
    const std::complex<double> phase = std::polar(1.0, wave.turn);
    wave.s1 *= phase;
    wave.s2 *= phase;
    wave.phased = true;
  }
}

void OrderField::add_to(AmplitudeProducts& sums, double relative_step) {
  for (int i = 0; i < extras_; ++i) {
    const Wave& wave = waves_[i];
    if (!wave.used) continue;
    sums.i1 += std::norm(wave.s1);
    sums.i2 += std::norm(wave.s2);
    sums.i3 += wave.s2 * std::conj(wave.s1);
    for (int j = 0; j < i; ++j) {
      const Wave& other = waves_[j];
      if (!other.used) continue;
      const double left = fringe_left(relative_step, wave.turn - other.turn);
      if (left == 0) continue;
      apply_phases();
      sums.i1 += 2 * left * (wave.s1 * std::conj(other.s1)).real();
      sums.i2 += 2 * left * (wave.s2 * std::conj(other.s2)).real();
      sums.i3 += left * (wave.s2 * std::conj(other.s1) + other.s2 * std::conj(wave.s1));
    }
  }
}

}  // namespace arcus::phase
