#pragma once
// Where light goes at a smooth surface: reflected, and through.

#include "phase/base/spectrum.h"
#include "phase/base/vec3.h"
#include "src/material/polarised_ray.h"

namespace arcus::render {

/// One of the two ways.
struct Turn {
  Vec3 direction{0, 0, 0};   ///< unit
  Spectrum share;            ///< of the light, by wavelength; zero where there is no such way
  PolarisedRay polarised;

  bool is_there() const { return share.max() > 0; }
};

struct Turns {
  Turn reflected, transmitted;
};

/// Light that arrives along `incoming` at a surface whose unit normal is on the side that it comes from: mirrored direction.
inline Vec3 mirrored(const Vec3& incoming, const Vec3& normal) {
  return normalize(incoming - normal * (2 * dot(incoming, normal)));
}
/// And the direction beyond a surface to where the index is `relative_index` times as large (Snell); only below total reflection.
Vec3 refracted(const Vec3& incoming, const Vec3& normal, double relative_index);

/// A perfect interface between two transparent bodies (Fresnel), with polarisation: the two shares add up to 1.
Turns fresnel_turns(const Vec3& incoming, const Vec3& normal, double relative_index, const PolarisedRay& light);

/// A mirror that reflects both polarisations alike, as a perfect conductor does.
Turns mirror_turns(const Vec3& incoming, const Vec3& normal, const Spectrum& reflectance, const PolarisedRay& light);

/// Simple transparency: shares that do not depend on the angle, all reflected where nothing can pass. K. Suffern, Ray Tracing from the
/// Ground Up (2007), chapter 27.
Turns transparent_turns(const Vec3& incoming, const Vec3& normal, double relative_index, double reflectance, double transmittance);

}  // namespace arcus::render
