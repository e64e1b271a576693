#pragma once
// Ray casting: the first surface alone, in sunlight without shadows. Mirrors and clear bodies show the sky and the sun in the directions of their
// two branches, as if nothing else were there. A quick look at a scene's geometry, and the least that a comparison of intersectors needs.

#include "src/integrator/integrator.h"
#include "src/scene/scene.h"

namespace arcus::render {

class RayCast : public Integrator {
 public:
  explicit RayCast(const Scene& scene) : scene_(scene) {}
  Spectrum radiance(const media::Ray& camera_ray, const Wavelengths& wavelengths, const FirstNumbers& first, Random& random,
                    Work& work) const override;

 private:
  const Scene& scene_;
};

}  // namespace arcus::render
