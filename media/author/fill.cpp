#include "media/author/fill.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>

#include "phase/base/error.h"
#include "phase/settings/number_text.h"

namespace arcus::media {
namespace {

constexpr double most_voxels = 2e9;
constexpr int edge = SparseGrid::brick_edge;
// Bricks made at a time, so that empty ones take no memory for long.
constexpr std::size_t batch = 4096;

int brick_of(int voxel) { return (voxel >= 0 ? voxel : voxel - edge + 1) / edge; }

}  // namespace

void fill(const IndexBox& voxels, const std::function<FilledVoxel(const Coord&)>& value, const std::string& key, NewSpecies& species) {
  const double count = static_cast<double>(voxels.size(0)) * static_cast<double>(voxels.size(1)) * static_cast<double>(voxels.size(2));
  if (count > most_voxels)
    throw bad_input(key, number_text(static_cast<double>(voxels.size(0))) + " x " + number_text(static_cast<double>(voxels.size(1))) +
                             " x " + number_text(static_cast<double>(voxels.size(2))) + " voxels", "at most 2e9 expected");
  std::vector<Coord> origins;
  for (int x = brick_of(voxels.low.x); x <= brick_of(voxels.high.x); ++x)
    for (int y = brick_of(voxels.low.y); y <= brick_of(voxels.high.y); ++y)
      for (int z = brick_of(voxels.low.z); z <= brick_of(voxels.high.z); ++z) origins.push_back({x * edge, y * edge, z * edge});
  struct Work {
    NewBrick extinction, size;
    bool is_empty = true;
  };
  for (std::size_t first = 0; first < origins.size(); first += batch) {
    std::vector<Work> works(std::min(batch, origins.size() - first));
    tbb::parallel_for(std::size_t{0}, works.size(), [&](std::size_t b) {
      Work& work = works[b];
      const Coord origin = origins[first + b];
      work.extinction = {origin, {}};
      work.size = {origin, {}};
      for (std::size_t i = 0; i < SparseGrid::brick_voxels; ++i) {
        const auto n = static_cast<int>(i);
        const Coord at{origin.x + (n >> 6), origin.y + (n >> 3 & 7), origin.z + (n & 7)};
        if (!voxels.contains(at)) continue;
        const FilledVoxel voxel = value(at);
        if (!(voxel.extinction_per_m > 0)) continue;
        work.extinction.values[i] = static_cast<float>(voxel.extinction_per_m);
        work.size.values[i] = static_cast<float>(voxel.size_um);
        work.is_empty = false;
      }
    });
    for (const Work& work : works) {
      if (work.is_empty) continue;
      species.extinction.push_back(work.extinction);
      species.size.push_back(work.size);
    }
  }
}

FilledRange range_of(const NewSpecies& species) {
  FilledRange range;
  float smallest = std::numeric_limits<float>::max();
  for (std::size_t b = 0; b < species.size.size(); ++b)
    for (std::size_t i = 0; i < SparseGrid::brick_voxels; ++i) {
      const float extinction = species.extinction[b].values[i], size = species.size[b].values[i];
      if (extinction == 0) continue;
      range.largest_extinction_per_m = std::max(range.largest_extinction_per_m, extinction);
      smallest = std::min(smallest, size);
      range.largest_size_um = std::max(range.largest_size_um, size);
      range.extinction_times_size += static_cast<double>(extinction) * size;
    }
  if (range.largest_size_um > 0) range.smallest_size_um = smallest;
  return range;
}

}  // namespace arcus::media
