#pragma once
// What answers for the rays of a job's tiles, made once for all that a process renders.

#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "src/render/render.h"
#include "src/render/tile_job.h"

namespace arcus::render {

/// The photons of a photon map are sent by all workers of the job together (photon_folder.h); other integrators are made as for render().
/// Workers that begin at different tiles begin with different photons. `say` is told what is done. Nothing where RunOptions::stop_request
/// becomes non-zero before it is there. Throws Fault::mismatch where photons of another job are in the folder, cannot() where something
/// cannot be written.
std::unique_ptr<const Integrator> make_tile_integrator(const SceneSettings& settings, const Scene& scene, const TileJob& job, const std::string& folder,
                                                       long long first_tile, const RunOptions& options, const std::function<void(std::string_view)>& say);

}  // namespace arcus::render
