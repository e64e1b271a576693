#include "src/render/render_tile.h"

#include <chrono>
#include <filesystem>

#include "phase/base/error.h"
#include "src/render/picture.h"
#include "src/render/tile.h"
#include "src/render/tile_folder.h"

namespace arcus::render {
namespace {

/// What an earlier run has left, read into the film; gives its seconds of rendering.
double resume(const std::string& checkpoint, const TileJob& job, Film& film, const std::function<void(std::string_view)>& say) {
  if (!std::filesystem::exists(checkpoint)) return 0;
  try {
    return read_tile(checkpoint, job, film);
  } catch (const Error& error) {
    // Nothing but time is lost; and another worker may have finished the tile and removed its checkpoint just now.
    say(std::string(error.what()) + "; the tile begins anew");
    return 0;
  }
}

}  // namespace

RunResult render_tile(const SceneSettings& settings, const Scene& scene, const Integrator& integrator, const TileJob& job, const std::string& folder,
                      long long tile, RunOptions options, const std::function<void(std::string_view)>& say) {
  using Clock = std::chrono::steady_clock;
  const std::string path = tile_path(folder, job.tiles, tile), checkpoint = checkpoint_path(folder, job.tiles, tile);
  Film film(job.width_px, job.height_px, tile_box(job.width_px, job.height_px, job.tiles, tile), settings.film, to_rgb_of(settings, job.sun));
  const double seconds_before = resume(checkpoint, job, film, say);
  const auto begin = Clock::now();
  const auto seconds = [&] { return seconds_before + std::chrono::duration<double>(Clock::now() - begin).count(); };
  options.checkpoint = [&](const Film& now) { write_tile(checkpoint, now, job, tile, seconds()); };
  const RunResult run = render(scene, integrator, settings.render, options, film);
  if (!run.is_complete) return run;
  write_tile(path, film, job, tile, seconds());
  std::filesystem::remove(checkpoint);
  return run;
}

}  // namespace arcus::render
