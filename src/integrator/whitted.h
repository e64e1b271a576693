#pragma once
// The ray tracer of T. Whitted, "An Improved Illumination Model for Shaded Display", Communications of the ACM 23(6), 1980: a tree of reflected
// and transmitted rays to a given depth, shadow rays to the sun from matte surfaces, no light between matte surfaces. The sky lights a matte
// surface as bright as it is straight over it, whatever stands between. Branches that would bring less than a ten-thousandth are not followed (R.
// Hall and D. Greenberg, IEEE Computer Graphics and Applications 3(8), 1983). Biased by what it leaves out.

#include "src/integrator/integrator.h"
#include "src/scene/scene.h"

namespace arcus::render {

class Whitted : public Integrator {
 public:
  /// max_depth: surfaces one behind the other along a branch; 0 shows the sky alone.
  Whitted(const Scene& scene, long long max_depth) : scene_(scene), max_depth_(max_depth) {}
  Spectrum radiance(const media::Ray& camera_ray, const Wavelengths& wavelengths, const FirstNumbers& first, Random& random,
                    Work& work) const override;

 private:
  struct Branch;
  void follow(const Branch& branch, const Wavelengths& wavelengths, Random& random, Work& work, Spectrum& total) const;

  const Scene& scene_;
  long long max_depth_;
};

}  // namespace arcus::render
