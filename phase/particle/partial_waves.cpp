#include "phase/particle/partial_waves.h"

#include <cassert>
#include <cmath>

#include "phase/base/units.h"

namespace arcus::phase {
namespace {

using Complex = std::complex<double>;

/// Outgoing Riccati-Hankel function zeta_l(z) = sqrt(pi z / 2) H_(l + 1/2)(z) for l + 1/2 < z by
/// Debye's expansion, DLMF 10.19.6 with U_k of 10.41.10.
Complex riccati_hankel(double l, double z) {
  const double order = l + 0.5;
  const double root = std::sqrt((z - order) * (z + order));  // order tan(beta)
  const double cot = order / root;
  const Complex i(0, 1), q(0, cot / order);  // U_k(i cot) / order^k written in q and cot^2
  const double c2 = cot * cot;
  const Complex u1 = q * (3 + 5 * c2) / 24.0;
  const Complex u2 = q * q * (81 + 462 * c2 + 385 * c2 * c2) / 1152.0;
  const Complex u3 = q * q * q * (30375 + c2 * (369603 + c2 * (765765 + c2 * 425425))) / 414720.0;
  const double phase = root - order * std::acos(order / z) - pi / 4;
  return std::sqrt(z / root) * std::exp(i * phase) * (1.0 - u1 + u2 - u3);
}

/// zeta_l(z) and its logarithmic derivative for l = first ... last.
struct Outgoing {
  std::vector<Complex> value, slope;
};

Outgoing outgoing(double z, int first, int last) {
  const auto count = static_cast<std::size_t>(last - first + 1);
  Outgoing waves{std::vector<Complex>(count), std::vector<Complex>(count)};
  // Upward recurrence from where the expansion is at its best: stable for zeta at every order.
  Complex before = riccati_hankel(first - 1, z), value = riccati_hankel(first, z);
  for (std::size_t i = 0; i < count; ++i) {
    const double l = first + static_cast<double>(i);
    waves.value[i] = value;
    waves.slope[i] = before * std::conj(value) / std::norm(value) - l / z;
    const Complex next = (2 * l + 1) / z * value - before;
    before = value;
    value = next;
  }
  return waves;
}

Complex inverse(Complex z) { return std::conj(z) / std::norm(z); }

/// impedance: n for perpendicular (TE), 1/n for parallel (TM) waves.
SurfaceTerms terms_of(Complex zeta_x, Complex slope_x, Complex zeta_y, Complex slope_y,
                      double impedance) {
  // The incoming functions are the conjugates of the outgoing ones, real arguments provided.
  const Complex in_x = std::conj(slope_x), in_y = std::conj(slope_y);
  const double size_x = std::norm(zeta_x), size_y = std::norm(zeta_y);
  const Complex turn_x = std::conj(zeta_x) * std::conj(zeta_x) / size_x,
                turn_y = zeta_y * zeta_y / size_y;
  const Complex through = inverse(slope_x - impedance * in_y);
  SurfaceTerms terms;
  terms.reflected_outside = -turn_x * (in_x - impedance * in_y) * through;
  terms.reflected_inside = -turn_y * (slope_x - impedance * slope_y) * through;
  // Wronskians: slope - conj(slope) = 2i / |zeta|^2
  terms.passed_through = turn_x * turn_y * through * through * (-4 * impedance / (size_x * size_y));
  return terms;
}

}  // namespace

PartialWaves partial_waves(double x, std::complex<double> m, int first, int last) {
  assert(x >= 50 && m.real() > 1 && first >= 1 && first <= last);
  const double n = m.real(), y = n * x;
  const Outgoing at_x = outgoing(x, first, last), at_y = outgoing(y, first, last);
  PartialWaves waves;
  waves.first = first;
  const std::size_t count = at_x.value.size();
  waves.perpendicular.resize(count);
  waves.parallel.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    SurfaceTerms s = terms_of(at_x.value[i], at_x.slope[i], at_y.value[i], at_y.slope[i], n);
    SurfaceTerms p = terms_of(at_x.value[i], at_x.slope[i], at_y.value[i], at_y.slope[i], 1 / n);
    if (m.imag() > 0) {
      const double sine = (first + static_cast<double>(i) + 0.5) / y;
      const double dimming =
          std::exp(-2 * m.imag() * x * std::sqrt(std::fmax(0.0, 1 - sine * sine)));
      for (SurfaceTerms* t : {&s, &p}) {
        t->passed_through *= dimming;
        t->reflected_inside *= dimming;
      }
    }
    waves.perpendicular[i] = s;
    waves.parallel[i] = p;
  }
  return waves;
}

}  // namespace arcus::phase
