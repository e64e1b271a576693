#include "src/integrator/make_integrator.h"

#include "phase/base/error.h"
#include "src/integrator/path_tracer.h"
#include "src/integrator/photon_map.h"
#include "src/integrator/ray_cast.h"
#include "src/integrator/volume_path.h"
#include "src/integrator/whitted.h"

namespace arcus::render {

namespace {

std::unique_ptr<const Integrator> make_photon_map(const Scene& scene, const RenderSettings& settings, const std::atomic<int>* stop_request) {
  const PhotonSending sending(scene, settings);
  PhotonsSentHere source(sending, stop_request);
  auto passes = gather_passes(sending, source);
  if (!passes) return nullptr;
  return std::make_unique<PhotonMap>(scene, sending, std::move(*passes));
}

}  // namespace

std::unique_ptr<const Integrator> make_integrator(const Scene& scene, const RenderSettings& settings, const std::atomic<int>* stop_request) {
  if (settings.integrator == "volume_path") return std::make_unique<VolumePath>(scene, settings.max_bounces);
  if (scene.air) throw bad_input("render.integrator", "'" + settings.integrator + "' and a clear sky", "'volume_path' expected: the others know no air");
  if (settings.integrator != "path" && scene.surfaces.has_sea())
    throw bad_input("render.integrator", "'" + settings.integrator + "' and a surface of type 'sea'",
                    "'volume_path' or 'path' expected: the others know no waves");
  if (settings.integrator == "photon_map") return make_photon_map(scene, settings, stop_request);
  if (!scene.medium->is_empty())
    throw bad_input("render.integrator", "'" + settings.integrator + "' and a medium", "'volume_path' or 'photon_map' expected: the others see surfaces alone");
  if (settings.integrator == "path") return std::make_unique<PathTracer>(scene, settings.max_bounces);
  if (settings.integrator == "whitted") return std::make_unique<Whitted>(scene, settings.max_bounces);
  return std::make_unique<RayCast>(scene);
}

}  // namespace arcus::render
