#pragma once
// The scale of a chart's axis: its range, its ticks and their labels. Knows nothing of drawing.

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace arcus::render {

/// What a caller says about an axis.
struct Axis {
  std::string title;  ///< with its unit, as in "scattering angle [°]"
  bool is_logarithmic = false;
  std::optional<double> low = {}, high = {};  ///< ends; without them: around the data
  /// Logarithmic without `low`: data more decades below the largest do not widen the axis.
  double most_decades = 12;
};

struct Tick {
  double value;
  std::string label;  ///< empty: a small tick
};

/// An axis with its range settled: maps values to [0, 1] along it.
class Scale {
 public:
  /// `values`: all that shall fit, the not finite (and, where logarithmic, not positive) among them
  /// ignored. `is_tight`: the axis ends where the data do; otherwise at round numbers.
  Scale(const Axis& axis, std::span<const double> values, bool is_tight);
  double low() const { return low_; }
  double high() const { return high_; }
  bool is_logarithmic() const { return is_logarithmic_; }
  /// 0 at the low end, 1 at the high end; nothing where a value has no place (log of no positive
  /// number).
  std::optional<double> position(double value) const;
  /// About `wanted` labelled ticks and, where logarithmic, small ones between.
  std::vector<Tick> ticks(int wanted) const;

 private:
  bool is_logarithmic_;
  double low_, high_;
};

}  // namespace arcus::render
