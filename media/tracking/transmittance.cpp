#include "media/tracking/transmittance.h"

#include <cmath>

#include "media/majorant/majorant_walk.h"
#include "media/tracking/extinction_probe.h"
#include "media/tracking/fast_random.h"

namespace arcus::media {

Spectrum ratio_transmittance(const Medium& medium, const Ray& ray, const Wavelengths& wavelengths, Random& random) {
  // Below this much of the light a ray goes on with probability 1/2, and then counts twice.
  constexpr float enough = 0.1f;
  MajorantWalk walk(medium.majorants(), ray);
  ExtinctionProbe probe(medium, ray, wavelengths);
  FastRandom fast(random);
  Spectrum remaining = Spectrum::filled(1);  // after the collisions; the smallest extinction of every cell dims it further
  float most = 1;
  double sure_depth = 0, most_sure_depth = -std::log(enough), left = fast.exponential();
  Segment cell;
  while (walk.next(cell)) {
    const double length_m = cell.end_m - cell.begin_m, rest_per_m = cell.majorant_per_m - cell.minorant_per_m;
    sure_depth += cell.minorant_per_m * length_m;
    double place_m = cell.begin_m;
    while (left < (cell.end_m - place_m) * rest_per_m) {
      place_m += left / rest_per_m;
      left = fast.exponential();
      const Spectrum above = probe.extinction_per_m(place_m, fast) - Spectrum::filled(static_cast<float>(cell.minorant_per_m));
      remaining *= Spectrum::filled(1) - above / static_cast<float>(rest_per_m);
      most = remaining.max();
      if (!(most > 0)) return {};
      most_sure_depth = std::log(most / enough);
    }
    left -= (cell.end_m - place_m) * rest_per_m;
    while (sure_depth > most_sure_depth) {
      if (fast.uniform() >= 0.5f) return {};
      remaining *= 2;
      most_sure_depth += std::log(2.0);
    }
  }
  return remaining * static_cast<float>(std::exp(-sure_depth));
}

}  // namespace arcus::media
