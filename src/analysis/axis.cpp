#include "src/analysis/axis.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace arcus::render {
namespace {

/// 1, 2 or 5 times a power of ten, near `rough` and not below.
double round_step(double rough) {
  const double power = std::pow(10, std::floor(std::log10(rough)));
  for (const double step : {1.0, 2.0, 5.0})
    if (rough <= step * power * (1 + 1e-9)) return step * power;
  return 10 * power;
}

/// Angles are divided as a circle is.
double step_of(double span, int wanted) {
  const double rough = span / wanted;
  if (span > 89 && span <= 361)
    for (const double step : {10.0, 15.0, 20.0, 30.0, 45.0, 60.0})
      if (rough <= step * 1.01) return step;
  return round_step(rough);
}

/// A power of ten with the exponent raised.
std::string power_label(int exponent) {
  static const char* const digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "10⁻" : "10";
  for (const char c : std::to_string(std::abs(exponent))) text += digits[c - '0'];
  return text;
}

/// A number with as many decimals as its step needs; a true minus sign.
std::string decimal_label(double value, double step) {
  if (std::fabs(value) < 1e-9 * step) value = 0;
  char text[40];
  const double largest = std::fabs(value);
  if (value != 0 && (largest >= 1e6 || step < 1e-5)) {
    const int exponent = static_cast<int>(std::floor(std::log10(largest) + 1e-12));
    std::snprintf(text, sizeof text, "%.3g", value / std::pow(10, exponent));
    return std::string(text) + "·" + power_label(exponent);
  }
  const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 8);
  std::snprintf(text, sizeof text, "%.*f", decimals, std::fabs(value));
  return (value < 0 ? "−" : "") + std::string(text);
}

}  // namespace

Scale::Scale(const Axis& axis, std::span<const double> values, bool is_tight)
    : is_logarithmic_(axis.is_logarithmic) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const double v : values) {
    if (!std::isfinite(v) || (is_logarithmic_ && v <= 0)) continue;
    least = std::min(least, v);
    most = std::max(most, v);
  }
  if (!(least <= most)) {
    least = is_logarithmic_ ? 0.1 : 0;
    most = 1;
  }
  if (is_logarithmic_) {
    least = std::max(least, most * std::pow(10, -axis.most_decades));
    low_ = least;
    high_ = most;
    if (!is_tight) {
      // Whole decades, unless there are so few that they would leave much of the axis empty.
      const bool is_short = std::log10(most / least) < 2;
      low_ = is_short ? 1 / round_step(1 / (least * (1 + 1e-9)))
                      : std::pow(10, std::floor(std::log10(least) + 1e-9));
      high_ = is_short ? round_step(most) : std::pow(10, std::ceil(std::log10(most) - 1e-9));
    }
    if (!(low_ < high_)) high_ = 10 * low_;
  } else if (is_tight) {
    low_ = least;
    high_ = most;
  } else {
    // Data that are all of one sign and come near 0 show it: heights are then comparable.
    if (least > 0 && least < 0.5 * most) least = 0;
    if (most < 0 && most > 0.5 * least) most = 0;
    const double step = most > least ? step_of(most - least, 6) : 1;
    low_ = step * std::floor(least / step + 1e-9);
    high_ = step * std::ceil(most / step - 1e-9);
    if (most > high_ - 0.02 * (high_ - low_) && most != 0)
      high_ += 0.5 * step;  // nothing lies on the frame
  }
  low_ = axis.low.value_or(low_);
  high_ = axis.high.value_or(high_);
  if (!(low_ < high_)) high_ = low_ + (low_ == 0 ? 1 : std::fabs(low_));
}

std::optional<double> Scale::position(double value) const {
  if (!std::isfinite(value) || (is_logarithmic_ && value <= 0)) return std::nullopt;
  if (is_logarithmic_) return std::log(value / low_) / std::log(high_ / low_);
  return (value - low_) / (high_ - low_);
}

std::vector<Tick> Scale::ticks(int wanted) const {
  std::vector<Tick> ticks;
  if (!is_logarithmic_) {
    const double step = step_of(high_ - low_, wanted);
    for (double k = std::ceil(low_ / step - 1e-9); k * step <= high_ + 1e-9 * step; ++k)
      ticks.push_back({k * step, decimal_label(k * step, step)});
    return ticks;
  }
  const double decades = std::log10(high_ / low_);
  const int first = static_cast<int>(std::floor(std::log10(low_) + 1e-9));
  const int last = static_cast<int>(std::ceil(std::log10(high_) - 1e-9));
  const int every = std::max(1, static_cast<int>(std::ceil(decades / wanted - 1e-9)));
  for (int e = first; e <= last; ++e) {
    for (int digit = 1; digit < 10; ++digit) {
      const double value = digit * std::pow(10, e);
      if (value < low_ * (1 - 1e-9) || value > high_ * (1 + 1e-9)) continue;
      // With little more than a decade, powers of ten alone would leave an axis without numbers.
      const bool is_power = digit == 1 && e % every == 0;
      const bool is_between = decades < 1.7 && (digit == 2 || digit == 5);
      if (is_between || (is_power && decades < 1.7))
        ticks.push_back({value, decimal_label(value, value)});
      else if (is_power)
        ticks.push_back({value, power_label(e)});
      else if (every == 1)
        ticks.push_back({value, ""});
    }
  }
  return ticks;
}

}  // namespace arcus::render
