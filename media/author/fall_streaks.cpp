#include "media/author/fall_streaks.h"

#include <algorithm>

#include "phase/base/frame.h"

namespace arcus::media {
namespace {

constexpr int steps = 1024;

}  // namespace

FallStreaks::FallStreaks(const WindShear& shear, double depth_m, const std::function<double(double)>& fall_speed_m_per_s)
    : step_m_(depth_m / steps), nodes_(1) {
  for (int i = 0; i < steps; ++i) {
    const double depth = (i + 0.5) * step_m_, seconds = step_m_ / fall_speed_m_per_s(depth);
    const Vec3 wind = direction_of(shear.azimuth_deg + shear.turn_deg * depth / depth_m, 0) * (shear.per_s * depth);
    nodes_.push_back({nodes_.back().drift_m + wind * seconds, nodes_.back().time_s + seconds});
  }
}

Vec3 FallStreaks::drift_m(double depth_m) const {
  const double place = std::clamp(depth_m / step_m_, 0.0, static_cast<double>(steps));
  const auto i = std::min(static_cast<std::size_t>(place), static_cast<std::size_t>(steps - 1));
  const double share = place - static_cast<double>(i);
  return nodes_[i].drift_m * (1 - share) + nodes_[i + 1].drift_m * share;
}

double FallStreaks::time_s(double depth_m) const {
  const double place = std::clamp(depth_m / step_m_, 0.0, static_cast<double>(steps));
  const auto i = std::min(static_cast<std::size_t>(place), static_cast<std::size_t>(steps - 1));
  const double share = place - static_cast<double>(i);
  return nodes_[i].time_s * (1 - share) + nodes_[i + 1].time_s * share;
}

}  // namespace arcus::media
