#include "src/scene/colour_spectrum.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "src/film/colour.h"

namespace arcus::render {
namespace {

using Triple = std::array<double, 3>;

Triple rgb_of(const SmoothSpectrum& spectrum) {
  static const ToRgb to_rgb = to_rgb_from_white(equal_energy_white());
  const Rgb rgb = to_rgb(xyz_of([&](double nm) { return spectrum.at(nm); }));
  return {rgb.r, rgb.g, rgb.b};
}

Triple difference(const Triple& a, const Triple& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double squares(const Triple& a) { return a[0] * a[0] + a[1] * a[1] + a[2] * a[2]; }

/// Solves (JᵀJ + damping) step = Jᵀ residual; columns[k]: derivative by coefficient k.
Triple damped_step(const std::array<Triple, 3>& columns, const Triple& residual, double damping) {
  double m[3][4];
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k)
      m[i][k] = columns[i][0] * columns[k][0] + columns[i][1] * columns[k][1] + columns[i][2] * columns[k][2];
    m[i][i] *= 1 + damping;
    m[i][i] += 1e-14;
    m[i][3] = columns[i][0] * residual[0] + columns[i][1] * residual[1] + columns[i][2] * residual[2];
  }
  for (std::size_t i = 0; i < 3; ++i)  // positive definite: no pivots needed
    for (std::size_t row = 0; row < 3; ++row) {
      if (row == i) continue;
      const double factor = m[row][i] / m[i][i];
      for (std::size_t k = i; k < 4; ++k) m[row][k] -= factor * m[i][k];
    }
  return {m[0][3] / m[0][0], m[1][3] / m[1][1], m[2][3] / m[2][2]};
}

}  // namespace

SmoothSpectrum spectrum_of_colour(const std::vector<double>& colour) {
  if (colour.size() == 1) return SmoothSpectrum(colour[0]);
  const Triple target{colour[0], colour[1], colour[2]};
  if (target[0] == target[1] && target[1] == target[2]) return SmoothSpectrum(target[0]);
  // Begins with the grey of the mean: S(x) = m for x = (2m − 1) / (2 √(m (1 − m))).
  const double mean = std::clamp((target[0] + target[1] + target[2]) / 3, 0.01, 0.99);
  Triple c{0, 0, (2 * mean - 1) / (2 * std::sqrt(mean * (1 - mean)))};
  Triple residual = difference(target, rgb_of(SmoothSpectrum(c)));
  double damping = 1e-3;
  for (int round = 0; round < 60 && squares(residual) > 1e-12; ++round) {
    std::array<Triple, 3> columns;
    for (std::size_t k = 0; k < 3; ++k) {
      Triple moved = c;
      const double step = 1e-4 * std::max(1.0, std::fabs(c[k]));
      moved[k] += step;
      const Triple change = difference(rgb_of(SmoothSpectrum(moved)), difference(target, residual));
      columns[k] = {change[0] / step, change[1] / step, change[2] / step};
    }
    const Triple step = damped_step(columns, residual, damping);
    const Triple next{c[0] + step[0], c[1] + step[1], c[2] + step[2]};
    const Triple left = difference(target, rgb_of(SmoothSpectrum(next)));
    // Saturated colours drive the coefficients to infinity for less and less.
    if (squares(left) < squares(residual) && squares(next) < 1e8) {
      c = next;
      residual = left;
      damping = std::max(1e-9, 0.3 * damping);
    } else {
      damping *= 10;
      if (damping > 1e9) break;
    }
  }
  return SmoothSpectrum(c);
}

}  // namespace arcus::render
