#pragma once
// Extinction at points along a ray: what tracking asks at every tentative collision.

#include <array>

#include "media/medium/lookup.h"
#include "media/medium/medium.h"
#include "media/space/ray.h"
#include "media/tracking/fast_random.h"
#include "phase/base/wavelengths.h"

namespace arcus::media {

class ExtinctionProbe {
 public:
  /// The medium must outlive it.
  ExtinctionProbe(const Medium& medium, const Ray& ray, const Wavelengths& wavelengths)
      : lookups_(medium.lookups().data()), count_(medium.lookups().size()), ray_(ray), columns_(RatioTable::columns(wavelengths, ray.direction.z)) {
    for (std::size_t k = 0; k < std::min(prepared, count_); ++k) {
      const Lookup& lookup = lookups_[k];
      views_[k].origin = lookup.index_from_world.point(ray.origin_m);
      views_[k].direction = lookup.index_from_world.vector(ray.direction);
      if (!lookup.sizes_vary) views_[k].low = lookup.ratios.at(lookup.size_um, columns_) * lookup.scale;
    }
  }

  const Ray& ray() const { return ray_; }

  /// Fills in what the medium is like at a distance along the ray, in one voxel a component, and draws the component that would
  /// scatter.
  void look_up(double distance_m, FastRandom& random, Collision& collision) {
    if (count_ == 1) {
      collision.extinction_per_m = collision.component_extinction_per_m = prepared_extinction(0, distance_m, random, collision.size_um);
      collision.component = 0;
      return;
    }
    look_up_several(distance_m, random, collision);
  }
  /// Extinction alone.
  Spectrum extinction_per_m(double distance_m, FastRandom& random) {
    float size_um;
    Spectrum sum;
    for (std::size_t k = 0; k < count_; ++k)
      sum += k < prepared ? prepared_extinction(k, distance_m, random, size_um) : distant_extinction(k, distance_m, random, size_um);
    return sum;
  }

 private:
  static constexpr std::size_t prepared = 4;
  /// A ray as seen from a component, and the ratios to 550 nm, times the component's scale, of the last two rows of sizes used.
  struct View {
    Vec3 origin, direction;
    int row = -1;
    Spectrum low, step;
  };

  Spectrum prepared_extinction(std::size_t k, double distance_m, FastRandom& random, float& size_um) {
    const Lookup& lookup = lookups_[k];
    View& view = views_[k];
    const Voxel voxel = lookup.read(view.origin + view.direction * distance_m, random.uniform_cube());
    if (!lookup.sizes_vary) {
      size_um = lookup.size_um;
      return view.low * voxel.extinction;
    }
    size_um = voxel.size_um;
    const float place = lookup.ratios.row_of(voxel.size_um);
    const int row = static_cast<int>(place);
    if (row != view.row) fill(view, lookup, row);
    return (view.low + view.step * (place - static_cast<float>(row))) * voxel.extinction;
  }
  void fill(View& view, const Lookup& lookup, int row) {
    view.row = row;
    view.low = lookup.ratios.row(row, columns_) * lookup.scale;
    view.step = lookup.ratios.row(row + 1, columns_) * lookup.scale - view.low;
  }
  Spectrum distant_extinction(std::size_t k, double distance_m, FastRandom& random, float& size_um) const;
  void look_up_several(double distance_m, FastRandom& random, Collision& collision);

  const Lookup* lookups_;
  std::size_t count_;
  Ray ray_;
  RatioTable::Columns columns_;
  std::array<View, prepared> views_;
};

}  // namespace arcus::media
