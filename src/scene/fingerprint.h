#pragma once
// What decides the pixels of a picture: the scene's text and the content of every file that it names.

#include <string>
#include <vector>

#include "src/scene/settings.h"

namespace arcus::render {

/// A file that a scene names, or a recipe in it with the files that it names.
struct SceneInput {
  std::string name;  ///< as in the scene
  std::string hash;  ///< of the content
};

struct SceneIdentity {
  /// Equal ones make equal pixels with the same version of the program. What a file is called, and what the PNG makes of the picture, change none.
  std::string hash;
  std::vector<SceneInput> inputs;  ///< in the order of the scene; each once
};

/// Throws bad_input where a file cannot be read.
SceneIdentity scene_identity(const SceneSettings& settings);

/// The hash alone.
std::string scene_fingerprint(const SceneSettings& settings);

}  // namespace arcus::render
