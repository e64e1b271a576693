// Measures what LargeDrop errs against the Lorenz-Mie series, both averaged over gamma
// distributions of sizes, and prints the tables of docs/large_drops.md. Takes a few minutes.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <span>
#include <vector>

#include "phase/base/units.h"
#include "phase/particle/large_drop.h"
#include "phase/particle/mie_block.h"
#include "phase/population/sizes.h"

namespace arcus::phase {
namespace {

struct Case {
  double size_parameter, variance, n, k;
  int waves;
};

struct Mean {
  std::vector<double> elements[4];
  SphereEfficiencies efficiencies;
  double milliseconds = 0;  // of one sphere
  std::size_t spheres = 0;
};

std::vector<double> make_angles(double x) {
  std::vector<double> angles;
  const auto add = [&](double first, double last, double step) {
    for (double angle = first; angle < last - 1e-9; angle += step) angles.push_back(radians(angle));
  };
  add(0, 1, std::min(0.01, 10 / x));
  add(1, 3, 0.1);
  add(3, 118, 0.5);
  add(118, 126, 0.1);
  add(126, 146, 0.025);
  add(146, 175, 0.25);
  add(175, 178, 0.05);
  add(178, 180, std::min(0.02, 20 / x));
  angles.push_back(pi);
  return angles;
}

/// Averages what `sphere(first, count, add)` says of the sizes x.
template <class Spheres>
Mean average(const Sizes& sizes, const std::vector<double>& x, std::size_t angles,
             const Spheres& spheres) {
  const auto weight = sizes.weights(x);
  Mean mean;
  mean.spheres = x.size();
  for (auto& element : mean.elements) element.resize(angles);
  double area = 0;
  const auto start = std::chrono::steady_clock::now();
  spheres([&](std::size_t i, const SphereEfficiencies& q, const auto& element) {
    const double share = weight[i] * x[i] * x[i];
    area += share;
    mean.efficiencies.extinction += share * q.extinction;
    mean.efficiencies.scattering += share * q.scattering;
    mean.efficiencies.asymmetry += share * q.scattering * q.asymmetry;
    for (int k = 0; k < 4; ++k)
      for (std::size_t a = 0; a < angles; ++a) mean.elements[k][a] += weight[i] * element(k, a);
  });
  mean.milliseconds =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count() /
      static_cast<double>(x.size());
  for (auto& element : mean.elements)
    for (double& value : element) value /= area;
  mean.efficiencies.asymmetry /= mean.efficiencies.scattering;
  mean.efficiencies.extinction /= area;
  mean.efficiencies.scattering /= area;
  return mean;
}

std::vector<double> log_grid(double low, double high, int count) {
  std::vector<double> x;
  for (int i = 0; i < count; ++i) x.push_back(low * std::pow(high / low, i / (count - 1.0)));
  return x;
}

double peak_deg(const std::vector<double>& angles, const std::vector<double>& values,
                double first_deg, double last_deg) {
  std::size_t best = 0;
  for (std::size_t a = 1; a + 1 < angles.size(); ++a)
    if (angles[a] > radians(first_deg) && angles[a] < radians(last_deg) &&
        (best == 0 || values[a] > values[best]))
      best = a;
  const double before = values[best - 1], here = values[best], after = values[best + 1];
  return degrees(angles[best] + 0.5 * (before - after) / (before - 2 * here + after) *
                                    (angles[best + 1] - angles[best]));
}

void measure(const Case& c) {
  const auto angles = make_angles(c.size_parameter);
  const Sizes sizes({.type = "gamma", .variance = c.variance}, c.size_parameter);
  const auto range = sizes.range_um(1e-3);
  const double low = std::max(range.low_um, LargeDrop::least_size_parameter), high = range.high_um;

  const auto wave_x = log_grid(low, high, c.waves);
  const MieAngles prepared(angles, high * 1.001);
  const Mean waves = average(sizes, wave_x, angles.size(), [&](const auto& add) {
    std::vector<float> matrix(mie_block_radii * mie_block_elements * angles.size());
    std::vector<SphereEfficiencies> q(mie_block_radii);
    for (std::size_t first = 0; first < wave_x.size(); first += mie_block_radii) {
      mie_block(prepared, std::span(wave_x).subspan(first, mie_block_radii), {c.n, c.k}, matrix, q);
      for (std::size_t i = 0; i < mie_block_radii; ++i)
        add(first + i, q[i], [&](int k, std::size_t a) {
          return matrix[(i * mie_block_elements + static_cast<std::size_t>(k)) * angles.size() + a];
        });
    }
  });

  const double step = 0.15 * std::sqrt(c.variance);
  const auto drop_x = log_grid(low, high, static_cast<int>(std::log(high / low) / step) + 2);
  LargeDrop drop({c.n, c.k}, angles);
  const Mean drops = average(sizes, drop_x, angles.size(), [&](const auto& add) {
    for (std::size_t i = 0; i < drop_x.size(); ++i) {
      const SphereIntensities s = drop.scatter(drop_x[i], drop_x[1] / drop_x[0] - 1);
      const std::vector<double>* elements[] = {&s.i11, &s.i12, &s.i33, &s.i34};
      add(i, s.efficiencies, [&](int k, std::size_t a) { return (*elements[k])[a]; });
    }
  });

  std::printf("\n### x = %g, variance %g, m = %g + %gi\n\n", c.size_parameter, c.variance, c.n,
              c.k);
  std::printf(
      "%zu waves of %.2f ms, %zu large drops of %.2f ms (%zu angles), sizes x = %.0f ... %.0f. ",
      waves.spheres, waves.milliseconds, drops.spheres, drops.milliseconds, angles.size(), low,
      high);
  std::printf(
      "Extinction %.6f, large drops %+.1e; absorption %.3e, %+.1e; asymmetry %.5f, %+.1e.\n\n",
      waves.efficiencies.extinction, drops.efficiencies.extinction - waves.efficiencies.extinction,
      waves.efficiencies.extinction - waves.efficiencies.scattering,
      drops.efficiencies.extinction - drops.efficiencies.scattering -
          waves.efficiencies.extinction + waves.efficiencies.scattering,
      waves.efficiencies.asymmetry, drops.efficiencies.asymmetry - waves.efficiencies.asymmetry);
  std::printf(
      "| angles | P11 mean | P11 rms | P11 worst | P12/P11 rms | P33/P11 rms | P34/P11 rms |\n|---|---|---|---|---|---|---|\n");
  const double edges[] = {0,   1,     3,   10,  30,  60,  80,  100, 118,   126,
                          130, 136.5, 139, 142, 150, 165, 175, 178, 179.5, 180.1};
  for (std::size_t r = 0; r + 1 < std::size(edges); ++r) {
    double mean = 0, square = 0, worst = 0, count = 0, other[3] = {};
    for (std::size_t a = 0; a < angles.size(); ++a) {
      if (angles[a] < radians(edges[r]) || angles[a] >= radians(edges[r + 1])) continue;
      const double w = waves.elements[0][a], d = drops.elements[0][a], error = d / w - 1;
      mean += error;
      square += error * error;
      worst = std::max(worst, std::fabs(error));
      for (int k = 0; k < 3; ++k)
        other[k] += std::pow(drops.elements[k + 1][a] / d - waves.elements[k + 1][a] / w, 2);
      ++count;
    }
    std::printf("| %g-%g | %+.2f %% | %.2f %% | %.2f %% | %.4f | %.4f | %.4f |\n", edges[r],
                std::min(edges[r + 1], 180.0), 100 * mean / count, 100 * std::sqrt(square / count),
                100 * worst, std::sqrt(other[0] / count), std::sqrt(other[1] / count),
                std::sqrt(other[2] / count));
  }
  if (c.n == 1.333) {
    const double third = std::pow(c.size_parameter, -2.0 / 3), bow = 137.92, second = 129.0;
    std::printf("\nPeaks, waves and large drops minus waves:");
    const double h3 = std::cbrt(4.87),
                 around[][2] = {{bow - 1, bow + degrees(2 * h3 * third)},
                                {second - degrees(6 * third) - 1, second + 1.5}};
    for (const auto& range_deg : around) {
      const double peak = peak_deg(angles, waves.elements[0], range_deg[0], range_deg[1]);
      std::printf(" %.3f deg %+.4f;", peak,
                  peak_deg(angles, drops.elements[0], range_deg[0], range_deg[1]) - peak);
    }
    std::printf("\n");
  }
  std::fflush(stdout);
}

}  // namespace
}  // namespace arcus::phase

int main() {
  using arcus::phase::Case;
  for (const Case& c : {Case{1000, 0.1, 1.333, 0, 16000}, Case{2000, 0.1, 1.333, 0, 16000},
                        Case{2000, 0.01, 1.333, 0, 16000}, Case{5000, 0.01, 1.333, 0, 16000},
                        Case{20000, 0.01, 1.333, 1e-7, 8000}, Case{2000, 0.1, 1.333, 1e-5, 8000},
                        Case{1500, 0.1, 1.31, 0, 8000}, Case{1500, 0.05, 1.5, 1e-6, 8000}})
    arcus::phase::measure(c);
}
