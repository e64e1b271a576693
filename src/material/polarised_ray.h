#pragma once
// How a path's light is polarised: Stokes parameters with the axis that they refer to.
//
// A path is traced from the eye, against the light. The eye asks for the power alone, as if it sent out natural light; what of it
// arrives at a natural source after any number of interfaces is the same as the other way round (reciprocity), so the path is followed
// as light that the eye sends.

#include "phase/base/frame.h"
#include "phase/base/vec3.h"
#include "phase/optics/stokes.h"

namespace arcus::render {

struct PolarisedRay {
  phase::Stokes light;         ///< i = 1: the power is kept by the path's weight
  Vec3 perpendicular{0, 0, 0}; ///< unit, across the ray: the axis e_perpendicular; zero while the light is natural

  bool is_natural() const { return light.q == 0 && light.u == 0 && light.v == 0; }
  /// After what leaves natural light behind: matte surfaces, and scattering, whose polarisation is not followed.
  void depolarise() { *this = PolarisedRay{}; }
  /// The light with respect to another axis across the ray.
  phase::Stokes about(const Vec3& direction, const Vec3& axis) const {
    if (is_natural()) return light;
    return phase::turned(light, dot(perpendicular, axis), dot(cross(direction, perpendicular), axis));
  }
};

}  // namespace arcus::render
