#pragma once
// A ray: where it starts, which way it goes, and between which distances it counts.

#include <limits>

#include "phase/base/vec3.h"

namespace arcus::media {

struct Ray {
  Vec3 origin_m;
  Vec3 direction;  ///< unit vector
  double nearest_m = 0;
  double farthest_m = std::numeric_limits<double>::infinity();
};

}  // namespace arcus::media
