#pragma once
// Radiances by VolumePath with their errors, on all cores.

#include <tbb/parallel_for.h>

#include <cmath>
#include <vector>

#include "src/integrator/volume_path.h"
#include "tests/statistics/seed.h"
#include "tests/statistics/students_t.h"

namespace arcus::render {

using statistics::Moments;

/// All four wavelengths of a path are one, so that an optical depth is.
inline Wavelengths one_wavelength(double nm) {
  Wavelengths wavelengths;
  wavelengths.nm.fill(static_cast<float>(nm));
  return wavelengths;
}

/// Of 64 means of so many samples. number: of the question, so that each has its own random numbers.
inline Moments traced(const Scene& scene, const media::Ray& ray, std::size_t number, const Wavelengths& wavelengths, int samples = 300, long long max_bounces = 1000000) {
  const VolumePath integrator(scene, max_bounces);
  constexpr int tasks = 64;
  samples = static_cast<int>(samples * statistics::test_effort());
  std::vector<double> means(tasks);
  tbb::parallel_for(0, tasks, [&](int task) {
    double sum = 0;
    for (int i = 0; i < samples; ++i) {
      Random random(statistics::test_seed(), static_cast<std::uint64_t>(number) * tasks + static_cast<std::uint64_t>(task), static_cast<std::uint32_t>(i));
      sum += static_cast<double>(integrator.radiance(ray, wavelengths, {0.5, 0.5, 0.5, random.uniform_double(), random.uniform_double()}, random).mean());
    }
    means[static_cast<std::size_t>(task)] = sum / samples;
  });
  Moments moments;
  for (const double mean : means) moments.add(mean);
  return moments;
}

}  // namespace arcus::render
