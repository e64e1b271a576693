#include "src/farm/pilot.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <thread>

#include "src/render/picture.h"
#include "src/scene/build_scene.h"
#include "src/scene/fingerprint.h"

namespace arcus::farm {
namespace {

constexpr double pilot_seconds = 3, pilot_pixels = 8000;
/// Where building a scene takes longer, tables may have been made that no worker makes again.
constexpr double long_start_seconds = 2;

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

Pilot run_pilot(const render::SceneSettings& settings, const std::string& cache_folder, const std::function<void(std::string_view)>& say) {
  render::SceneSettings small = settings;
  render::CameraSettings& camera = small.camera;
  const double scale = std::min(1.0, std::sqrt(pilot_pixels / (static_cast<double>(camera.width_px) * camera.height_px)));
  camera.width_px = std::max(1, static_cast<int>(std::lround(camera.width_px * scale)));
  camera.height_px = std::max(1, static_cast<int>(std::lround(camera.height_px * scale)));
  render::BuildOptions build;
  build.cache_folder = cache_folder;
  build.log = say;
  Pilot pilot;
  const auto start = [&] {
    const auto begin = std::chrono::steady_clock::now();
    render::scene_identity(small);  // each worker reads all inputs for their hashes
    render::Scene scene = render::build_scene(small, build);
    pilot.start_seconds = seconds_since(begin);
    return scene;
  };
  std::optional<render::Scene> built(start());
  if (pilot.start_seconds > long_start_seconds) {
    built.reset();
    built.emplace(start());
  }
  const render::Scene& scene = *built;
  // Whole passes alone say what the mean over the picture is; the first one is never cut short. What an integrator makes before is part of the start.
  small.render.samples_per_pixel = 1;
  const auto begin_integrator = std::chrono::steady_clock::now();
  const auto integrator = render::prepare_integrator(scene, small.render, {});
  pilot.start_seconds += seconds_since(begin_integrator);
  double samples = 0, seconds = 0;
  const double threads = std::max(1u, std::thread::hardware_concurrency());
  while (seconds < pilot_seconds) {
    render::Film film(camera.width_px, camera.height_px, {0, 0, camera.width_px, camera.height_px}, small.film, render::ToRgb());
    const render::RunResult run = render::render(scene, *integrator, small.render, {}, film);
    samples += run.progress.samples_done;
    seconds += run.progress.seconds;
    ++small.render.seed;
  }
  pilot.thread_seconds_a_sample = seconds * threads / samples;
  return pilot;
}

}  // namespace arcus::farm
