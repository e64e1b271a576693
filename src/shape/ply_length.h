#pragma once
// Whether a PLY file is as long as its header says: assimp, which reads it, goes on for ever in binary files that are cut off, and makes up the
// corners that text files lack. The format: G. Turk, "The PLY Polygon File Format", 1994.

#include <string>

namespace arcus::render {

/// Throws bad_input, naming `where`: no PLY file, a header without end or with unknown words, less data than it promises.
void check_ply_length(const std::string& path, const std::string& where);

}  // namespace arcus::render
