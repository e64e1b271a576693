// Nanoseconds per evaluation and per draw of phase functions, four wavelengths at a time, and
// seconds to build a table of rain. Directions and wavelengths are random; a table of one size stays
// in the caches, one of 24 sizes does not.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <vector>

#include "phase/function/phase_function.h"
#include "phase/function/sphere_table.h"
#include "phase/optics/sun_disc.h"
#include "tests/phase/function/synthetic_drops.h"

namespace arcus::phase {

namespace {

constexpr int query_count = 4096;

struct Queries {
  std::vector<Vec3> incoming, outgoing;
  std::vector<Wavelengths> wavelengths;
  std::vector<int> size;
};

/// Outgoing directions drawn from the function itself where `drawn`, as along a path, else uniform.
Queries queries(const PhaseFunction* drawn, int sizes) {
  Queries result;
  Random random(1, 2, 3);
  for (int i = 0; i < query_count; ++i) {
    const Vec3 up{0, 0, 1};
    result.incoming.push_back(direction_at(up, Isotropic().draw(random.uniform_double()), random.uniform()));
    result.wavelengths.push_back(draw_wavelengths(random.uniform()));
    result.outgoing.push_back(
        drawn ? drawn->draw(result.incoming.back(), result.wavelengths.back(), random).outgoing
              : direction_at(up, Isotropic().draw(random.uniform_double()), random.uniform()));
    result.size.push_back(static_cast<int>(random.uniform() * sizes));
  }
  return result;
}

const SphereTable& rain(int sizes) {
  const auto make = [](int count) {
    std::vector<double> size_um;
    for (int i = 0; i < count; ++i) size_um.push_back(100 * std::pow(10, i / 23.0));
    SphereTableOptions options;
    options.sun_angular_radius_rad = radians(mean_sun_radius_deg);
    options.wavelength_nodes = 321;
    return SphereTable(synthetic_table(size_um, wavelengths_nm(380, 780, 10), 2), options);
  };
  static const SphereTable one = make(1), many = make(24);
  return sizes == 1 ? one : many;
}

PhaseFunction analytic(int kind) {
  if (kind == 1) return PhaseFunction(Rayleigh());
  if (kind == 2) return PhaseFunction(HenyeyGreenstein(0.85));
  return PhaseFunction(Isotropic());
}

enum class What { value, sunlit, draw };

template <class Phase>
void run(benchmark::State& state, What what, const Queries& q, Phase phase) {
  Random random(4, 5, 6);
  int i = 0;
  for (auto _ : state) {
    const PhaseFunction p = phase(i);
    if (what == What::value)
      benchmark::DoNotOptimize(p.value(q.incoming[i], q.outgoing[i], q.wavelengths[i]));
    else if (what == What::sunlit)
      benchmark::DoNotOptimize(p.sunlit_value(q.incoming[i], q.outgoing[i], q.wavelengths[i]));
    else
      benchmark::DoNotOptimize(p.draw(q.incoming[i], q.wavelengths[i], random));
    i = (i + 1) % query_count;
  }
}

void analytic_value(benchmark::State& state) {
  const PhaseFunction p = analytic(static_cast<int>(state.range(0)));
  run(state, What::value, queries(nullptr, 1), [&](int) { return p; });
}

void analytic_draw(benchmark::State& state) {
  const PhaseFunction p = analytic(static_cast<int>(state.range(0)));
  run(state, What::draw, queries(nullptr, 1), [&](int) { return p; });
}

void table(benchmark::State& state, What what, bool along_paths) {
  const SphereTable& drops = rain(static_cast<int>(state.range(0)));
  const PhaseFunction first(SphereLobe{&drops, 0});
  const Queries q = queries(along_paths ? &first : nullptr, drops.size_count());
  run(state, what, q, [&](int i) { return PhaseFunction(SphereLobe{&drops, q.size[i]}); });
  state.counters["MB"] = static_cast<double>(drops.memory_bytes()) / 1e6;
}

void build_table(benchmark::State& state) {
  std::vector<double> size_um;
  for (int i = 0; i < 24; ++i) size_um.push_back(100 * std::pow(10, i / 23.0));
  const ScatteringTable drops = synthetic_table(size_um, wavelengths_nm(380, 780, 10), 2);
  SphereTableOptions options;
  options.sun_angular_radius_rad = radians(mean_sun_radius_deg);
  options.wavelength_nodes = static_cast<int>(state.range(0));
  for (auto _ : state) {
    const SphereTable built(drops, options);
    state.counters["MB"] = static_cast<double>(built.memory_bytes()) / 1e6;
    state.counters["angles"] = built.angle_count();
  }
}

}  // namespace

// 0 isotropic, 1 air, 2 Henyey–Greenstein.
BENCHMARK(analytic_value)->DenseRange(0, 2);
BENCHMARK(analytic_draw)->DenseRange(0, 2);
// Sizes in the table: 1 or 24.
BENCHMARK_CAPTURE(table, value_in_random_directions, What::value, false)->Arg(1)->Arg(24);
BENCHMARK_CAPTURE(table, value_along_paths, What::value, true)->Arg(1)->Arg(24);
BENCHMARK_CAPTURE(table, sunlit_value, What::sunlit, false)->Arg(1)->Arg(24);
BENCHMARK_CAPTURE(table, draw, What::draw, false)->Arg(1)->Arg(24);
BENCHMARK(build_table)->Arg(161)->Arg(321)->Unit(benchmark::kSecond)->UseRealTime();

}  // namespace arcus::phase
