#pragma once
// A stretch of a straight line in the world.

#include <limits>

#include "phase/base/vec3.h"

namespace arcus::media {

struct Ray {
  Vec3 origin_m;
  Vec3 direction;      ///< unit vector
  double nearest_m = 0;  ///< the stretch begins here, measured from the origin
  double farthest_m = std::numeric_limits<double>::infinity();

  Vec3 at(double distance_m) const { return origin_m + direction * distance_m; }
};

}  // namespace arcus::media
