// One lookup of extinction and size in a shower: the renderer's bricks against NanoVDB, at random points and along rays.
// Needs the headers of NanoVDB (Debian: libnanovdb-dev); nothing else in the project does.

#include <benchmark/benchmark.h>
#include <nanovdb/util/OpenToNanoVDB.h>
#include <openvdb/openvdb.h>

#include "media/author/rain.h"
#include "phase/base/random.h"

namespace arcus::media {
namespace {

openvdb::FloatGrid::Ptr open_grid(const std::vector<NewBrick>& bricks) {
  auto grid = openvdb::FloatGrid::create();
  auto accessor = grid->getAccessor();
  for (const NewBrick& brick : bricks)
    for (int i = 0; i < SparseGrid::brick_voxels; ++i)
      if (const float value = brick.values[static_cast<std::size_t>(i)]; value != 0)
        accessor.setValue({brick.origin.x + (i >> 6), brick.origin.y + (i >> 3 & 7), brick.origin.z + (i & 7)}, value);
  return grid;
}

struct Shower {
  SparseGrid bricks;
  nanovdb::GridHandle<nanovdb::HostBuffer> extinction, size;
  std::vector<Coord> random_places, places_along_rays;
  Shower() {
    openvdb::initialize();
    const NewSpecies rain = author_rain({}).species;
    bricks = sparse_grid_of(rain);
    extinction = nanovdb::openToNanoVDB(open_grid(rain.extinction));
    size = nanovdb::openToNanoVDB(open_grid(rain.size));
    const IndexBox box = bricks.voxels();
    Random random(1, 2, 3);
    const auto between = [&](int low, int high) { return low + static_cast<int>(random.uniform_double() * (high - low)); };
    const auto anywhere = [&] { return Coord{between(box.low.x, box.high.x), between(box.low.y, box.high.y), between(box.low.z, box.high.z)}; };
    for (int i = 0; i < 1 << 16; ++i) random_places.push_back(anywhere());
    while (places_along_rays.size() < 1 << 16) {  // sixteen voxels apart on average, as tentative collisions are
      const Coord a = anywhere(), b = anywhere();
      const int steps = std::max(1, std::abs(a.x - b.x) / 16);
      for (int i = 0; i < steps; ++i)
        places_along_rays.push_back({a.x + (b.x - a.x) * i / steps, a.y + (b.y - a.y) * i / steps, a.z + (b.z - a.z) * i / steps});
    }
  }
};

const Shower& shower() {
  static const Shower one;
  return one;
}

template <class Lookup>
void look_up(benchmark::State& state, const std::vector<Coord>& places, const Lookup& lookup) {
  std::size_t i = 0;
  float sum = 0;
  for (auto _ : state) sum += lookup(places[i++ & 0xffff]);
  benchmark::DoNotOptimize(sum);
}

const std::vector<Coord>& places(bool along_rays) { return along_rays ? shower().places_along_rays : shower().random_places; }

void own_bricks(benchmark::State& state, bool along_rays) {
  const SparseGrid& grid = shower().bricks;
  look_up(state, places(along_rays), [&](const Coord& c) {
    const float* voxel = grid.address(c.x, c.y, c.z);
    return voxel[0] + voxel[1];
  });
  state.counters["MB"] = static_cast<double>(grid.memory_bytes()) * 1e-6;
}

void nano_vdb(benchmark::State& state, bool along_rays) {
  const auto first = shower().extinction.grid<float>()->getAccessor(), second = shower().size.grid<float>()->getAccessor();
  look_up(state, places(along_rays), [&](const Coord& c) {
    const nanovdb::Coord at(c.x, c.y, c.z);
    return first.getValue(at) + second.getValue(at);
  });
  state.counters["MB"] = static_cast<double>(shower().extinction.size() + shower().size.size()) * 1e-6;
}

BENCHMARK_CAPTURE(own_bricks, random, false);
BENCHMARK_CAPTURE(nano_vdb, random, false);
BENCHMARK_CAPTURE(own_bricks, along_rays, true);
BENCHMARK_CAPTURE(nano_vdb, along_rays, true);

}  // namespace
}  // namespace arcus::media
