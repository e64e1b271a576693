#include "phase/particle/near_axis.h"

#include <math.h>  // j0, j1, y0, y1 are POSIX, not C++

#include <cmath>

#include "phase/base/units.h"
#include "phase/particle/order_field.h"

namespace arcus::phase {

using Complex = std::complex<double>;

double j0_of(double u) { return ::j0(u); }

double j1_over(double u) { return u > 1e-8 ? ::j1(u) / u : 0.5; }

HankelValues hankel(double u) { return {{::j0(u), ::y0(u)}, {::j1(u), ::y1(u)}}; }

AxisFactors axis_factors(double u) {
  if (u > far_from_axis) return {};
  const Complex plain = std::sqrt(2 / (pi * u)) * std::polar(1.0, u - pi / 4);
  if (u < at_axis) return {(::j0(u) - j1_over(u)) / plain, j1_over(u) / plain};
  const HankelValues h = hankel(u);
  return {(h.zeroth - h.first / u) / plain, h.first / u / plain};
}

void apply_axis(const AxisFactors& factors, int side, bool back, Complex& s1, Complex& s2) {
  const bool first_kind = (side > 0) != back;
  const Complex own = first_kind ? factors.own : std::conj(factors.own);
  Complex mixed = first_kind ? factors.mixed : std::conj(factors.mixed);
  if (back) mixed = -mixed;
  const Complex before = s1;
  s1 = s1 * own + s2 * mixed;
  s2 = s2 * own + before * mixed;
}

AxisPowers axis_powers(double u, double x_sine, bool back, double relative_step) {
  if (u > far_from_axis) return {};
  const double ratio = j1_over(u), slope = ::j0(u) - ratio, front = pi * x_sine;
  AxisPowers powers{slope * slope * front, ratio * ratio * front,
                    (back ? -1 : 1) * slope * ratio * front};
  if (u > at_axis) {
    const double y_slope = ::y0(u) - ::y1(u) / u, left = fringe_left(relative_step, 2 * u);
    powers.own = 0.5 * front * (slope * slope * (1 + left) + y_slope * y_slope * (1 - left));
  }
  return powers;
}

AxisExpansion axis_expansion(double u) {
  const double j0 = ::j0(u), ratio = j1_over(u), slope = j0 - ratio;
  const double curved = u > 1e-8 ? -slope - (u - 1 / u) * ::j1(u) : 0;  // u J1''
  return {slope, curved, ratio, j0 - 2 * ratio};                        // u (J1/u)' = J0 - 2 J1/u
}

}  // namespace arcus::phase
