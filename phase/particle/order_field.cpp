#include "phase/particle/order_field.h"

#include <cmath>

#include "phase/base/units.h"

namespace arcus::phase {

double fringe_left(double relative_step, double turn) {
  const double half = 0.5 * relative_step * std::fabs(turn);
  if (half < 1e-3) return 1 - half * half / 3;
  // Faster fringes would be seen slowed down on the grid of sizes: beyond the first zero nothing is left.
  if (half > pi) return 0;
  const double sinc = std::sin(half) / half;
  return sinc * sinc;
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
