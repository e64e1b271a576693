#pragma once
// A path at a mirror or at a clear body: one of the ways on, drawn by its share of the light.

#include <algorithm>

#include "phase/base/random.h"
#include "src/shape/surfaces.h"

namespace arcus::render {

/// Weights as VolumePath keeps them: relative to the density of the first wavelength.
struct PathLight {
  Spectrum weight = Spectrum::filled(1);   ///< contribution over the first wavelength's density
  Spectrum density = Spectrum::filled(1);  ///< had that wavelength led, over the first's
  PolarisedRay polarised;

  Spectrum contribution(const Spectrum& light) const { return weight * light / density.mean(); }
  /// From here on the first wavelength goes alone, because others would go elsewhere: it stands for all four.
  void leave_first_alone() {
    weight = {weight[0], 0, 0, 0};
    density = {density[0], 0, 0, 0};
  }
};

/// What the light has lost on its way to a hit through the body that it comes from.
inline void dim(PathLight& light, const Hit& hit, const Wavelengths& wavelengths) {
  if (hit.from_inside && hit.material->body()) light.weight *= hit.material->body()->transmittance(hit.distance_m, wavelengths);
}

/// Turns a path at a hit of a smooth surface: sets ray and departure. False where no light goes on.
inline bool turn_at_smooth(PathLight& light, media::Ray& ray, Departure& departure, const Hit& hit, const Wavelengths& wavelengths, Random& random) {
  if (hit.material->is_dispersive()) light.leave_first_alone();
  const Turns turns = hit.material->turns(ray.direction, hit.normal, hit.from_inside, wavelengths, light.polarised);
  const float reflected = turns.reflected.share.max(), both = reflected + turns.transmitted.share.max();
  if (!(both > 0)) return false;
  const bool crosses = !(random.uniform() * both < reflected);
  const Turn& turn = crosses ? turns.transmitted : turns.reflected;
  light.weight *= turn.share * (both / turn.share.max());
  light.polarised = turn.polarised;
  departure = hit.departure(crosses);
  ray = media::Ray{hit.position_m, turn.direction};
  return true;
}

}  // namespace arcus::render
