#pragma once
// Renders a scene into a film: blocks of pixels on all cores, in passes over the whole picture, so that it may be
// stopped at any time. The numbers of a sample depend on seed, pixel and sample alone and the samples of a pixel are
// added in their order, so the bits are the same for any number of threads.

#include <atomic>
#include <functional>
#include <memory>

#include "src/film/film.h"
#include "src/integrator/integrator.h"
#include "src/scene/scene.h"
#include "src/scene/settings.h"

namespace arcus::render {

/// How far a rendering is.
struct Progress {
  double seconds = 0;           ///< since the beginning of this run
  double samples_before = 0;    ///< paths that the film had from an earlier run
  double samples_done = 0;      ///< paths, with those
  double samples_in_all = 0;    ///< paths
  double samples_per_second() const { return seconds > 0 ? (samples_done - samples_before) / seconds : 0; }
  double seconds_left() const {
    const double rate = samples_per_second();
    return rate > 0 ? (samples_in_all - samples_done) / rate : 0;
  }
};

/// How to run, none of which changes a pixel that is finished.
struct RunOptions {
  int threads = 0;             ///< 0: as many as there are cores
  double time_limit_s = 0;     ///< 0: none
  const std::atomic<int>* stop_request = nullptr;      ///< rendering ends soon after it becomes non-zero
  std::function<void(const Progress&)> report;         ///< called about five times a second from another thread
  /// Called every so many seconds, and at the end of a run that is stopped, while nothing is added to the film.
  std::function<void(const Film&)> checkpoint;
  double checkpoint_s = 60;
};

/// What came of it.
struct RunResult {
  bool is_complete = true;  ///< false: stopped or out of time; the film holds what is done
  Work work;                ///< of this run
  Progress progress;
};

/// The scene's integrator, made on RunOptions::threads; nothing where RunOptions::stop_request becomes non-zero before it is there.
std::unique_ptr<const Integrator> prepare_integrator(const Scene& scene, const RenderSettings& settings, const RunOptions& options);

/// Renders the film's pixels; goes on where the film is not empty.
RunResult render(const Scene& scene, const Integrator& integrator, const RenderSettings& settings, const RunOptions& options, Film& film);

/// The same, with the integrator made before; its time counts.
RunResult render(const Scene& scene, const RenderSettings& settings, const RunOptions& options, Film& film);

}  // namespace arcus::render
