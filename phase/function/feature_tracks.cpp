#include "phase/function/feature_tracks.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include "phase/base/units.h"

namespace arcus::phase {

namespace {

double inverse_square(double wavelength_nm) { return 1e5 / (wavelength_nm * wavelength_nm); }

double horner(const std::array<double, 4>& c, double x) { return c[0] + x * (c[1] + x * (c[2] + x * c[3])); }

/// Least-squares polynomial of up to 4 coefficients; normal equations are good enough for x in [−1, 1].
std::array<double, 4> fit(const std::vector<double>& x, const std::vector<double>& y, int terms) {
  double a[4][5] = {};
  for (std::size_t i = 0; i < x.size(); ++i) {
    double power[4] = {1, x[i], x[i] * x[i], x[i] * x[i] * x[i]};
    for (int r = 0; r < terms; ++r) {
      for (int c = 0; c < terms; ++c) a[r][c] += power[r] * power[c];
      a[r][4] += power[r] * y[i];
    }
  }
  for (int p = 0; p < terms; ++p)  // positive definite: no pivoting needed
    for (int r = 0; r < terms; ++r) {
      if (r == p) continue;
      const double factor = a[r][p] / a[p][p];
      for (int c = p; c < 5; ++c) a[r][c] -= factor * a[p][c];
    }
  std::array<double, 4> result{};
  for (int p = 0; p < terms; ++p) result[p] = a[p][4] / a[p][p];
  return result;
}

/// A smooth curve through positions found at some of the wavelengths; not found where they are few or do not lie on one.
FeatureTracks::Track track_through(const std::vector<double>& wavelength_nm,
                                   const std::vector<std::optional<double>>& position_deg, double tolerance_deg) {
  FeatureTracks::Track track;
  const double first = inverse_square(wavelength_nm.front()), last = inverse_square(wavelength_nm.back());
  track.centre = 0.5 * (first + last);
  track.half_range = std::fmax(0.5 * std::fabs(first - last), 1e-12);
  std::vector<double> x, y;
  for (std::size_t j = 0; j < wavelength_nm.size(); ++j)
    if (position_deg[j]) {
      x.push_back((inverse_square(wavelength_nm[j]) - track.centre) / track.half_range);
      y.push_back(*position_deg[j]);
    }
  if (x.size() < 3 || 5 * x.size() < 4 * wavelength_nm.size()) return track;
  track.coefficients = fit(x, y, x.size() >= 8 ? 4 : x.size() >= 5 ? 3 : 2);
  double squares = 0;
  for (std::size_t i = 0; i < x.size(); ++i) squares += std::pow(y[i] - horner(track.coefficients, x[i]), 2);
  track.found = std::sqrt(squares / static_cast<double>(x.size())) < tolerance_deg;
  return track;
}

/// Vertex of the parabola through three points, the middle one not the lowest.
double vertex(const double* x, const float* y) {
  const double left = (y[1] - y[0]) / (x[1] - x[0]), right = (y[2] - y[1]) / (x[2] - x[1]);
  const double curvature = (right - left) / (x[2] - x[0]);
  if (curvature >= 0) return x[1];
  return std::clamp(0.5 * (x[0] + x[1]) - 0.5 * left / curvature, x[0], x[2]);
}

class RowSearch {
 public:
  RowSearch(const std::vector<double>& angle_deg, const float* row) : angle_(angle_deg), row_(row) {}

  /// The largest value between 110° and 165°, where the first bow of everything with an index from 1.2 to 1.5 lies.
  std::optional<double> primary() const {
    const int from = node_after(110), to = node_after(165);
    const int top = static_cast<int>(std::max_element(row_ + from, row_ + to) - row_);
    if (top == from || top >= to - 1 || top + 1 >= static_cast<int>(angle_.size())) return {};
    return vertex(&angle_[top - 1], row_ + top - 1);
  }

  /// The first clear maximum on the way forward from the first bow's foot.
  std::optional<double> secondary(double primary_deg) const {
    const int from = std::max(1, node_after(primary_deg - 60));
    float lowest = row_[node_after(primary_deg)];
    for (int i = node_after(primary_deg); i > from; --i) {
      lowest = std::min(lowest, row_[i]);
      if (row_[i] > 1.1f * lowest && row_[i] >= row_[i - 1] && is_highest_within(i, 1.0))
        return vertex(&angle_[i - 1], row_ + i - 1);
    }
    return {};
  }

 private:
  int node_after(double deg) const {
    return static_cast<int>(std::upper_bound(angle_.begin(), angle_.end() - 1, deg) - angle_.begin());
  }
  bool is_highest_within(int node, double range_deg) const {
    for (int i = node; i >= 0 && angle_[node] - angle_[i] < range_deg; --i)
      if (row_[i] > row_[node]) return false;
    for (int i = node; i < static_cast<int>(angle_.size()) && angle_[i] - angle_[node] < range_deg; ++i)
      if (row_[i] > row_[node]) return false;
    return true;
  }

  const std::vector<double>& angle_;
  const float* row_;
};

/// 1 well within the range, 0 well beyond.
double fade(double x, double range) {
  const double square = x / range * (x / range);
  return 1 / (1 + square * square);
}

/// From 0 to 1 around 0.
double step(double x) { return 0.5 * (1 + x / std::sqrt(1 + x * x)); }

/// Reach of a bow's supernumeraries in Airy's units and at most in degrees; of the rings in x sin θ.
constexpr double bow_range_units = 25, bow_range_deg = 20, ring_range = 25;

}  // namespace

double FeatureTracks::Track::at_nm(double wavelength_nm) const {
  return horner(coefficients, (inverse_square(wavelength_nm) - centre) / half_range);
}

FeatureTracks::FeatureTracks(const std::vector<double>& angle_deg,
                             const std::vector<double>& wavelength_nm, std::span<const float> rows,
                             double size_um, bool rings_in_front)
    : rings_in_front_(rings_in_front) {
  assert(rows.size() == angle_deg.size() * wavelength_nm.size());
  if (wavelength_nm.size() < 3 || angle_deg.size() < 3) return;
  angle_deg_ = angle_deg;
  middle_nm_ = 0.5 * (wavelength_nm.front() + wavelength_nm.back());
  const double x = 2 * pi * size_um / um_from_nm(middle_nm_);
  // h^(1/3) x^(−2/3) with h = 4.87 for the first bow of water.
  unit_deg_ = degrees(1.695 * std::pow(x, -2.0 / 3));
  ring_range_deg_ = std::fmin(15.0, degrees(ring_range / x));

  const double tolerance_deg = 0.02 + 0.15 * unit_deg_;
  std::vector<std::optional<double>> first, second;
  for (std::size_t j = 0; j < wavelength_nm.size(); ++j)
    first.push_back(RowSearch(angle_deg, rows.data() + j * angle_deg.size()).primary());
  primary_ = track_through(wavelength_nm, first, tolerance_deg);
  if (!primary_.found) return;
  for (std::size_t j = 0; j < wavelength_nm.size(); ++j)
    second.push_back(RowSearch(angle_deg, rows.data() + j * angle_deg.size())
                         .secondary(primary_.at_nm(wavelength_nm[j])));
  secondary_ = track_through(wavelength_nm, second, 2 * tolerance_deg);
}

void FeatureTracks::movers(double wavelength_nm, std::span<Mover> mover) const {
  const double ratio = wavelength_nm / middle_nm_, unit = unit_deg_ * std::pow(ratio, 2.0 / 3);
  const double second_unit = 1.78 * unit;  // ∛(27.6/4.87): h of the second bow over h of the first
  const double rings = ring_range_deg_ * ratio;
  const double range = std::fmin(bow_range_units * unit, bow_range_deg);
  const double second_range = std::fmin(bow_range_units * second_unit, bow_range_deg);
  const double top = primary_.found ? primary_.at_nm(wavelength_nm) : 0;
  const double second_top = secondary_.found ? secondary_.at_nm(wavelength_nm) : 0;
  // The foot of the first bow reaches 4 units into the dark; two bows share the dark between them.
  const double border = secondary_.found ? 0.5 * (top + second_top) : top - 4 * unit - 2;
  const double border_width = secondary_.found ? (top - second_top) / 16 : 0.5 * unit + 0.5;
  for (std::size_t i = 0; i < angle_deg_.size(); ++i) {
    const double angle = angle_deg_[i];
    const double back = fade(180 - angle, rings), front = rings_in_front_ ? fade(angle, rings) : 0;
    const double rest = (1 - back) * (1 - front), behind = step((angle - border) / border_width);
    Mover m{};
    if (primary_.found)
      m.primary = rest * behind * fade(std::fmax(0.0, angle - top), range);
    if (secondary_.found)
      m.secondary =
          rest * (1 - behind) * fade(std::fmax(0.0, second_top - angle), second_range);
    m.opening = m.primary * (angle - top) + m.secondary * (angle - second_top);
    m.ring = front * angle - back * (180 - angle);
    mover[i] = m;
  }
}

FeatureTracks::Shift FeatureTracks::shift(double from_nm, double to_nm) const {
  const double ratio = to_nm / from_nm;
  return {primary_.found ? primary_.at_nm(to_nm) - primary_.at_nm(from_nm) : 0,
          secondary_.found ? secondary_.at_nm(to_nm) - secondary_.at_nm(from_nm) : 0,
          std::pow(ratio, 2.0 / 3) - 1, ratio - 1};
}

}  // namespace arcus::phase
