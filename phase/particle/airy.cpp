#include "phase/particle/airy.h"

#include <cmath>

#include "phase/base/units.h"

namespace arcus::phase {
namespace {

/// Maclaurin series, DLMF 9.4.1 and 9.4.3. Cancellation costs the digits e^(2 z^1.5 / 3), on both
/// sides of 0.
AiryValues by_series(double z) {
  constexpr double ai_0 = 0.35502805388781723926, ai_slope_0 = -0.25881940379280679841;
  const double cube = z * z * z;
  // f = 1 + z^3/(2 3) + ..., g = z + z^4/(3 4) + ..., and their derivatives
  double f = 1, g = z, f_slope = 0, g_slope = 1;
  double f_term = 1, g_term = z;
  for (int k = 1; k < 60; ++k) {
    const double n = 3 * k;
    f_term *= cube / (n * (n - 1));
    g_term *= cube / (n * (n + 1));
    f += f_term;
    g += g_term;
    if (z != 0) {
      f_slope += f_term * n / z;
      g_slope += g_term * (n + 1) / z;
    }
    if (std::fabs(f_term) < 1e-17 * std::fabs(f) && std::fabs(g_term) < 1e-17 * std::fabs(g)) break;
  }
  const double root3 = std::sqrt(3.0);
  return {ai_0 * f + ai_slope_0 * g, ai_0 * f_slope + ai_slope_0 * g_slope,
          root3 * (ai_0 * f - ai_slope_0 * g), root3 * (ai_0 * f_slope - ai_slope_0 * g_slope)};
}

// Coefficients u_k and v_k of DLMF 9.7.2, k = 0 ... 7.
struct Coefficients {
  double u[8], v[8];
};
Coefficients coefficients() {
  Coefficients c;
  c.u[0] = c.v[0] = 1;
  for (int k = 1; k < 8; ++k) {
    c.u[k] = c.u[k - 1] * (6.0 * k - 5) * (6 * k - 3) * (6 * k - 1) / ((2.0 * k - 1) * 216 * k);
    c.v[k] = c.u[k] * (6.0 * k + 1) / (1 - 6.0 * k);
  }
  return c;
}

/// DLMF 9.7.5 to 9.7.8.
AiryValues decaying(double z) {
  static const Coefficients c = coefficients();
  const double xi = 2.0 / 3 * z * std::sqrt(z), root4 = std::sqrt(std::sqrt(z));
  double ai = 0, ai_slope = 0, bi = 0, bi_slope = 0, power = 1, sign = 1;
  for (int k = 0; k < 8; ++k) {
    ai += sign * c.u[k] * power;
    ai_slope += sign * c.v[k] * power;
    bi += c.u[k] * power;
    bi_slope += c.v[k] * power;
    power /= xi;
    sign = -sign;
  }
  const double down = std::exp(-xi) / (2 * std::sqrt(pi)), up = std::exp(xi) / std::sqrt(pi);
  return {down / root4 * ai, -down * root4 * ai_slope, up / root4 * bi, up * root4 * bi_slope};
}

/// DLMF 9.7.9 to 9.7.12 at -z.
AiryValues oscillating(double z) {
  static const Coefficients c = coefficients();
  const double xi = 2.0 / 3 * z * std::sqrt(z), root4 = std::sqrt(std::sqrt(z));
  double u_even = 0, u_odd = 0, v_even = 0, v_odd = 0, power = 1;
  for (int k = 0; k < 8; k += 2) {
    const double sign = k % 4 == 0 ? 1 : -1;
    u_even += sign * c.u[k] * power;
    v_even += sign * c.v[k] * power;
    power /= xi;
    u_odd += sign * c.u[k + 1] * power;
    v_odd += sign * c.v[k + 1] * power;
    power /= xi;
  }
  const double cosine = std::cos(xi - pi / 4), sine = std::sin(xi - pi / 4),
               front = 1 / std::sqrt(pi);
  return {front / root4 * (cosine * u_even + sine * u_odd),
          front * root4 * (sine * v_even - cosine * v_odd),
          front / root4 * (-sine * u_even + cosine * u_odd),
          front * root4 * (cosine * v_even + sine * v_odd)};
}

}  // namespace

AiryValues airy(double z) {
  if (z > 4) return decaying(z);
  if (z < -7) return oscillating(-z);
  return by_series(z);
}

}  // namespace arcus::phase
