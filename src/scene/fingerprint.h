#pragma once
// What decides the pixels of a picture: the scene's text and the content of every file that it names.

#include <string>

#include "src/scene/settings.h"

namespace arcus::render {

/// A hash; equal ones make equal pictures with the same version of the program. Throws bad_input where a file cannot be read.
std::string scene_fingerprint(const SceneSettings& settings);

}  // namespace arcus::render
