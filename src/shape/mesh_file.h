#pragma once
// Reads triangles from files of other programs.

#include <string>
#include <vector>

#include "src/shape/pieces.h"

namespace arcus::render {

/// All faces of a PLY or OBJ file, cut into triangles, in the file's own coordinates; faces without area are left out. Throws bad_input,
/// beginning with `where`: no such file, unreadable, no face, corners that are not finite.
std::vector<Triangle> read_mesh(const std::string& path, const std::string& where);

}  // namespace arcus::render
