// Speed of Lorenz-Mie: whole blocks of spheres, the stages that they consist of, and single
// spheres.
//
//   cmake --build --preset release --target mie_benchmark
//   build/release/tests/mie_benchmark --benchmark_repetitions=9 --benchmark_report_aggregates_only
//
// "each" is the time per radius x angle x term, the terms counted as Wiscombe (1980) does,
// x + 4.05 x^(1/3) + 2, whatever way they are summed; of all threads together where there are
// several.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "phase/base/units.h"
#include "phase/particle/cosine_grid.h"
#include "phase/particle/legendre_to_chebyshev.h"
#include "phase/particle/mie.h"
#include "phase/particle/mie_block.h"
#include "phase/particle/mie_waves.h"

namespace arcus::phase {
namespace {

constexpr std::complex<double> water{1.3335, 2e-9};
constexpr double largest = 1.1e4;
constexpr std::size_t run = 256;  // angles asked for at once

// About 4000, as a table of rain has them.
const std::vector<double>& angles() {
  static const std::vector<double> values = [] {
    std::vector<double> list;
    const auto add = [&](double from, double to, double step) {
      for (double angle = from; angle < to; angle += step) list.push_back(radians(angle));
    };
    add(0, 5, 0.005);
    add(5, 120, 0.1);
    add(120, 150, 0.02);
    add(150, 175, 0.1);
    add(175, 180, 0.02);
    list.push_back(pi);
    return list;
  }();
  return values;
}

const MieAngles& shared_angles() {
  static const MieAngles shared(angles(), largest);
  return shared;
}

double wiscombe_terms(double x) { return x + 4.05 * std::cbrt(x) + 2; }

// benchmark::Counter shows the inverse of a rate with its SI prefix: 12p is 0.012 ns.
benchmark::Counter each(double count) {
  return benchmark::Counter(
      count, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kAvgThreads | benchmark::Counter::kInvert);
}

std::vector<double> neighbours(double x) {
  std::vector<double> sizes;
  for (int i = 0; i < mie_block_radii; ++i) sizes.push_back(x * (1 + 0.0005 * i));
  return sizes;
}

// Work of one block, matrices included.
void spheres(MieBlock& block, std::span<const double> sizes, std::vector<float>& matrix) {
  block.compute(sizes, water);
  for (std::size_t first = 0; first < angles().size(); first += run) {
    const std::size_t count = std::min(run, angles().size() - first);
    block.matrix(first, count,
                 std::span(matrix).subspan(0, sizes.size() * mie_block_elements * count));
    benchmark::DoNotOptimize(matrix.data());
  }
}

void block_of_spheres(benchmark::State& state, Instructions instructions) {
  if (instructions == Instructions::avx512 && best_instructions() != instructions) {
    state.SkipWithError("no AVX-512 here");
    return;
  }
  const double x = static_cast<double>(state.range(0));
  MieBlock block(shared_angles(), instructions);
  std::vector<float> matrix(mie_block_radii * mie_block_elements * run);
  const std::vector<double> sizes = neighbours(x);
  for (auto _ : state) spheres(block, sizes, matrix);
  state.counters["each"] = each(mie_block_radii * angles().size() * wiscombe_terms(x));
  state.counters["sphere"] = each(mie_block_radii);
}
BENCHMARK_CAPTURE(block_of_spheres, avx512, Instructions::avx512)
    ->ArgName("x")
    ->Arg(10)
    ->Arg(30)
    ->Arg(100)
    ->Arg(300)
    ->Arg(1000)
    ->Arg(3000)
    ->Arg(10000)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(block_of_spheres, avx2, Instructions::avx2)
    ->ArgName("x")
    ->Arg(100)
    ->Arg(1000)
    ->Arg(10000)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(block_of_spheres, both_cores, best_instructions())
    ->ArgName("x")
    ->Arg(100)
    ->Arg(300)
    ->Arg(1000)
    ->Arg(3000)
    ->Arg(10000)
    ->Threads(2)
    ->UseRealTime()
    ->Unit(benchmark::kMicrosecond);

// One wavelength of a table: 10^4 radii, x = 2 ... 2000 in equal ratios.
void wavelength_of_a_table(benchmark::State& state) {
  std::vector<double> sizes;
  double work = 0;
  for (int i = 0; i < 10000; ++i) {
    sizes.push_back(2 * std::pow(1000, i / 9999.0));
    work += wiscombe_terms(sizes.back()) * static_cast<double>(angles().size());
  }
  MieBlock block(shared_angles());
  std::vector<float> matrix(mie_block_radii * mie_block_elements * run);
  for (auto _ : state)
    for (std::size_t start = 0; start < sizes.size(); start += mie_block_radii)
      spheres(block, std::span(sizes).subspan(start, mie_block_radii), matrix);
  state.counters["each"] = each(work);
}
BENCHMARK(wavelength_of_a_table)->Unit(benchmark::kMillisecond);
BENCHMARK(wavelength_of_a_table)->Threads(2)->UseRealTime()->Unit(benchmark::kMillisecond);

// The stages, each for eight spheres.
struct Stage {
  explicit Stage(double x)
      : conversion(mie_block_terms(1.01 * x)),
        inverse(mie_block_terms(1.01 * x) + 3),
        legendre(LegendreToChebyshev::series_size(mie_block_terms(1.01 * x))),
        chebyshev(LegendreToChebyshev::series_size(mie_block_terms(1.01 * x))) {
    for (std::size_t n = 1; n < inverse.size(); ++n) inverse[n] = 1.0 / static_cast<double>(n);
    for (int i = 0; i < lanes; ++i) spheres.size_parameter[i] = x * (1 + 0.001 * i);
    spheres.relative_index = water;
    legendre_coefficients(spheres, inverse, legendre.data(), efficiencies, best_instructions());
  }
  EightSpheres spheres;
  LegendreToChebyshev conversion;
  std::vector<double> inverse;
  LaneMemory legendre, chebyshev;
  SphereEfficiencies efficiencies[lanes];
};

void partial_waves(benchmark::State& state) {
  Stage stage(static_cast<double>(state.range(0)));
  for (auto _ : state)
    legendre_coefficients(stage.spheres, stage.inverse, stage.legendre.data(), stage.efficiencies,
                          best_instructions());
  state.counters["term"] = each(lanes * stage.spheres.terms());
}
BENCHMARK(partial_waves)
    ->ArgName("x")
    ->Arg(100)
    ->Arg(1000)
    ->Arg(10000)
    ->Unit(benchmark::kMicrosecond);

void conversion(benchmark::State& state) {
  Stage stage(static_cast<double>(state.range(0)));
  const int degree = stage.spheres.terms();
  const LaneMemory scratch(LegendreToChebyshev::scratch_size(degree));
  for (auto _ : state)
    stage.conversion.convert(degree, stage.legendre.data(), stage.chebyshev.data(), scratch.data(),
                             best_instructions());
  state.counters["term"] = each(lanes * degree);
}
BENCHMARK(conversion)->ArgName("x")->Arg(100)->Arg(1000)->Arg(10000)->Unit(benchmark::kMicrosecond);

void sum_on_grid(benchmark::State& state) {
  Stage stage(static_cast<double>(state.range(0)));
  const int degree = stage.spheres.terms();
  const LaneMemory scratch(LegendreToChebyshev::scratch_size(degree));
  stage.conversion.convert(degree, stage.legendre.data(), stage.chebyshev.data(), scratch.data(),
                           best_instructions());
  const CosineGrid grid(CosineGrid::points_for(degree), angles());
  const LaneMemory work(2 * grid.points());
  const LaneMemory values(CosineGrid::grid_size(grid.points()) * sizeof(float) /
                          (lanes * sizeof(double)));
  for (auto _ : state)
    grid.sum(degree, stage.chebyshev.data(), work.data(), reinterpret_cast<float*>(values.data()),
             0, best_instructions());
  state.counters["term"] = each(lanes * degree);
}
BENCHMARK(sum_on_grid)
    ->ArgName("x")
    ->Arg(100)
    ->Arg(1000)
    ->Arg(10000)
    ->Unit(benchmark::kMicrosecond);

void matrices_from_grid(benchmark::State& state) {
  MieBlock block(shared_angles());
  block.compute(neighbours(static_cast<double>(state.range(0))), water);
  std::vector<float> matrix(mie_block_radii * mie_block_elements * run);
  for (auto _ : state)
    for (std::size_t first = 0; first + run <= angles().size(); first += run)
      block.matrix(first, run, matrix);
  state.counters["angle"] = each(mie_block_radii * (angles().size() / run * run));
}
BENCHMARK(matrices_from_grid)
    ->ArgName("x")
    ->Arg(100)
    ->Arg(1000)
    ->Arg(10000)
    ->Unit(benchmark::kMicrosecond);

void preparation_of_angles(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(MieAngles(angles(), largest).size());
}
BENCHMARK(preparation_of_angles)->Unit(benchmark::kMillisecond);

// The reference: every term at every angle.
void single_sphere(benchmark::State& state) {
  const double x = static_cast<double>(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(mie_sphere(x, water, angles()).s1.data());
  state.counters["each"] = each(static_cast<double>(angles().size()) * wiscombe_terms(x));
}
BENCHMARK(single_sphere)->ArgName("x")->Arg(100)->Arg(1000)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace arcus::phase

BENCHMARK_MAIN();
