#pragma once
// Points and directions: Imath's vectors under our names. Double precision, so that a scene far from the origin
// does not jitter and the angle between two nearly equal directions keeps its digits.

#include <Imath/ImathVec.h>

#include <cmath>

namespace arcus {

using Vec3 = Imath::V3d;

inline double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(const Vec3& a, const Vec3& b) { return a.cross(b); }
inline double squared_length(const Vec3& v) { return dot(v, v); }
inline double length(const Vec3& v) { return std::sqrt(dot(v, v)); }

/// The unit vector along v. v must not be zero.
inline Vec3 normalize(const Vec3& v) { return v * (1 / length(v)); }

/// sin²(θ/2) of the angle θ between two unit vectors, in [0, 1], to full relative precision near 0; near 1 it has the
/// absolute precision of a double. Never take θ from acos of a dot product: near 0 and 180° it has no digits.
inline double sin2_half_angle(const Vec3& a, const Vec3& b) {
  return std::fmin(1.0, 0.25 * squared_length(a - b));
}

/// Angle between two unit vectors [rad], accurate also near 0 and pi.
inline double angle_between_rad(const Vec3& a, const Vec3& b) {
  return 2 * std::atan2(length(a - b), length(a + b));
}

}  // namespace arcus
