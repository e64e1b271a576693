#pragma once
// What a .vdb file holds, for people and programs: nothing is refused that OpenVDB can read.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "media/space/affine.h"
#include "media/space/box.h"
#include "media/space/index.h"

namespace arcus::media {

/// Of the active voxels of a float or double grid.
struct ValueFacts {
  double smallest = 0, largest = 0, mean = 0;
  std::uint64_t not_finite = 0;  ///< NaN or infinite; left out above
  /// Along each index axis, over the columns of the active box: integral of the value over metres, which is the optical
  /// depth where the value is an extinction in 1/m. Nothing where the box has more than 2²⁶ columns or the transform is not affine.
  struct Depth {
    double mean = 0, largest = 0;
  };
  std::optional<std::array<Depth, 3>> depth;
};

struct GridFacts {
  std::string label;       ///< the name, or name[index] where several grids share it
  std::string type;        ///< "float", "double", "vec3s", "bool", "points", ...
  std::string class_words; ///< "fog volume", "level set", "staggered" or "no class"
  bool saved_as_half = false;
  bool is_readable = true; ///< false: a type unknown to OpenVDB, nothing below is known
  std::uint64_t active_voxels = 0;
  IndexBox active_box;
  std::uint64_t memory_bytes = 0;  ///< of OpenVDB's tree
  bool is_affine = true;           ///< false: a frustum; the next three are without meaning
  Affine world_from_index;
  Vec3 voxel_m{0, 0, 0};           ///< lengths of a voxel's edges
  Box bounds_m;                    ///< of the active voxels' outer faces
  std::optional<ValueFacts> values;
  std::vector<std::pair<std::string, std::string>> metadata;  ///< as text, in alphabetical order
};

/// All grids of a file, in its order. Reads everything. Throws bad_input where the file is missing, damaged or not OpenVDB's.
std::vector<GridFacts> describe_vdb(const std::string& path);

}  // namespace arcus::media
