#pragma once
// Heights along a straight line over a round planet.

#include <algorithm>
#include <cmath>

#include "phase/base/vec3.h"

namespace arcus::media {

/// A straight line as seen from the planet's centre: h(s) for the distance s from its origin, without the loss of digits of √(…) − R.
struct Flight {
  double radius_m;     ///< of the planet
  double start_m;      ///< height at s = 0
  double climb;        ///< cosine of the zenith angle at s = 0
  double to_lowest_m;  ///< s of the lowest point
  double lowest_m;     ///< its height; below 0 where the line goes through the planet

  Flight(const Vec3& origin_m, const Vec3& direction, double radius, double height) : radius_m(radius), start_m(height) {
    const Vec3 from_centre(origin_m.x, origin_m.y, origin_m.z + radius);
    const double r = radius + height;
    climb = dot(from_centre, direction) / r;
    to_lowest_m = -r * climb;
    const double sine_squared = std::max(0.0, 1 - climb * climb);
    lowest_m = (height * (2 * radius + height) - r * r * climb * climb) / (r * std::sqrt(sine_squared) + radius);
  }

  double height_m(double s) const {
    const double r = radius_m + start_m;
    const double squares = start_m * (2 * radius_m + start_m) + s * (2 * r * climb + s);  // of the distance to the centre, less radius²
    return squares / (std::sqrt(squares + radius_m * radius_m) + radius_m);
  }

  /// Half of the stretch below a height: it lies around the lowest point; 0 where the line stays above.
  double half_below_m(double height) const {
    const double difference = (height - lowest_m) * (2 * radius_m + height + lowest_m);
    return difference > 0 ? std::sqrt(difference) : 0;
  }
};

}  // namespace arcus::media
