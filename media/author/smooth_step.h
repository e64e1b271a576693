#pragma once

#include <algorithm>

namespace arcus::media {

/// From 0 (t ≤ 0) to 1 (t ≥ 1), without a kink at either end.
inline double smooth_step(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

}  // namespace arcus::media
