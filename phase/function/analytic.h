#pragma once
// Phase functions in closed form, the same at every wavelength: isotropic, molecular (Rayleigh), Henyey–Greenstein.
// Each has value_per_sr(angle), normalised so that the integral over the sphere is 1; draw(u), which turns a number
// uniform in [0, 1) into an angle distributed exactly as the value; and asymmetry(), the mean cosine.

#include "phase/function/half_angle.h"

namespace arcus::phase {

struct Isotropic {
  double value_per_sr(const HalfAngle&) const { return 1 / (4 * pi); }
  HalfAngle draw(double u) const { return {u, 1 - u}; }
  double asymmetry() const { return 0; }
};

/// Air. p = 3/(16π (1+2γ)) [(1+3γ) + (1−γ) cos²θ], γ = δ/(2−δ), δ the depolarisation of natural light scattered at 90°
/// (Bucholtz, "Rayleigh-scattering calculations for the terrestrial atmosphere", Applied Optics 34, 2765, 1995, eq. 12).
class Rayleigh {
 public:
  /// depolarisation in [0, 6/7]; 0.0279 is dry air in the visible (Young, Applied Optics 19, 3427, 1980).
  explicit Rayleigh(double depolarisation = 0.0279);
  double value_per_sr(const HalfAngle& angle) const {
    const double cosine = angle.cosine();
    return constant_ + quadratic_ * cosine * cosine;
  }
  HalfAngle draw(double u) const;
  double asymmetry() const { return 0; }

 private:
  double constant_, quadratic_;
};

/// p = (1−g²) / (4π (1 + g² − 2g cos θ)^(3/2)) (Henyey & Greenstein, Astrophysical Journal 93, 70, 1941).
class HenyeyGreenstein {
 public:
  /// g in (−1, 1): the asymmetry parameter.
  explicit HenyeyGreenstein(double g);
  double value_per_sr(const HalfAngle& angle) const {
    // 1 + g² − 2g cos θ = (1−|g|)² + 4|g| sin²(θ/2), for g < 0 with the cosine: a sum of positive terms.
    const double strength = std::fabs(g_), gap = 1 - strength;
    const double x = gap * gap + 4 * strength * (g_ < 0 ? angle.cos2 : angle.sin2);
    return scale_ / (x * std::sqrt(x));
  }
  HalfAngle draw(double u) const;
  double asymmetry() const { return g_; }

 private:
  double g_;
  double scale_;  // (1 − g²)/4π
};

}  // namespace arcus::phase
