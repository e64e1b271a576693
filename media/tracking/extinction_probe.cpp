#include "media/tracking/extinction_probe.h"

namespace arcus::media {

/// The same as prepared_extinction for components beyond the first few, without anything kept.
Spectrum ExtinctionProbe::distant_extinction(std::size_t k, double distance_m, FastRandom& random, float& size_um) const {
  const Lookup& lookup = lookups_[k];
  const Voxel voxel = lookup.read(lookup.index_from_world.point(ray_.at(distance_m)), random.uniform_cube());
  size_um = lookup.sizes_vary ? voxel.size_um : lookup.size_um;
  return lookup.ratios.at(size_um, columns_) * (voxel.extinction * lookup.scale);
}

void ExtinctionProbe::look_up_several(double distance_m, FastRandom& random, Collision& collision) {
  // Of the components so far, the later one takes over with its share of the sum: in the end each is held with
  // probability in proportion to its extinction, in one pass.
  collision.extinction_per_m = {};
  collision.component_extinction_per_m = {};
  collision.component = 0;
  float u = random.uniform();
  for (std::size_t k = 0; k < count_; ++k) {
    float size_um = 0;
    const Spectrum own = k < prepared ? prepared_extinction(k, distance_m, random, size_um)
                                      : distant_extinction(k, distance_m, random, size_um);
    if (own[0] <= 0) continue;
    collision.extinction_per_m += own;
    const float share = own[0] / collision.extinction_per_m[0];
    if (u < share) {
      u /= share;
      collision.component_extinction_per_m = own;
      collision.component = static_cast<int>(k);
      collision.size_um = size_um;
    } else {
      u = (u - share) / (1 - share);
    }
  }
}

}  // namespace arcus::media
