#include "media/tracking/optical_depth.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "media/medium/lookup.h"

namespace arcus::media {
namespace {

using Depth = std::array<double, wavelength_count>;

/// Adds the optical depth of one component.
void add(Depth& depth, const Lookup& lookup, const Ray& ray, const RatioTable::Columns& columns) {
  const Box support = lookup.support();
  if (support.is_empty()) return;
  Vec3 origin = lookup.index_from_world.point(ray.origin_m);
  const Vec3 direction = lookup.index_from_world.vector(ray.direction);
  const auto inside = clip(origin, direction, ray.nearest_m, ray.farthest_m, support);
  if (!inside) return;
  origin += direction * inside->begin;  // measured from the entry on, so that a distant origin costs no digits
  const double length_m = inside->end - inside->begin;
  const auto gather = [&](double at_m, double weight_m) {
    const Spectrum extinction = lookup.interpolated(origin + direction * at_m, columns);
    for (int i = 0; i < wavelength_count; ++i) depth[static_cast<std::size_t>(i)] += weight_m * extinction[i];
  };
  if (!lookup.grid) return gather(length_m / 2, length_m);

  // Values change at whole coordinates where they are interpolated and half-way between where they are not.
  const double shift = lookup.is_linear ? 0 : 0.5;
  double begin = 0;
  while (begin < length_m) {
    const Vec3 place = origin + direction * begin;
    double end = length_m;
    for (int axis = 0; axis < 3; ++axis) {
      if (direction[axis] == 0) continue;
      const double at = place[axis] - shift;
      // A plane less than 1e-9 voxels ahead is the one that the ray stands on.
      const double plane = direction[axis] > 0 ? std::floor(at + 1e-9) + 1 : std::ceil(at - 1e-9) - 1;
      end = std::min(end, begin + (plane - at) / direction[axis]);
    }
    const double middle = (begin + end) / 2, half = (end - begin) / 2;
    if (lookup.is_linear) {
      const double offset = half / std::sqrt(3.0);
      gather(middle - offset, half);
      gather(middle + offset, half);
    } else {
      gather(middle, 2 * half);
    }
    begin = end;
  }
}

Depth depth_of(const Medium& medium, const Ray& ray, const Wavelengths& wavelengths) {
  Depth depth{};
  const RatioTable::Columns columns = RatioTable::columns(wavelengths, ray.direction.z);
  for (const Lookup& lookup : medium.lookups()) add(depth, lookup, ray, columns);
  return depth;
}

}  // namespace

Spectrum optical_depth(const Medium& medium, const Ray& ray, const Wavelengths& wavelengths) {
  const Depth d = depth_of(medium, ray, wavelengths);
  return {static_cast<float>(d[0]), static_cast<float>(d[1]), static_cast<float>(d[2]), static_cast<float>(d[3])};
}

double optical_depth(const Medium& medium, const Ray& ray, double wavelength_nm) {
  Wavelengths wavelengths;
  wavelengths.nm.fill(static_cast<float>(wavelength_nm));
  return depth_of(medium, ray, wavelengths)[0];
}

}  // namespace arcus::media
