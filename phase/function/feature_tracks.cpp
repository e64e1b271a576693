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

using Positions = std::vector<std::optional<double>>;  // [wavelength], where found [deg]

/// A smooth curve through the longest run of positions found at neighbouring wavelengths. Not found
/// where the run is shorter than `least`, or its positions do not lie on such a curve.
FeatureTracks::Track track_through(const std::vector<double>& wavelength_nm,
                                   const Positions& position_deg, std::size_t least,
                                   double tolerance_deg) {
  std::size_t first = 0, count = 0;
  for (std::size_t i = 0, run = 0; i < position_deg.size(); ++i) {
    run = position_deg[i] ? run + 1 : 0;
    if (run > count) {
      count = run;
      first = i + 1 - run;
    }
  }
  FeatureTracks::Track track;
  if (count < std::max<std::size_t>(3, least)) return track;
  track.first_nm = wavelength_nm[first];
  track.last_nm = wavelength_nm[first + count - 1];
  const double a = inverse_square(track.first_nm), b = inverse_square(track.last_nm);
  track.centre = 0.5 * (a + b);
  track.half_range = 0.5 * (a - b);
  std::vector<double> x, y;
  for (std::size_t i = first; i < first + count; ++i) {
    x.push_back((inverse_square(wavelength_nm[i]) - track.centre) / track.half_range);
    y.push_back(*position_deg[i]);
  }
  track.coefficients = fit(x, y, count >= 8 ? 4 : count >= 5 ? 3 : 2);
  double squares = 0;
  for (std::size_t i = 0; i < count; ++i)
    squares += std::pow(y[i] - horner(track.coefficients, x[i]), 2);
  track.found = std::sqrt(squares / static_cast<double>(count)) < tolerance_deg;
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

  /// The largest value between 110° and 165°, where the first bow of everything with an index from
  /// 1.2 to 1.5 lies.
  std::optional<double> primary() const {
    const int from = node_after(110), to = node_after(165);
    const int top = static_cast<int>(std::max_element(row_ + from, row_ + to) - row_);
    if (top == from || top >= to - 1 || top + 1 >= static_cast<int>(angle_.size())) return {};
    return vertex(&angle_[top - 1], row_ + top - 1);
  }

  /// The highest maximum of its surroundings on the way forward from the first bow's foot.
  std::optional<double> secondary(double primary_deg) const {
    return highest(primary_deg - 25, primary_deg - 3, 1.0, 1.1f, false);
  }

  /// The highest maximum in the dark between the two: a bow of higher order, the fifth in water.
  std::optional<double> faint(double secondary_deg, double primary_deg) const {
    return highest(secondary_deg + 1.5, primary_deg - 1.5, 0.5, 1.03f, true);
  }

 private:
  /// The highest of the nodes that are highest within `range` of them and rise by `rise` above the
  /// lowest value found behind them, and also in front of them where `both_sides`.
  std::optional<double> highest(double from_deg, double to_deg, double range_deg, float rise,
                                bool both_sides) const {
    const int from = std::max(1, node_after(from_deg)), to = node_after(to_deg);
    float behind = row_[to];
    int top = 0;
    for (int i = to; i > from; --i) {
      behind = std::min(behind, row_[i]);
      if (row_[i] <= rise * behind || (top > 0 && row_[i] <= row_[top])) continue;
      if (both_sides && row_[i] <= rise * *std::min_element(row_ + from, row_ + i)) continue;
      if (is_highest_within(i, range_deg)) top = i;
    }
    if (top == 0) return {};
    return vertex(&angle_[top - 1], row_ + top - 1);
  }

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

/// From 0 at −1 to 1 at 1, smoothly.
double step(double x) {
  const double t = std::clamp(0.5 * (x + 1), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

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

  const std::size_t count = wavelength_nm.size(), most = (4 * count + 4) / 5;
  const auto search = [&](auto find, std::size_t least, double tolerance_deg) {
    Positions positions;
    for (std::size_t j = 0; j < count; ++j)
      positions.push_back(find(RowSearch(angle_deg, rows.data() + j * angle_deg.size()), wavelength_nm[j]));
    return track_through(wavelength_nm, positions, least, tolerance_deg);
  };
  const double tolerance_deg = 0.02 + 0.15 * unit_deg_;
  primary_ = search([](const RowSearch& row, double) { return row.primary(); }, most, tolerance_deg);
  if (!primary_.found) return;
  secondary_ = search(
      [&](const RowSearch& row, double nm) { return row.secondary(primary_.at_nm(nm)); }, most,
      2 * tolerance_deg);
  if (!secondary_.found) return;
  faint_ = search(
      [&](const RowSearch& row, double nm) {
        return row.faint(secondary_.at_nm(nm), primary_.at_nm(nm));
      },
      6, 2 * tolerance_deg);
}

void FeatureTracks::movers(double wavelength_nm, double low_nm, double high_nm,
                           std::span<Mover> mover) const {
  const double ratio = wavelength_nm / middle_nm_, unit = unit_deg_ * std::pow(ratio, 2.0 / 3);
  const double second_unit = 1.78 * unit;  // ∛(27.6/4.87): h of the second bow over h of the first
  const double rings = ring_range_deg_ * ratio;
  const double range = std::fmin(bow_range_units * unit, bow_range_deg);
  const double second_range = std::fmin(bow_range_units * second_unit, bow_range_deg);
  const double top = primary_.found ? primary_.at_nm(wavelength_nm) : 0;
  const double second_top = secondary_.found ? secondary_.at_nm(wavelength_nm) : 0;
  const bool faint = faint_.found && low_nm >= faint_.first_nm && high_nm <= faint_.last_nm;
  const double faint_top = faint ? faint_.at_nm(wavelength_nm) : 0;
  // Where the first bow's foot begins, and where the second bow's ends; two bows share the dark
  // between them. Of the faint bow only the top goes its own way: its supernumeraries overlap the
  // first bow's foot, and where two bows overlap the stronger one is followed.
  double border = top - 4 * unit - 2, border_width = unit + 1;
  double second_border = -360, second_border_width = 1;
  if (faint) {
    border = faint_top + 0.6;
    border_width = 0.6;
    second_border = 0.5 * (second_top + 3 * second_unit + faint_top);
    second_border_width = std::fmax(0.3, 0.5 * (faint_top - second_top) - 1.5 * second_unit);
  } else if (secondary_.found) {
    border = 0.5 * (top + second_top);
    border_width = (top - second_top) / 4;
  }
  for (std::size_t i = 0; i < angle_deg_.size(); ++i) {
    const double angle = angle_deg_[i];
    const double back = fade(180 - angle, rings), front = rings_in_front_ ? fade(angle, rings) : 0;
    const double rest = (1 - back) * (1 - front);
    const double behind = step((angle - border) / border_width);
    const double before = 1 - behind;
    Mover m{};
    if (primary_.found) m.primary = rest * behind * fade(std::fmax(0.0, angle - top), range);
    if (faint) m.faint = rest * before * step((angle - second_border) / second_border_width);
    if (secondary_.found)
      m.secondary =
          (rest * before - m.faint) * fade(std::fmax(0.0, second_top - angle), second_range);
    m.opening = m.primary * (angle - top) + m.secondary * (angle - second_top) +
                m.faint * (angle - faint_top);
    m.ring = front * angle - back * (180 - angle);
    mover[i] = m;
  }
}

FeatureTracks::Shift FeatureTracks::shift(double from_nm, double to_nm) const {
  const double ratio = to_nm / from_nm;
  return {primary_.found ? primary_.at_nm(to_nm) - primary_.at_nm(from_nm) : 0,
          secondary_.found ? secondary_.at_nm(to_nm) - secondary_.at_nm(from_nm) : 0,
          faint_.found ? faint_.at_nm(to_nm) - faint_.at_nm(from_nm) : 0,
          std::pow(ratio, 2.0 / 3) - 1, ratio - 1};
}

}  // namespace arcus::phase
