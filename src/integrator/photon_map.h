#pragma once
// Photon mapping (H. W. Jensen 1996, 2001): light is sent from the sun first and kept where it lands; then paths from the eye ask what lies around
// them. Caustics are looked up where they are seen; other light from matte to matte, and light scattered more than once in media, is looked up one
// bounce away (final gathering). The sun is asked and the sky is found as in the path tracer.
//
// Biased: what is looked up is blurred over the circle or ball of the nearest photons. Several passes with fewer and fewer neighbours, averaged,
// bring bias and noise to nothing together (T. Hachisuka, S. Ogaki and H. W. Jensen, "Progressive Photon Mapping", SIGGRAPH Asia 2008; C. Knaus
// and M. Zwicker, ACM Transactions on Graphics 30(3), 2011).

#include <vector>

#include "src/integrator/integrator.h"
#include "src/integrator/photon_tracer.h"
#include "src/photon/photon_store.h"
#include "src/photon/relaxation.h"
#include "src/scene/scene.h"
#include "src/scene/settings.h"

namespace arcus::render {

class PhotonMap : public Integrator {
 public:
  /// Sends the photons, on all cores. The scene must outlive it. Throws bad_input where photons fit the scene ill, or where none lands.
  PhotonMap(const Scene& scene, const RenderSettings& settings);

  Spectrum radiance(const media::Ray& camera_ray, const Wavelengths& wavelengths, const FirstNumbers& first, Random& random,
                    Work& work) const override;

  /// One pass: light straight from smooth surfaces, and all of it (without final gathering: what is neither that nor straight from the sun).
  struct Pass {
    PhotonStore caustic_on_surfaces, caustic_in_media, on_surfaces, in_media;
    int neighbours;
    Relaxed relaxed;  ///< of caustic_on_surfaces
  };
  const std::vector<Pass>& passes() const { return passes_; }

 private:
  struct Path;
  struct Sample;
  bool pass(Path& path, Sample& sample) const;
  bool meet(Path& path, const Hit& hit, Sample& sample) const;
  bool scatter(Path& path, const media::Collision& collision, Sample& sample) const;

  const Scene& scene_;
  long long max_bounces_;
  bool final_gather_, has_sky_;
  PhotonTracer tracer_;
  std::vector<Pass> passes_;
};

/// Neighbours in pass i = 0, 1, 2, ...: their number falls as the squared radius r²_{i+1} = r²_i (i + α) / (i + 1), α = 2/3.
int neighbours_in_pass(int first, int pass);

}  // namespace arcus::render
