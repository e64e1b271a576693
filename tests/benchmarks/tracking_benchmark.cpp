// What tracking costs: nanoseconds per tentative collision and per cell, in a cloud and in rain. Counters: `per_collision` is the
// figure to watch; `collisions` and `cells` are per ray.
//
//   tracking_benchmark --benchmark_filter=Cloud

#include <benchmark/benchmark.h>

#include <cmath>
#include <map>

#include "media/author/noise.h"
#include "media/author/rain.h"
#include "media/grid/new_grid.h"
#include "media/tracking/collision_walk.h"
#include "media/tracking/transmittance.h"

namespace arcus::media {
namespace {

const Wavelengths wavelengths{{550, 600, 650, 450}};

/// An eroded noise cloud of n³ voxels, 1 km across, extinction up to 0.05 per metre: about 5·10⁶ active voxels of 256³.
std::shared_ptr<const SparseGrid> cloud_grid(int n) {
  const Noise noise(1);
  return std::make_shared<const SparseGrid>(make_sparse_grid({{0, 0, 0}, {n - 1, n - 1, n - 1}}, false, [&](const Coord& c) {
    const Vec3 p = Vec3(c.x + 0.5, c.y + 0.5, c.z + 0.5) * (1.0 / n);
    const double inside = 1 - length(p - Vec3(0.5)) / 0.5;
    if (inside <= 0) return Voxel{};
    const double value = inside + 0.35 * noise.fractal(p * 5, 6, 0.6);
    return Voxel{static_cast<float>(value > 0.25 ? 0.05 * std::min(1.0, 2 * (value - 0.25)) : 0.0), 10};
  }));
}

/// Builds each medium once.
const Medium& medium(const std::string& name) {
  static std::map<std::string, std::unique_ptr<Medium>> media;
  std::unique_ptr<Medium>& found = media[name];
  if (found) return *found;
  Component component;
  component.name = name;
  if (name == "rain") {
    const AuthoredRain rain = author_rain({});
    component.grid = std::make_shared<const SparseGrid>(sparse_grid_of(rain.species));
    component.world_from_index = rain.species.world_from_index;
  } else {
    component.grid = cloud_grid(256);
    component.world_from_index = Affine::scaling(Vec3(1000.0 / 256));
  }
  found = std::make_unique<Medium>(std::vector<Component>{component});
  return *found;
}

/// A ray from a random point around the middle of the medium in a random direction: what paths inside look like.
Ray inner_ray(const Box& box, Random& random) {
  const auto number = [&] { return random.uniform_double(); };
  const Vec3 size = box.size();
  const Vec3 origin = box.low + Vec3(size.x * number(), size.y * number(), size.z * number());
  const double z = 2 * number() - 1, phi = 2 * pi * number(), r = std::sqrt(1 - z * z);
  return {origin, {r * std::cos(phi), r * std::sin(phi), z}};
}

std::vector<Ray> rays(const Medium& medium) {
  std::vector<Ray> result;
  Random random(1, 2, 3);
  while (result.size() < 4096) {
    const Ray ray = inner_ray(medium.bounds_m(), random);
    if (majorant_depth(medium, ray) > 0) result.push_back(ray);
  }
  return result;
}

void report(benchmark::State& state, double collisions, double seconds_scale = 1) {
  using benchmark::Counter;
  state.counters["collisions"] = Counter(collisions, Counter::kAvgIterations);
  state.counters["per_collision"] = Counter(collisions * 1e-9 * seconds_scale, Counter::kIsRate | Counter::kInvert);
}

/// Whole walks to the end: every tentative collision is looked up, none is real.
void walk_through(benchmark::State& state, const std::string& name) {
  const Medium& m = medium(name);
  const std::vector<Ray> all = rays(m);
  double collisions = 0;
  std::uint32_t i = 0;
  Spectrum sum;
  for (auto _ : state) {
    Random random(1, 1, ++i);
    CollisionWalk walk(m, all[i % all.size()], wavelengths, random);
    Collision collision;
    while (walk.next(collision)) {
      sum += collision.extinction_per_m;
      ++collisions;
    }
  }
  benchmark::DoNotOptimize(sum);
  report(state, collisions);
}

/// Free flights: to the first real collision.
void free_flight(benchmark::State& state, const std::string& name) {
  const Medium& m = medium(name);
  const std::vector<Ray> all = rays(m);
  double collisions = 0;
  std::uint32_t i = 0;
  double sum = 0;
  for (auto _ : state) {
    Random random(1, 1, ++i);
    CollisionWalk walk(m, all[i % all.size()], wavelengths, random);
    Collision collision;
    while (walk.next(collision)) {
      ++collisions;
      if (random.uniform() * collision.majorant_per_m < collision.extinction_per_m[0]) break;
    }
    sum += collision.distance_m;
  }
  benchmark::DoNotOptimize(sum);
  report(state, collisions);
}

void transmittance(benchmark::State& state, const std::string& name) {
  const Medium& m = medium(name);
  const std::vector<Ray> all = rays(m);
  std::uint32_t i = 0;
  Spectrum sum;
  double squares = 0;
  for (auto _ : state) {
    Random random(1, 1, ++i);
    const Spectrum t = ratio_transmittance(m, all[i % all.size()], wavelengths, random);
    sum += t;
    squares += t[0] * t[0];
  }
  benchmark::DoNotOptimize(sum);
  state.counters["mean"] = sum[0] / static_cast<double>(i);
}

void cells_alone(benchmark::State& state, const std::string& name) {
  const Medium& m = medium(name);
  const std::vector<Ray> all = rays(m);
  double cells = 0, depth = 0;
  std::uint32_t i = 0;
  for (auto _ : state) {
    MajorantWalk walk(m.majorants(), all[++i % all.size()]);
    Segment segment;
    while (walk.next(segment)) {
      depth += (segment.end_m - segment.begin_m) * segment.majorant_per_m;
      ++cells;
    }
  }
  benchmark::DoNotOptimize(depth);
  state.counters["cells"] = benchmark::Counter(cells, benchmark::Counter::kAvgIterations);
  state.counters["depth"] = benchmark::Counter(depth, benchmark::Counter::kAvgIterations);
  state.counters["per_cell"] = benchmark::Counter(cells * 1e-9, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

BENCHMARK_CAPTURE(walk_through, Cloud, "cloud");
BENCHMARK_CAPTURE(walk_through, Rain, "rain");
BENCHMARK_CAPTURE(free_flight, Cloud, "cloud");
BENCHMARK_CAPTURE(free_flight, Rain, "rain");
BENCHMARK_CAPTURE(transmittance, Cloud, "cloud");
BENCHMARK_CAPTURE(transmittance, Rain, "rain");
BENCHMARK_CAPTURE(cells_alone, Cloud, "cloud");
BENCHMARK_CAPTURE(cells_alone, Rain, "rain");

}  // namespace
}  // namespace arcus::media
