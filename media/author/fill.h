#pragma once
// From a function of the place to the bricks of a species, on all cores.

#include <functional>

#include "media/grid/new_grid.h"

namespace arcus::media {

/// What there is in a voxel; nothing where extinction_per_m is 0.
struct FilledVoxel {
  double extinction_per_m = 0;
  double size_um = 0;
};

/// Fills species.extinction and species.size with all bricks that are not empty; the result does not depend on the number of threads.
/// voxels: where to ask. Throws bad_input where there are more than 2·10⁹ of them; `key` names the setting to change.
void fill(const IndexBox& voxels, const std::function<FilledVoxel(const Coord&)>& value, const std::string& key, NewSpecies& species);

/// What came of it.
struct FilledRange {
  float largest_extinction_per_m = 0;
  float smallest_size_um = 0, largest_size_um = 0;  ///< of the voxels that are not empty; 0 where all are
  double extinction_times_size = 0;                 ///< sum over the voxels [µm/m]: the liquid water goes as it
};
FilledRange range_of(const NewSpecies& species);

}  // namespace arcus::media
