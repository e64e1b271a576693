#include "media/tracking/collision_walk.h"

#include <algorithm>
#include <cmath>

namespace arcus::media {

CollisionWalk CollisionWalk::forced(const Medium& medium, const Ray& ray, const Wavelengths& wavelengths, Random& random,
                                    double majorant_depth, double u) {
  CollisionWalk walk(medium, ray, wavelengths, random);
  // P(depth < x) = (1 − e^(−x)) / (1 − e^(−M)), inverted; expm1 and log1p keep the digits of thin media. Rounding must not
  // push the collision beyond the end.
  walk.next_depth_ = std::min(-std::log1p(u * std::expm1(-majorant_depth)), majorant_depth * (1 - 1e-12));
  return walk;
}

double majorant_depth(const Medium& medium, const Ray& ray, double enough) {
  MajorantWalk walk(medium.majorants(), ray);
  double depth = 0;
  Segment segment;
  while (depth < enough && walk.next(segment)) depth += (segment.end_m - segment.begin_m) * segment.majorant_per_m;
  return depth;
}

}  // namespace arcus::media
