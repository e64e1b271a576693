#include "phase/settings/keys.h"

#include <cmath>

#include "phase/settings/number_text.h"

namespace arcus {

bool Range::contains(double x) const {
  if (!std::isfinite(x)) return false;
  return (low_excluded ? x > low : x >= low) && (high_excluded ? x < high : x <= high);
}

std::string Range::words() const {
  const bool has_low = std::isfinite(low), has_high = std::isfinite(high);
  if (!has_low && !has_high) return "must be a finite number";
  if (has_low && has_high && !low_excluded && !high_excluded)
    return "must be between " + number_text(low) + " and " + number_text(high);
  std::string text = "must be ";
  if (has_low) text += (low_excluded ? "above " : "at least ") + number_text(low);
  if (has_low && has_high) text += " and ";
  if (has_high) text += (high_excluded ? "below " : "at most ") + number_text(high);
  return text;
}

}  // namespace arcus
