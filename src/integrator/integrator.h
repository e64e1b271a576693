#pragma once
// How light is followed: what every integrator answers. One is made by its name in the scene (src/integrator/make_integrator.h).

#include "media/space/ray.h"
#include "phase/base/random.h"
#include "phase/base/spectrum.h"
#include "phase/base/wavelengths.h"
#include "src/integrator/sample_points.h"

namespace arcus::render {

/// What estimates took, counted.
struct Work {
  long long scatterings = 0;            ///< in media
  long long tentative_collisions = 0;   ///< of paths, real ones included; not those of rays to sun and sky
  long long sun_rays = 0;               ///< to the sun, and to a sky that is asked, from points in media and on surfaces
  long long surface_hits = 0;           ///< of paths

  Work& operator+=(const Work& other) {
    scatterings += other.scatterings;
    tentative_collisions += other.tentative_collisions;
    sun_rays += other.sun_rays;
    surface_hits += other.surface_hits;
    return *this;
  }
};

class Integrator {
 public:
  virtual ~Integrator() = default;
  /// An estimate of the radiance that arrives along the ray against its direction [W m-2 sr-1 nm-1]. Adds to `work` what it took.
  /// May be called from many threads at once; depends on nothing but its arguments.
  virtual Spectrum radiance(const media::Ray& camera_ray, const Wavelengths& wavelengths, const FirstNumbers& first, Random& random,
                            Work& work) const = 0;
};

}  // namespace arcus::render
