#pragma once
// One tile of a picture, rendered into its folder; goes on from what an earlier run has left.

#include <functional>
#include <string>
#include <string_view>

#include "src/render/render.h"
#include "src/render/tile_job.h"

namespace arcus::render {

/// Renders a tile of a job and writes it, whole or not at all; a checkpoint every RunOptions::checkpoint_s and when stopped, from which
/// the next run goes on to the same bits. The integrator is the scene's (tile_integrator.h). Several runs on one tile do no harm: each writes
/// all of it. `say` is told of a checkpoint that is damaged and not used. Throws cannot() where something cannot be written.
RunResult render_tile(const SceneSettings& settings, const Scene& scene, const Integrator& integrator, const TileJob& job, const std::string& folder,
                      long long tile, RunOptions options, const std::function<void(std::string_view)>& say);

}  // namespace arcus::render
