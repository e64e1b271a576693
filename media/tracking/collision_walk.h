#pragma once
// The tracking loop: tentative collisions along a ray, one at a time (Woodcock et al. 1965), at the rate of the majorants
// of the cells that the ray crosses. Whoever pulls them decides what happens at each.

#include "media/majorant/majorant_walk.h"
#include "media/medium/medium.h"
#include "media/space/ray.h"
#include "media/tracking/extinction_probe.h"
#include "media/tracking/fast_random.h"
#include "phase/base/random.h"
#include "phase/base/wavelengths.h"

namespace arcus::media {

class CollisionWalk {
 public:
  /// Takes 64 bits from `random`, whatever happens later; all its choices follow from these. The medium must outlive it.
  CollisionWalk(const Medium& medium, const Ray& ray, const Wavelengths& wavelengths, Random& random)
      : probe_(medium, ray, wavelengths), walk_(medium.majorants(), ray), random_(random) {
    next_depth_ = random_.exponential();
  }

  /// A walk whose first tentative collision certainly happens: it is placed with u in [0, 1) by the exponential
  /// distribution cut off at `majorant_depth` M > 0, which must be the ray's (below). The caller multiplies by the
  /// probability of that, 1 − e^(−M).
  static CollisionWalk forced(const Medium& medium, const Ray& ray, const Wavelengths& wavelengths, Random& random,
                              double majorant_depth, double u);

  /// Goes on to the next tentative collision; false where the ray leaves the medium or ends.
  bool next(Collision& collision) {
    double left = next_depth_;
    while (true) {
      const double majorant = segment_.majorant_per_m;
      const double depth = (segment_.end_m - place_m_) * majorant;
      if (left < depth) {
        place_m_ += left / majorant;
        break;
      }
      left -= depth;
      if (!walk_.next(segment_)) {
        place_m_ = segment_.end_m;
        return false;
      }
      place_m_ = segment_.begin_m;
    }
    next_depth_ = random_.exponential();
    collision.distance_m = place_m_;
    collision.position_m = probe_.ray().at(place_m_);
    collision.majorant_per_m = segment_.majorant_per_m;
    probe_.look_up(place_m_, random_, collision);
    return true;
  }

 private:
  ExtinctionProbe probe_;
  MajorantWalk walk_;
  FastRandom random_;
  Segment segment_;
  double place_m_ = 0;
  double next_depth_;  // from the present place to the next tentative collision, in the majorant's optical depth
};

/// Integral of the majorant along a ray: the expected number of tentative collisions. Looks at cells only, no voxels, and at no
/// more of them once it has found `enough`: the answer is then that or more.
double majorant_depth(const Medium& medium, const Ray& ray, double enough = std::numeric_limits<double>::infinity());

}  // namespace arcus::media
