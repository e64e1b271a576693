#pragma once
// The only tracking loop: tentative collisions along a ray, one at a time (Woodcock et al. 1965), at the rate of the
// majorants of the cells that the ray crosses. Whoever pulls them decides what happens at each.

#include "media/medium/medium.h"
#include "media/space/ray.h"
#include "phase/base/random.h"
#include "phase/base/wavelengths.h"

namespace arcus::media {

class CollisionWalk {
 public:
  /// Takes 64 bits from `random`, whatever happens later; all its choices follow from these.
  CollisionWalk(const Medium&, const Ray&, const Wavelengths&, Random&);

  /// A walk whose first tentative collision certainly happens: it is placed with u in [0, 1) by the exponential
  /// distribution cut off at `majorant_depth` M > 0, which must be the ray's (below). The caller multiplies by the
  /// probability of that, 1 − e^(−M).
  static CollisionWalk forced(const Medium&, const Ray&, const Wavelengths&, Random&, double majorant_depth, double u);

  /// Goes on to the next tentative collision; false where the ray leaves the medium or ends.
  bool next(Collision&);
};

/// Integral of the majorant along a ray: the expected number of tentative collisions. Looks at cells only, no voxels.
double majorant_depth(const Medium&, const Ray&);

}  // namespace arcus::media
