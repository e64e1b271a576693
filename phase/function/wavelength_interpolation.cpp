#include "phase/function/wavelength_interpolation.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "phase/function/half_angle.h"

namespace arcus::phase {

namespace {

/// Four neighbouring nodes and their weights (cubic Lagrange; fewer nodes where the table has fewer).
struct Stencil {
  int first = 0, count = 1;
  double weight[4] = {1, 0, 0, 0};
};

Stencil stencil_at(const std::vector<double>& nodes, double x) {
  Stencil stencil;
  const int n = static_cast<int>(nodes.size());
  stencil.count = std::min(4, n);
  const int upper = static_cast<int>(std::upper_bound(nodes.begin(), nodes.end(), x) - nodes.begin());
  stencil.first = std::clamp(upper - 2, 0, n - stencil.count);
  for (int j = 0; j < stencil.count; ++j) {
    stencil.weight[j] = 1;
    for (int m = 0; m < stencil.count; ++m)
      if (m != j)
        stencil.weight[j] *= (x - nodes[stencil.first + m]) / (nodes[stencil.first + j] - nodes[stencil.first + m]);
  }
  return stencil;
}

}  // namespace

FineRows interpolate_wavelengths(const ScatteringTable& table, bool clip, double step_nm) {
  assert(step_nm > 0);
  const auto& coarse = table.wavelength_nm;
  const auto& angle_deg = table.scattering_angle_deg;
  const int sizes = static_cast<int>(table.size_um.size()), angles = static_cast<int>(angle_deg.size());
  const int nodes = static_cast<int>(coarse.size());
  FineRows rows;
  const double range = coarse.back() - coarse.front();
  rows.wavelength_count = std::max(2, static_cast<int>(std::ceil(range / step_nm - 1e-9)) + 1);
  rows.first_wavelength_nm = coarse.front();
  rows.step_nm = range > 0 ? range / (rows.wavelength_count - 1) : step_nm;
  const int fine = rows.wavelength_count;
  rows.value_per_sr.resize(static_cast<std::size_t>(sizes) * angles * fine);

  std::vector<Stencil> stencils;
  for (int k = 0; k < fine; ++k)
    stencils.push_back(stencil_at(coarse, std::min(coarse.back(), coarse.front() + k * rows.step_nm)));

  tbb::parallel_for(0, sizes, [&](int size) {
    std::vector<float> logs(static_cast<std::size_t>(nodes) * angles);
    for (int j = 0; j < nodes; ++j) {
      float* row = logs.data() + static_cast<std::size_t>(j) * angles;
      std::copy_n(table.p11.data() + table.first(size, j), angles, row);
      if (clip && table.forward_fraction[table.row(size, j)] > 0)
        clip_forward(angle_deg, table.forward_angle_deg, row);
      for (int i = 0; i < angles; ++i) row[i] = std::log(std::max(row[i], 1e-30f));
    }
    float* value = rows.value_per_sr.data() + static_cast<std::size_t>(size) * angles * fine;
    for (int i = 0; i < angles; ++i)
      for (int k = 0; k < fine; ++k) {
        const Stencil& stencil = stencils[k];
        double sum = 0;
        for (int j = 0; j < stencil.count; ++j)
          sum += stencil.weight[j] * logs[static_cast<std::size_t>(stencil.first + j) * angles + i];
        value[static_cast<std::size_t>(i) * fine + k] = static_cast<float>(std::exp(sum));
      }
    std::vector<double> total(fine, 0.0);
    for (int i = 0; i + 1 < angles; ++i) {
      const HalfAngle a = half_angle_of_rad(radians(angle_deg[i])), b = half_angle_of_rad(radians(angle_deg[i + 1]));
      const double width = a.sin2 < 0.5 ? b.sin2 - a.sin2 : a.cos2 - b.cos2;
      const float* lower = value + static_cast<std::size_t>(i) * fine;
      for (int k = 0; k < fine; ++k) total[k] += 2 * pi * width * (static_cast<double>(lower[k]) + lower[k + fine]);
    }
    for (int i = 0; i < angles; ++i)
      for (int k = 0; k < fine; ++k) {
        float& v = value[static_cast<std::size_t>(i) * fine + k];
        v = static_cast<float>(v / total[k]);
      }
  });
  return rows;
}

}  // namespace arcus::phase
