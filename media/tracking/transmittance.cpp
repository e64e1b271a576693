#include "media/tracking/transmittance.h"

#include "media/tracking/collision_walk.h"

namespace arcus::media {

Spectrum ratio_transmittance(const Medium& medium, const Ray& ray, const Wavelengths& wavelengths, Random& random) {
  Spectrum remaining = Spectrum::filled(1);
  CollisionWalk walk(medium, ray, wavelengths, random);
  Collision collision;
  while (walk.next(collision)) {
    remaining *= Spectrum::filled(1) - collision.extinction_per_m / collision.majorant_per_m;
    const float most = remaining.max();
    if (most < 0.1f) {
      // Goes on with probability p = 0.5 and then counts 1/p.
      if (!(most > 0) || random.uniform() >= 0.5f) return {};
      remaining *= 2;
    }
  }
  return remaining;
}

}  // namespace arcus::media
