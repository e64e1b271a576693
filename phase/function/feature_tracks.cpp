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
double fade(double x, double range) { return 1 / (1 + std::pow(x / range, 4)); }

double step(double x) { return 1 / (1 + std::exp(-x)); }

}  // namespace

double FeatureTracks::Track::at_nm(double wavelength_nm) const {
  return horner(coefficients, (inverse_square(wavelength_nm) - centre) / half_range);
}

FeatureTracks::FeatureTracks(const std::vector<double>& angle_deg, const std::vector<double>& wavelength_nm,
                             std::span<const float> rows, double size_um, bool rings_in_front) {
  assert(rows.size() == angle_deg.size() * wavelength_nm.size());
  if (wavelength_nm.size() < 3 || angle_deg.size() < 3) return;
  const double middle_nm = 0.5 * (wavelength_nm.front() + wavelength_nm.back());
  const double x = 2 * pi * size_um / um_from_nm(middle_nm);
  // Airy's unit of angle, h^(1/3) x^(−2/3) with h = 4.87 for the first and 27.6 for the second bow of water.
  const double unit = degrees(1.695 * std::pow(x, -2.0 / 3)), second_unit = 1.78 * unit;
  const double tolerance_deg = 0.02 + 0.15 * unit;

  std::vector<std::optional<double>> first, second;
  for (std::size_t j = 0; j < wavelength_nm.size(); ++j)
    first.push_back(RowSearch(angle_deg, rows.data() + j * angle_deg.size()).primary());
  primary_ = track_through(wavelength_nm, first, tolerance_deg);
  if (primary_.found) {
    for (std::size_t j = 0; j < wavelength_nm.size(); ++j)
      second.push_back(RowSearch(angle_deg, rows.data() + j * angle_deg.size()).secondary(primary_.at_nm(wavelength_nm[j])));
    secondary_ = track_through(wavelength_nm, second, 2 * tolerance_deg);
  }

  const double top = primary_.found ? primary_.at_nm(middle_nm) : 0;
  const double second_top = secondary_.found ? secondary_.at_nm(middle_nm) : 0;
  // The foot of the first bow reaches 4 units into the dark; with a second bow the two share the dark between them.
  const double border = secondary_.found ? 0.5 * (top + second_top) : top - 4 * unit - 2;
  const double border_width = secondary_.found ? (top - second_top) / 16 : 0.5 * unit + 0.5;
  const double ring_range = std::fmin(15.0, degrees(25 / x)), bow_range = 12;  // in degrees, in units
  for (const double angle : angle_deg) {
    Mover m{};
    const double back = fade(180 - angle, ring_range), front = rings_in_front ? fade(angle, ring_range) : 0;
    const double rest = (1 - back) * (1 - front);
    const double behind = step((angle - border) / border_width);
    if (primary_.found) {
      m.primary = rest * behind * (angle > top ? fade(angle - top, bow_range * unit) : 1);
      m.primary_opening = m.primary * (angle - top);
    }
    if (secondary_.found) {
      m.secondary = rest * (1 - behind) * (angle < second_top ? fade(second_top - angle, bow_range * second_unit) : 1);
      m.secondary_opening = m.secondary * (angle - second_top);
    }
    m.ring = front * angle - back * (180 - angle);
    mover_.push_back(m);
  }
}

void FeatureTracks::displacements_deg(double from_nm, double to_nm, std::span<double> displacement_deg) const {
  const double ratio = to_nm / from_nm, ring = ratio - 1, opening = std::pow(ratio, 2.0 / 3) - 1;
  const double first = primary_.found ? primary_.at_nm(to_nm) - primary_.at_nm(from_nm) : 0;
  const double second = secondary_.found ? secondary_.at_nm(to_nm) - secondary_.at_nm(from_nm) : 0;
  for (std::size_t i = 0; i < mover_.size(); ++i) {
    const Mover& m = mover_[i];
    displacement_deg[i] = m.primary * first + m.secondary * second +
                          (m.primary_opening + m.secondary_opening) * opening + m.ring * ring;
  }
}

}  // namespace arcus::phase
