#include "src/render/tile_integrator.h"

#include "src/integrator/photon_map.h"
#include "src/render/photon_folder.h"
#include "src/render/threads.h"

namespace arcus::render {
namespace {

std::unique_ptr<const Integrator> make_photon_map(const SceneSettings& settings, const Scene& scene, const TileJob& job, const std::string& folder,
                                                  long long first_tile, const std::atomic<int>* stop_request, const std::function<void(std::string_view)>& say) {
  const PhotonSending sending(scene, settings.render);
  PhotonFolder photons(folder, job, sending, stop_request, say);
  if (!photons.share(static_cast<double>(first_tile) / static_cast<double>(job.tiles))) return nullptr;
  auto passes = gather_passes(sending, photons);
  if (!passes) return nullptr;
  return std::make_unique<PhotonMap>(scene, sending, std::move(*passes));
}

}  // namespace

std::unique_ptr<const Integrator> make_tile_integrator(const SceneSettings& settings, const Scene& scene, const TileJob& job, const std::string& folder,
                                                       long long first_tile, const RunOptions& options, const std::function<void(std::string_view)>& say) {
  if (settings.render.integrator != "photon_map") return prepare_integrator(scene, settings.render, options);
  std::unique_ptr<const Integrator> integrator;
  on_threads(options.threads, [&] { integrator = make_photon_map(settings, scene, job, folder, first_tile, options.stop_request, say); });
  return integrator;
}

}  // namespace arcus::render
