#pragma once
// Local axes around a direction, and compass directions.

#include <cmath>

#include "phase/base/units.h"
#include "phase/base/vec3.h"

namespace arcus {

/// Orthonormal right-handed axes; `along` is the direction they were made around.
struct Frame {
  Vec3 side, other, along;
  /// The vector whose components in this frame are (x, y, z).
  Vec3 to_world(double x, double y, double z) const { return side * x + other * y + along * z; }
};

/// Axes around a unit vector, without a singular direction: Duff et al., "Building an Orthonormal Basis,
/// Revisited", JCGT 6(1), 2017.
inline Frame frame_around(const Vec3& unit) {
  const double sign = std::copysign(1.0, unit.z);
  const double a = -1 / (sign + unit.z);
  const double b = unit.x * unit.y * a;
  return {{1 + sign * unit.x * unit.x * a, sign * b, -sign * unit.x},
          {b, sign + unit.y * unit.y * a, -unit.y},
          unit};
}

/// Unit vector at a compass azimuth (clockwise from north = +y toward east = +x) and elevation above the horizon.
inline Vec3 direction_of(double azimuth_deg, double elevation_deg) {
  const double azimuth = radians(azimuth_deg), elevation = radians(elevation_deg);
  return {std::sin(azimuth) * std::cos(elevation), std::cos(azimuth) * std::cos(elevation), std::sin(elevation)};
}

/// The unit vector at scattering angle θ from the frame's `along`, given s = sin²(θ/2) and an azimuth [rad].
inline Vec3 direction_at(const Frame& frame, double sin2_half, double azimuth_rad) {
  const double sine = 2 * std::sqrt(std::fmax(0.0, sin2_half * (1 - sin2_half)));
  return frame.to_world(sine * std::cos(azimuth_rad), sine * std::sin(azimuth_rad), 1 - 2 * sin2_half);
}

/// Uniformly distributed direction within the cone around the frame's `along` whose half opening angle α has
/// sin²(α/2) = sin2_half_opening (1: the whole sphere); u, v in [0, 1).
inline Vec3 direction_in_cone(const Frame& frame, double sin2_half_opening, double u, double v) {
  return direction_at(frame, u * sin2_half_opening, 2 * pi * v);  // sin²(θ/2) is uniform on a sphere
}

}  // namespace arcus
