// Speed of light through ice crystals.
//
//   cmake --build --preset release --target crystal_benchmark
//   build/release/tests/crystal_benchmark
//
// "entering" counts rays that meet a crystal, "exits" directions with a weight, both a second and
// of all threads together. Splitting follows eight faces met from inside.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <vector>

#include "phase/base/frame.h"
#include "phase/crystal/crystal_habit.h"
#include "phase/crystal/crystal_packets.h"
#include "phase/crystal/crystal_rays.h"
#include "phase/crystal/orientations.h"
#include "phase/optics/refractive_index.h"
#include "phase/population/tabulate_crystals.h"

namespace arcus::phase {
namespace {

constexpr double index = 1.311;
constexpr int rays = 256, events = 8;

const CrystalShape& habit(const char* name) {
  static const CrystalShape plate = make_crystal({.aspect_ratio = 0.15}, 100);
  static const CrystalShape column = make_crystal({.aspect_ratio = 2}, 100);
  static const CrystalShape pyramid =
      make_crystal({.aspect_ratio = 0.5, .upper = {.height = 0.6}, .lower = {.height = 0.8}}, 100);
  return name[0] == 'c' ? column : name[1] == 'l' ? plate : pyramid;
}

void fill(CrystalBatch& batch, const Orientations& orientations, Random& random) {
  const Vec3 light = -direction_of(0, 20);
  for (int ray = 0; ray < batch.rays(); ++ray)
    batch.set(ray, orientations.draw(random).to_crystal(light), index, 0, random);
}

benchmark::Counter rate(double count) {
  return benchmark::Counter(count, benchmark::Counter::kIsRate);
}

double exits_of(const CrystalBatch& batch) {
  double count = 0;
  for (int event = 0; event <= batch.events(); ++event)
    for (const float power : batch.column(event, CrystalBatch::i)) count += power > 0;
  return count;
}

void split(benchmark::State& state, const char* name, Instructions instructions) {
  if (instructions > best_instructions()) return state.SkipWithError("no AVX-512 here");
  const CrystalPackets tracer(habit(name), instructions);
  CrystalBatch batch(rays, events);
  Random random(1, static_cast<std::uint64_t>(state.thread_index()), 0);
  fill(batch, Orientations({}), random);
  for (auto _ : state) {
    tracer.split(batch);
    benchmark::DoNotOptimize(batch.column(0, 0).data());
  }
  const auto batches = static_cast<double>(state.iterations());
  state.counters["entering"] = rate(batches * rays);
  state.counters["exits"] = rate(batches * exits_of(batch));
}

void draw(benchmark::State& state, const char* name, Instructions instructions) {
  if (instructions > best_instructions()) return state.SkipWithError("no AVX-512 here");
  const CrystalPackets tracer(habit(name), instructions);
  CrystalBatch batch(rays, 0);
  Random random(1, static_cast<std::uint64_t>(state.thread_index()), 0);
  fill(batch, Orientations({}), random);
  for (auto _ : state) {
    tracer.draw(batch);
    benchmark::DoNotOptimize(batch.column(0, 0).data());
  }
  state.counters["entering"] = rate(static_cast<double>(state.iterations()) * rays);
}

/// An orientation and numbers for every ray, and all of them split.
void oriented_and_split(benchmark::State& state, const char* name, const char* lying) {
  const CrystalPackets tracer(habit(name));
  CrystalBatch batch(rays, events);
  Random random(1, static_cast<std::uint64_t>(state.thread_index()), 0);
  const Orientations orientations({.type = lying});
  for (auto _ : state) {
    fill(batch, orientations, random);
    tracer.split(batch);
    benchmark::DoNotOptimize(batch.column(0, 0).data());
  }
  state.counters["entering"] = rate(static_cast<double>(state.iterations()) * rays);
}

/// The reference.
void one_by_one(benchmark::State& state, const char* name, bool drawn) {
  const CrystalRays tracer(habit(name), index);
  const Orientations orientations({});
  Random random(1, 0, 0);
  std::vector<CrystalExit> exits;
  const Vec3 light = -direction_of(0, 20);
  for (auto _ : state) {
    const Vec3 incoming = orientations.draw(random).to_crystal(light);
    const CrystalEntry entry = tracer.entry(incoming, random);
    exits.clear();
    if (drawn)
      benchmark::DoNotOptimize(tracer.draw(incoming, entry, random));
    else
      tracer.split(incoming, entry, events, exits);
    benchmark::DoNotOptimize(exits.data());
  }
  state.counters["entering"] = rate(static_cast<double>(state.iterations()));
}

/// The maps of a display of plates and columns under a sun at 20 degrees: 0.1 degrees, 21 wavelengths, 4 million rays each.
void display_map(benchmark::State& state) {
  const RefractiveIndex ice = RefractiveIndex::ice();
  double error = 0;
  for (auto _ : state) {
    for (const char* name : {"plate", "column"}) {
      CrystalTableSettings settings;
      settings.crystals = crystals_of_habit(name);
      settings.size_um = {200};
      for (double nm = 380; nm <= 780; nm += 20) {
        const auto n = ice.relative_to_air(nm);
        settings.waves.push_back({nm, n.real(), absorption_per_um(n.imag(), nm)});
      }
      const OrientedTable table = tabulate_oriented_crystals(settings, 20, 0.2666);
      double sum = 0;
      for (const float e : table.relative_error) sum += e;
      error = std::max(error, sum / static_cast<double>(table.relative_error.size()));
    }
  }
  state.counters["step_deg"] = 0.1;
  state.counters["mean_relative_error"] = error;
}

#define ARCUS_HABIT(name)                                              \
  BENCHMARK_CAPTURE(split, name##_avx512, #name, Instructions::avx512) \
      ->ThreadRange(1, 2)                                              \
      ->UseRealTime();                                                 \
  BENCHMARK_CAPTURE(split, name##_avx2, #name, Instructions::avx2);    \
  BENCHMARK_CAPTURE(draw, name##_avx512, #name, Instructions::avx512)  \
      ->ThreadRange(1, 2)                                              \
      ->UseRealTime();                                                 \
  BENCHMARK_CAPTURE(draw, name##_avx2, #name, Instructions::avx2);     \
  BENCHMARK_CAPTURE(one_by_one, name##_split, #name, false);           \
  BENCHMARK_CAPTURE(one_by_one, name##_draw, #name, true)
ARCUS_HABIT(plate);
ARCUS_HABIT(column);
ARCUS_HABIT(pyramid);
BENCHMARK_CAPTURE(oriented_and_split, plate, "plate", "plate")->ThreadRange(1, 2)->UseRealTime();
BENCHMARK_CAPTURE(oriented_and_split, column, "column", "column")->ThreadRange(1, 2)->UseRealTime();
BENCHMARK_CAPTURE(oriented_and_split, random, "column", "random")->ThreadRange(1, 2)->UseRealTime();

BENCHMARK(display_map)->Unit(benchmark::kSecond)->Iterations(1)->UseRealTime();

}  // namespace
}  // namespace arcus::phase

BENCHMARK_MAIN();
