#pragma once
// The moon as a light: how much of the sun's light it sends on, by phase angle and wavelength, and how its disc is lit.
//
// Brightness by phase: V = -12.73 + 0.026 |g| + 4e-9 g^4 for the mean distance, g in degrees (C. W. Allen, Astrophysical Quantities, 1976; K.
// Krisciunas and B. E. Schaefer, "A model of the brightness of moonlight", PASP 103, 1033, 1991, equation 9), against the sun's V = -26.74 (C. N. A.
// Willmer, "The absolute magnitude of the Sun in several filters", ApJS 236, 47, 2018: -26.76; Allen: -26.74). The opposition surge near full is left
// out: 17 % at 1.55 degrees.
// Colour: a parabola through the logarithm of the reflectances of H. H. Kieffer and T. C. Stone (2005) at the phase angle,
// src/light/data/lunar_reflectance.csv, whose bands scatter by a few per cent around it.
// The disc: the law of Lommel and Seeliger, radiance in proportion to mu0 / (mu0 + mu): uniform at full moon, as the moon is, with a terminator at
// other phases.

#include "phase/base/vec3.h"

namespace arcus::render {

inline constexpr double most_phase_angle_deg = 175;  // nearer the sun nobody has seen it (Danjon's limit, 7 degrees)

/// Irradiance by the moon over that by the sun at the same vacuum wavelength, both outside the air and at their mean distances. The phase angle, sun
/// - moon - eye, from 0 (full) through 90 (half) to most_phase_angle_deg.
class MoonReflection {
 public:
  explicit MoonReflection(double phase_angle_deg);
  double irradiance_over_suns(double wavelength_nm) const;

 private:
  double c0_, c1_, c2_;  // ln of it: a parabola in (wavelength - 550 nm) / 100 nm
};

/// The moon's face. Places (x, y) on a disc of radius 1, x towards the bright limb, y across; equal areas of it are equal solid angles.
class MoonFace {
 public:
  explicit MoonFace(double phase_angle_deg);

  struct Place {
    double x, y;
  };
  /// Radiance over that which the disc would have if it were uniform: mean 1 over the whole disc, 0 on its dark part.
  double relative_radiance(Place place) const;
  /// No place has more.
  double most_radiance() const { return most_; }
  bool is_lit(Place place) const { return place.x * sine_ + mu_of(place) * cosine_ > 0; }
  /// Share of the disc that is lit: (1 + cos g) / 2.
  double lit_share() const { return 0.5 * (1 + cosine_); }
  /// A place of the lit part from one of the whole disc, uniform where that is: each line along x is squeezed into its lit part, by the same factor.
  Place lit_place(Place place) const;

 private:
  static double mu_of(Place place);
  double sine_, cosine_, most_, per_mean_;
};

}  // namespace arcus::render
