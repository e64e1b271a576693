#pragma once
// Quantiles of the normal distribution.

#include <cmath>
#include <vector>

namespace arcus {

/// The number that a standard normal variable stays below with this probability, in (0, 1); by halving.
inline double normal_quantile(double probability) {
  double low = -10, high = 10;
  while (high - low > 1e-12) {
    const double middle = 0.5 * (low + high);
    (0.5 * std::erfc(-middle / std::sqrt(2.0)) < probability ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// exp(mean + width · normal) at the middles of `count` equal shares of probability.
inline std::vector<double> log_normal_middles(double mean, double width, int count) {
  std::vector<double> middles;
  for (int i = 0; i < count; ++i) middles.push_back(std::exp(mean + width * normal_quantile((i + 0.5) / count)));
  return middles;
}

}  // namespace arcus
