#include "media/air/exponential_layer.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "phase/base/units.h"

namespace arcus::media {
namespace {

/// Cubic pieces in t = 4 / (4 + z) of z-scaled values: erfcx(z) / t is smooth down to t = 0, where it is 1 / (4 √π).
class ScaledErfc {
 public:
  ScaledErfc() {
    for (int i = 0; i <= cells; ++i) {
      const double t = static_cast<double>(i) / cells;
      if (i == 0) {
        nodes_[0] = {1 / (4 * std::sqrt(pi)), 1 / (4 * std::sqrt(pi)) / cells};
        continue;
      }
      const double z = 4 / t - 4, value = slowly(z), slope_z = 2 * z * value - 2 / std::sqrt(pi);
      // d(value / t)/dt with dz/dt = −4 / t². For large z the slope is the small difference of large numbers: −erfcx'(z) by its own series.
      const double slope = z < 30 ? slope_z : -(1 - 3 / (2 * z * z) + 15 / (4 * z * z * z * z) - 105 / (8 * std::pow(z, 6))) / (std::sqrt(pi) * z * z);
      nodes_[static_cast<std::size_t>(i)] = {value / t, (slope * (-4 / (t * t)) / t - value / (t * t)) / cells};
    }
  }

  double at(double z) const {
    const double t = 4 / (4 + z), place = t * cells;
    const int cell = std::min(static_cast<int>(place), cells - 1);
    const double u = place - cell;
    const Node &a = nodes_[static_cast<std::size_t>(cell)], &b = nodes_[static_cast<std::size_t>(cell) + 1];
    const double rise = b.value - a.value;
    return t * (a.value + u * (a.slope + u * (3 * rise - 2 * a.slope - b.slope + u * (a.slope + b.slope - 2 * rise))));
  }

 private:
  static constexpr int cells = 2048;
  struct Node {
    double value, slope;  ///< slope: per cell
  };

  /// By the library's erfc, or the continued fraction (Abramowitz and Stegun 7.1.14) from below.
  static double slowly(double z) {
    if (z < 4) return std::exp(z * z) * std::erfc(z);
    double fraction = z;
    for (int k = 60; k >= 1; --k) fraction = z + 0.5 * k / fraction;
    return 1 / (std::sqrt(pi) * fraction);
  }

  std::array<Node, cells + 1> nodes_;
};

}  // namespace

double scaled_erfc(double z) {
  static const ScaledErfc table;
  return table.at(z);
}

double way_to_space_m(double height_m, double climb, double scale_height_m, double radius_m) {
  // With r from the centre, p its least along the line and x = r − r₀: ds = r / √(r + p) dx / √(x + u₀), u₀ = r₀ − p. The first factor changes over the
  // planet's radius, e^(−x/H) over H: three terms of its Taylor series around r₀ are good to some (H/r₀)³. The integrals of xⁿ e^(−x/H) / √(x + u₀)
  // follow from the first, √(πH) erfcx(√(u₀/H)), by parts.
  const double r = radius_m + height_m, c = std::min(1.0, std::max(0.0, climb)), sine = std::sqrt(1 - c * c), h = scale_height_m;
  const double u = r * c * c / (1 + sine), p = r - u, q2 = r + p, per_q = 1 / std::sqrt(q2), per_q3 = per_q / q2;
  const double root = std::sqrt(u), i0 = std::sqrt(pi * h) * scaled_erfc(std::sqrt(u / h));
  const double j1 = h * (root + 0.5 * i0), j2 = h * (u * root + 1.5 * j1);
  const double i1 = j1 - u * i0, i2 = j2 - 2 * u * j1 + u * u * i0;
  return std::exp(-height_m / h) * (r * per_q * i0 + 0.5 * (r + 2 * p) * per_q3 * i1 - (r + 4 * p) * per_q3 / (8 * q2) * i2);
}

}  // namespace arcus::media
