#include "phase/function/analytic.h"

#include <cassert>

namespace arcus::phase {

Rayleigh::Rayleigh(double depolarisation) {
  assert(depolarisation >= 0 && depolarisation <= 6.0 / 7);
  const double gamma = depolarisation / (2 - depolarisation);
  const double scale = 3 / (16 * pi * (1 + 2 * gamma));
  constant_ = scale * (1 + 3 * gamma);
  quadratic_ = scale * (1 - gamma);
}

HalfAngle Rayleigh::draw(double u) const {
  // A mixture of a uniform cosine and of one with density ∝ cos²θ, whose cumulative (1 + cos³θ)/2 inverts at once.
  const double uniform_share = 4 * pi * constant_;
  double sin2;
  if (u < uniform_share)
    sin2 = u / uniform_share;
  else
    sin2 = 0.5 * (1 - std::cbrt(1 - 2 * (u - uniform_share) / (1 - uniform_share)));
  sin2 = std::fmin(1.0, std::fmax(0.0, sin2));
  return {sin2, 1 - sin2};
}

HenyeyGreenstein::HenyeyGreenstein(double g) : g_(g), scale_((1 - g) * (1 + g) / (4 * pi)) {
  assert(g > -1 && g < 1);
}

HalfAngle HenyeyGreenstein::draw(double u) const {
  // The cumulative over s = sin²(θ/2) for g > 0 is (1−g²)/2g [1/(1−g) − 1/√((1−g)² + 4gs)] = u. Solved for s with the
  // differences of nearly equal numbers cancelled by hand, so that it holds for g → 0 (s = u) and for g → 1.
  const double strength = std::fabs(g_), gap = 1 - strength;
  const double d = gap + 2 * strength * (1 - u);
  const double s = std::fmin(1.0, u * gap * gap * (1 + strength * (1 - u)) / (d * d));
  return g_ < 0 ? HalfAngle{1 - s, s} : HalfAngle{s, 1 - s};
}

}  // namespace arcus::phase
