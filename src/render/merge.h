#pragma once
// Tiles become the picture that one process would have made, bit for bit, or a message that says which of them it lacks.
//
// The picture is never in memory: rows of tiles are read and joined on all cores and written while the next ones are read.

#include <atomic>
#include <string>
#include <vector>

namespace arcus::render {

struct MergeOptions {
  bool allow_partial = false;  ///< tiles half-way count with what they have; the rest stays black
  bool repair = false;         ///< deletes damaged tiles, so that they are made again
  const std::atomic<int>* stop_request = nullptr;  ///< merging ends soon after it becomes non-zero
};

struct Merge {
  bool is_complete = true;          ///< false: stopped; nothing is written
  double refused = 0;               ///< samples that were not finite and are left out
  std::vector<long long> left_out;  ///< tiles that are not whole; empty without allow_partial
};

/// Verifies every byte of every tile, that they belong together and that they cover the picture, and writes it: an EXR with the channels
/// and metadata of one process, but that its render seconds are those of all tiles together, and the PNG beside it unless `png` is
/// empty. Throws Fault::mismatch where a file belongs to something else, otherwise Fault::incomplete where tiles are missing or damaged;
/// each lists all of them, and no file is written. Holds up to 512 MiB of the picture's rows at a time, one row of tiles at least, and a
/// tile for each core.
Merge merge_tiles(const std::string& folder, const std::string& exr, const std::string& png, const MergeOptions& options);

}  // namespace arcus::render
