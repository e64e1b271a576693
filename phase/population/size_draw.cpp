#include "phase/population/size_draw.h"

#include <algorithm>
#include <cmath>

namespace arcus::phase {

SizeDraw::SizeDraw(const Sizes& sizes) {
  if (sizes.effective_variance() < 1e-12) {
    radius_um_ = {sizes.effective_radius_um()};
    mean_square_um2_ = radius_um_[0] * radius_um_[0];
    return;
  }
  constexpr int steps = 4096;
  const auto range = sizes.range_um(1e-6);
  const double ratio = std::log(range.high_um / range.low_um) / steps;
  double sum = 0, squares = 0;
  for (int i = 0; i <= steps; ++i) {
    const double r = range.low_um * std::exp(ratio * i);
    radius_um_.push_back(r);
    if (i > 0) {
      const double middle = range.low_um * std::exp(ratio * (i - 0.5)), before = radius_um_[static_cast<std::size_t>(i) - 1];
      const double share = sizes.number_per_um(middle) * (r - before);
      sum += share;
      squares += share * (r * r + r * before + before * before) / 3;  // evenly spread between the two, as it is drawn
    }
    cumulative_.push_back(sum);
  }
  for (double& c : cumulative_) c /= sum;
  mean_square_um2_ = squares / sum;
}

double SizeDraw::radius_um(double u) const {
  if (cumulative_.empty()) return radius_um_[0];
  const auto above = std::upper_bound(cumulative_.begin() + 1, cumulative_.end() - 1, u);
  const auto i = static_cast<std::size_t>(above - cumulative_.begin());
  const double width = cumulative_[i] - cumulative_[i - 1];
  const double t = width > 0 ? std::clamp((u - cumulative_[i - 1]) / width, 0.0, 1.0) : 0;
  return radius_um_[i - 1] + t * (radius_um_[i] - radius_um_[i - 1]);
}

}  // namespace arcus::phase
