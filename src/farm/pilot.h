#pragma once
// A few seconds of a scene, to know what all of it will take.

#include <functional>
#include <string>
#include <string_view>

#include "src/scene/settings.h"

namespace arcus::farm {

struct Pilot {
  double start_seconds = 0;             ///< reading the media, and making the tables that were not in the cache
  double thread_seconds_a_sample = 0;   ///< rendering, on one thread; mean over the picture
};

/// Builds the scene, which leaves its phase tables in the cache for all workers, and renders it small for a few seconds. Throws what
/// building a scene throws: a file that is missing is found here and not by a thousand workers.
Pilot run_pilot(const render::SceneSettings& settings, const std::string& cache_folder, const std::function<void(std::string_view)>& say);

}  // namespace arcus::farm
