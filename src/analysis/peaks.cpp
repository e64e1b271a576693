#include "src/analysis/peaks.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace arcus::render {
namespace {

/// Lowest value between `top` and the nearest higher point in one direction (step +1 or -1), or the
/// end of the curve.
double valley(std::span<const double> y, std::ptrdiff_t top, std::ptrdiff_t step) {
  const auto size = static_cast<std::ptrdiff_t>(y.size());
  const auto at = [&](std::ptrdiff_t i) { return y[static_cast<std::size_t>(i)]; };
  double lowest = at(top);
  for (std::ptrdiff_t i = top + step; i >= 0 && i < size && at(i) <= at(top); i += step)
    lowest = std::min(lowest, at(i));
  return lowest;
}

/// The vertex of the least-squares parabola through points first to last (included).
Peak fitted(std::span<const double> x, std::span<const double> y, std::size_t top,
            std::size_t first, std::size_t last) {
  // Normal equations for y = a + b t + c t², with t measured from the top in units of half the
  // width.
  const double scale = 0.5 * (x[last] - x[first]);
  double s[5] = {}, r[3] = {};
  for (std::size_t i = first; i <= last; ++i) {
    const double t = (x[i] - x[top]) / scale;
    double power = 1;
    for (int k = 0; k < 5; ++k, power *= t) {
      s[k] += power;
      if (k < 3) r[k] += power * y[i];
    }
  }
  const double determinant = s[0] * (s[2] * s[4] - s[3] * s[3]) -
                             s[1] * (s[1] * s[4] - s[2] * s[3]) +
                             s[2] * (s[1] * s[3] - s[2] * s[2]);
  const double a = (r[0] * (s[2] * s[4] - s[3] * s[3]) - s[1] * (r[1] * s[4] - s[3] * r[2]) +
                    s[2] * (r[1] * s[3] - s[2] * r[2])) /
                   determinant;
  const double b = (s[0] * (r[1] * s[4] - s[3] * r[2]) - r[0] * (s[1] * s[4] - s[2] * s[3]) +
                    s[2] * (s[1] * r[2] - r[1] * s[2])) /
                   determinant;
  const double c = (s[0] * (s[2] * r[2] - r[1] * s[3]) - s[1] * (s[1] * r[2] - r[1] * s[2]) +
                    r[0] * (s[1] * s[3] - s[2] * s[2])) /
                   determinant;
  const double t = c < 0 ? -b / (2 * c) : 0;
  const double low = (x[first] - x[top]) / scale, high = (x[last] - x[top]) / scale;
  if (!(t >= low && t <= high)) return {x[top], y[top], 0};
  return {x[top] + t * scale, a + t * (b + t * c), 0};
}

}  // namespace

std::vector<Peak> find_peaks(std::span<const double> x, std::span<const double> y,
                             std::span<const double> errors, double least_share) {
  assert(x.size() == y.size() && (errors.empty() || errors.size() == y.size()));
  std::vector<Peak> peaks;
  if (x.size() < 3) return peaks;
  const auto [lowest, highest] = std::minmax_element(y.begin(), y.end());
  const double least = least_share * (*highest - *lowest);
  for (std::size_t top = 1; top + 1 < y.size(); ++top) {
    if (!(y[top] > y[top - 1])) continue;
    std::size_t plateau = top;  // equal values count as one top
    while (plateau + 1 < y.size() && y[plateau + 1] == y[top]) ++plateau;
    if (plateau + 1 == y.size() || y[plateau + 1] > y[top]) continue;
    const auto middle = static_cast<std::ptrdiff_t>(top);
    const double prominence = y[top] - std::max(valley(y, middle, -1), valley(y, middle, 1));
    if (!(prominence > 0) || prominence < least ||
        (!errors.empty() && prominence < 5 * errors[top]))
      continue;
    const double threshold = y[top] - 0.25 * prominence;
    std::size_t first = top - 1, last = plateau + 1;
    while (first > 0 && y[first - 1] >= threshold && y[first] >= threshold) --first;
    while (last + 1 < y.size() && y[last + 1] >= threshold && y[last] >= threshold) ++last;
    Peak peak = fitted(x, y, top, first, last);
    peak.prominence = prominence;
    peaks.push_back(peak);
  }
  return peaks;
}

}  // namespace arcus::render
