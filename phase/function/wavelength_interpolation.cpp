#include "phase/function/wavelength_interpolation.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace arcus::phase {

namespace {

/// Neighbouring nodes, four where there are as many, and the weights of the polynomial through them (Lagrange).
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

std::vector<float> clipped_rows(const ScatteringTable& table, int size, bool clip) {
  const std::size_t angles = table.scattering_angle_deg.size(), wavelengths = table.wavelength_nm.size();
  std::vector<float> rows(table.p11.begin() + table.first(size, 0),
                          table.p11.begin() + table.first(size, 0) + wavelengths * angles);
  for (std::size_t j = 0; j < wavelengths; ++j)
    if (clip && table.forward_fraction[table.row(size, j)] > 0)
      clip_forward(table.scattering_angle_deg, table.forward_angle_deg, rows.data() + j * angles);
  return rows;
}

bool keeps_lobe(const ScatteringTable& table, int size, bool clip) {
  for (std::size_t j = 0; j < table.wavelength_nm.size(); ++j)
    if (clip && table.forward_fraction[table.row(size, j)] > 0) return false;
  return true;
}

/// Derivative at every node by the parabola through it and its neighbours.
void set_slopes(const std::vector<double>& x, const float* y, float* slope) {
  const int n = static_cast<int>(x.size());
  for (int i = 1; i + 1 < n; ++i) {
    const double a = x[i] - x[i - 1], b = x[i + 1] - x[i];
    slope[i] = static_cast<float>(((y[i] - y[i - 1]) / a * b + (y[i + 1] - y[i]) / b * a) / (a + b));
  }
  slope[0] = slope[n - 1] = 0;  // an even function of the angle from either end
}

}  // namespace

WavelengthInterpolation::WavelengthInterpolation(const ScatteringTable& table, int size, bool clip)
    : angle_deg_(table.scattering_angle_deg),
      wavelength_nm_(table.wavelength_nm),
      values_(clipped_rows(table, size, clip)),
      tracks_(angle_deg_, wavelength_nm_, values_, table.size_um[size], keeps_lobe(table, size, clip)),
      logs_(values_.size()),
      slopes_(values_.size()) {
  const std::size_t angles = angle_deg_.size();
  for (std::size_t j = 0; j < wavelength_nm_.size(); ++j) {
    const float* row = values(static_cast<int>(j));
    has_zeros_.push_back(!(*std::min_element(row, row + angles) > 0));
    if (has_zeros_.back()) continue;
    for (std::size_t i = 0; i < angles; ++i) logs_[j * angles + i] = std::log(row[i]);
    set_slopes(angle_deg_, logs_.data() + j * angles, slopes_.data() + j * angles);
  }
}

void WavelengthInterpolation::evaluate(double wavelength_nm, std::span<float> p11) const {
  const int angles = static_cast<int>(angle_deg_.size());
  assert(static_cast<int>(p11.size()) == angles);
  wavelength_nm = std::clamp(wavelength_nm, wavelength_nm_.front(), wavelength_nm_.back());
  const int upper = static_cast<int>(std::lower_bound(wavelength_nm_.begin(), wavelength_nm_.end(), wavelength_nm) -
                                     wavelength_nm_.begin());
  if (wavelength_nm_[upper] == wavelength_nm) {
    std::copy_n(values(upper), angles, p11.begin());
    return;
  }
  const Stencil stencil = stencil_at(wavelength_nm_, wavelength_nm);
  bool logarithmic = true;
  for (int j = 0; j < stencil.count; ++j) logarithmic = logarithmic && !has_zeros_[stencil.first + j];
  if (!logarithmic) {  // no cubic either: it could go below zero
    const double a = wavelength_nm_[upper - 1], b = wavelength_nm_[upper];
    const float share = static_cast<float>((wavelength_nm - a) / (b - a));
    for (int i = 0; i < angles; ++i) p11[i] = (1 - share) * values(upper - 1)[i] + share * values(upper)[i];
    return;
  }

  std::vector<double> sum(angles, 0.0);
  std::vector<FeatureTracks::Mover> movers(tracks_.anything_moves() ? angles : 0);
  if (tracks_.anything_moves())
    tracks_.movers(wavelength_nm, wavelength_nm_[stencil.first],
                   wavelength_nm_[stencil.first + stencil.count - 1], movers);
  for (int j = 0; j < stencil.count; ++j) {
    const int node = stencil.first + j;
    const float* logs = logs_.data() + static_cast<std::size_t>(node) * angles;
    const float* slopes = slopes_.data() + static_cast<std::size_t>(node) * angles;
    const double weight = stencil.weight[j];
    if (!tracks_.anything_moves()) {
      for (int i = 0; i < angles; ++i) sum[i] += weight * logs[i];
      continue;
    }
    const FeatureTracks::Shift shift = tracks_.shift(wavelength_nm, wavelength_nm_[node]);
    int k = 0;  // interval of the displaced angle; both ascend together
    for (int i = 0; i < angles; ++i) {
      const double angle = std::clamp(angle_deg_[i] + shift.of(movers[i]), 0.0, 180.0);
      while (k + 2 < angles && angle >= angle_deg_[k + 1]) ++k;
      while (k > 0 && angle < angle_deg_[k]) --k;
      // Cubic Hermite between the nodes of the interval.
      const double width = angle_deg_[k + 1] - angle_deg_[k], t = (angle - angle_deg_[k]) / width;
      const double rise = logs[k + 1] - logs[k], a = slopes[k] * width, b = slopes[k + 1] * width;
      sum[i] += weight * (logs[k] + t * (a + t * (3 * rise - 2 * a - b + t * (a + b - 2 * rise))));
    }
  }
  for (int i = 0; i < angles; ++i) p11[i] = std::exp(static_cast<float>(sum[i]));
}

}  // namespace arcus::phase
