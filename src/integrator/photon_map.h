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
#include "src/integrator/photon_passes.h"
#include "src/scene/scene.h"
#include "src/scene/settings.h"

namespace arcus::render {

class PhotonMap : public Integrator {
 public:
  /// Sends the photons, on all cores. The scene must outlive it. Throws bad_input where photons fit the scene ill, or where none lands.
  PhotonMap(const Scene& scene, const RenderSettings& settings);
  /// Of photons that are there, sent as `sending` says.
  PhotonMap(const Scene& scene, const PhotonSending& sending, std::vector<PhotonPass> passes);

  Spectrum radiance(const media::Ray& camera_ray, const Wavelengths& wavelengths, const FirstNumbers& first, Random& random,
                    Work& work) const override;

  const std::vector<PhotonPass>& passes() const { return passes_; }

 private:
  struct Path;
  struct Sample;
  PhotonMap(const Scene& scene, const PhotonSending& sending);
  bool pass(Path& path, Sample& sample) const;
  bool meet(Path& path, const Hit& hit, Sample& sample) const;
  bool scatter(Path& path, const media::Collision& collision, Sample& sample) const;

  const Scene& scene_;
  long long max_bounces_;
  bool final_gather_, has_sky_;
  Ball region_;  ///< where photons land
  std::vector<PhotonPass> passes_;
};

}  // namespace arcus::render
