#pragma once
// Tiles become the picture that one process would have made, bit for bit, or a message that says which of them it lacks.

#include <string>
#include <vector>

#include "src/film/image.h"
#include "src/film/tone.h"

namespace arcus::render {

struct MergeOptions {
  bool allow_partial = false;  ///< tiles half-way count with what they have; the rest stays black
  bool repair = false;         ///< deletes damaged tiles, so that they are made again
};

struct Merge {
  Image image;  ///< with the channels and metadata of one process; render seconds are those of all tiles together
  ToneSettings tone;
  double refused = 0;               ///< samples that were not finite and are left out
  std::vector<long long> left_out;  ///< tiles that are not whole; empty without allow_partial
};

/// Verifies every byte of every tile, that they belong together and that they cover the picture, and joins them. Holds the picture
/// and one tile. Throws Fault::mismatch where a file belongs to something else, otherwise Fault::incomplete where tiles are missing or
/// damaged; each lists all of them.
Merge merge_tiles(const std::string& folder, const MergeOptions& options);

}  // namespace arcus::render
