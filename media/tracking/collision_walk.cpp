#include "media/tracking/collision_walk.h"

#include <algorithm>
#include <cmath>

namespace arcus::media {

CollisionWalk::CollisionWalk(const Medium& medium, const Ray& ray, const Wavelengths& wavelengths, Random& random)
    : medium_(&medium), ray_(ray), walk_(medium.majorants(), ray), random_(random), columns_(RatioTable::columns(wavelengths)) {
  next_depth_ = random_.exponential();
  const std::size_t count = std::min(prepared_rays, medium.lookups().size());
  for (std::size_t k = 0; k < count; ++k) {
    const Affine& map = medium.lookups()[k].index_from_world;
    index_rays_[k] = {map.point(ray.origin_m), map.vector(ray.direction)};
  }
}

CollisionWalk CollisionWalk::forced(const Medium& medium, const Ray& ray, const Wavelengths& wavelengths, Random& random,
                                    double majorant_depth, double u) {
  CollisionWalk walk(medium, ray, wavelengths, random);
  // P(depth < x) = (1 − e^(−x)) / (1 − e^(−M)), inverted; expm1 and log1p keep the digits of thin media. Rounding must not
  // push the collision beyond the end.
  walk.next_depth_ = std::min(-std::log1p(u * std::expm1(-majorant_depth)), majorant_depth * (1 - 1e-12));
  return walk;
}

Spectrum CollisionWalk::extinction(std::size_t component, float& size_um) {
  const Lookup& lookup = medium_->lookups()[component];
  const Vec3 index = component < prepared_rays
                         ? index_rays_[component].origin + index_rays_[component].direction * place_m_
                         : lookup.index_from_world.point(ray_.at(place_m_));
  const Voxel voxel = lookup.read(index, random_.uniform_cube());
  size_um = lookup.sizes_vary ? voxel.size_um : lookup.size_um;
  return lookup.ratios.at(size_um, columns_) * (voxel.extinction * lookup.scale);
}

void CollisionWalk::look_up(Collision& collision) {
  const std::size_t count = medium_->lookups().size();
  if (count == 1) {
    collision.extinction_per_m = collision.component_extinction_per_m = extinction(0, collision.size_um);
    return;
  }
  // Of the components so far, the later one takes over with its share of the sum: in the end each is held with
  // probability in proportion to its extinction, in one pass.
  collision.extinction_per_m = {};
  collision.component_extinction_per_m = {};
  collision.component = 0;
  float u = random_.uniform();
  for (std::size_t k = 0; k < count; ++k) {
    float size_um = 0;
    const Spectrum own = extinction(k, size_um);
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

double majorant_depth(const Medium& medium, const Ray& ray) {
  MajorantWalk walk(medium.majorants(), ray);
  double depth = 0;
  Segment segment;
  while (walk.next(segment)) depth += (segment.end_m - segment.begin_m) * segment.majorant_per_m;
  return depth;
}

}  // namespace arcus::media
