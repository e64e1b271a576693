#pragma once
// Settings to scene: reads the VDB files, makes the phase functions, builds the majorants.

#include <functional>
#include <string>
#include <string_view>

#include "src/scene/scene.h"
#include "src/scene/settings.h"

namespace arcus::render {

struct BuildOptions {
  std::string cache_folder;                        ///< of phase tables; empty: they are not kept
  std::function<void(std::string_view)> log;       ///< told what takes time and what is doubtful
};

/// Throws bad_input where a file is missing, damaged or not what the settings say.
Scene build_scene(const SceneSettings& settings, const BuildOptions& options);

}  // namespace arcus::render
