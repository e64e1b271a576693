#pragma once
// The path tracer of surfaces alone (J. Kajiya, "The Rendering Equation", SIGGRAPH 1986): one path a sample, from the eye, until it
// meets a light, its depth or roulette's end. At mirrors and clear bodies it splits, and follows both ways while they matter. Matte surfaces ask the sun besides, both ways weighted by the balance heuristic (E. Veach and
// L. Guibas, SIGGRAPH 1995). Sunlight through mirrors and clear bodies is found only by paths that meet the sun's disc: the wider the disc,
// the quieter the picture. Unbiased; four wavelengths a path, one alone after a surface that parts them.

#include "src/integrator/integrator.h"
#include "src/scene/scene.h"

namespace arcus::render {

class PathTracer : public Integrator {
 public:
  PathTracer(const Scene& scene, long long max_bounces) : scene_(scene), max_bounces_(max_bounces) {}
  Spectrum radiance(const media::Ray& camera_ray, const Wavelengths& wavelengths, const FirstNumbers& first, Random& random,
                    Work& work) const override;

 private:
  const Scene& scene_;
  long long max_bounces_;
};

}  // namespace arcus::render
