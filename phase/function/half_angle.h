#pragma once
// A scattering angle θ as the pair sin²(θ/2), cos²(θ/2): whichever of the two is small has full relative precision, so
// that both the forward peak and the glory keep their digits (an acos of a dot product has none at either end), and
// solid angle is uniform in either of them: dΩ = 4π d sin²(θ/2).

#include <cmath>

#include "phase/base/frame.h"
#include "phase/base/turn.h"
#include "phase/base/vec3.h"

namespace arcus::phase {

struct HalfAngle {
  double sin2 = 0;  ///< sin²(θ/2): 0 straight on, 1 backwards
  double cos2 = 1;  ///< 1 − sin2, up to rounding
  double cosine() const { return cos2 - sin2; }
};

/// The angle between two unit vectors.
inline HalfAngle half_angle_between(const Vec3& a, const Vec3& b) {
  return {0.25 * squared_length(a - b), 0.25 * squared_length(a + b)};
}

inline HalfAngle half_angle_of_rad(double angle_rad) {
  const double sine = std::sin(0.5 * angle_rad), cosine = std::cos(0.5 * angle_rad);
  return {sine * sine, cosine * cosine};
}

/// The unit vector at an angle from the unit vector `incoming`, turned about it by `turn` of a whole
/// turn, in [0, 1).
inline Vec3 direction_at(const Vec3& incoming, const HalfAngle& angle, double turn) {
  const SineCosine azimuth = sine_and_cosine_of_turn(turn);
  const double sine = 2 * std::sqrt(angle.sin2 * angle.cos2);
  return frame_around(incoming).to_world(sine * azimuth.cosine, sine * azimuth.sine, angle.cosine());
}

}  // namespace arcus::phase
