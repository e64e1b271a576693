#pragma once
// How often a statistical test may reject although nothing is wrong: once in 10⁴ runs, whatever the
// number of comparisons it makes. Seeds are fixed, so a test that passes keeps passing; sweeping a
// suite of 200 such tests over new seeds is wrong once in fifty sweeps.

#include <cmath>

namespace arcus::statistics {

/// Probability that one statistical test (one TEST, with all its comparisons) rejects by chance.
inline constexpr double false_alarms_per_test = 1e-4;

/// Šidák's share: the level at which each of `comparisons` ≥ 1 independent comparisons is made so
/// that all of them together reject by chance with probability `total`.
inline double sidak(double total, double comparisons) {
  return -std::expm1(std::log1p(-total) / comparisons);
}

}  // namespace arcus::statistics
