#pragma once
// Is a mean what it should be? Are two means equal? With their standard errors.

#include <gtest/gtest.h>

#include "tests/statistics/moments.h"

namespace arcus::statistics {

struct MeanOptions {
  /// How many comparisons the test makes in all; they share its budget of false alarms.
  int comparisons = 1;
  /// Systematic difference that is allowed, absolute: rounding of floats, a known quadrature error.
  /// Only what exceeds it is held against the standard error.
  double tolerance = 0;
};

/// Two-sided p-value of Student's t with the given (real) degrees of freedom > 0.
double students_p(double t, double degrees);

/// Student's t of a mean against a value. The numbers added must be independent; where single ones
/// have a heavy tail, add means of ≥ 1000 batches. Numbers without any spread must meet the value
/// to within the tolerance and 1e-12 relative. Fewer than 2 numbers, or one not finite, fail.
testing::AssertionResult mean_is(const Moments& found, double expected, MeanOptions options = {});

/// Welch's t of two independent means whose variances may differ (Welch, Biometrika 34 (1947), 28).
testing::AssertionResult means_agree(const Moments& a, const Moments& b, MeanOptions options = {});

}  // namespace arcus::statistics
