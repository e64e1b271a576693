#pragma once
// Are two pictures the same but for their noise?

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

namespace arcus::statistics {

/// One channel of a picture, rows from the top.
struct Picture {
  std::size_t width = 0;
  std::vector<double> mean;
  std::vector<double> variance_of_mean;  ///< of each pixel's mean; 0 for a picture known exactly
};

struct PictureOptions {
  int comparisons = 1;            ///< how many comparisons the test makes in all
  double relative_tolerance = 0;  ///< systematic difference allowed, times the mean of both
};

/// z of every pixel, and of the sum over all pixels, which sees a small difference that all of them
/// share; the budget is divided among all these. Variances may be estimates if each comes from at
/// least some 1000 samples with no heavy tail: z takes them as exact. Where both vanish, means must
/// be equal to within the tolerance and 1e-6 relative (floats). Values that are not finite,
/// negative variances and pictures of different or no size fail. A rejection shows the three worst
/// pixels.
testing::AssertionResult pictures_agree(const Picture& a, const Picture& b,
                                        PictureOptions options = {});

/// Two-sided p-value of a standard normal variable.
double normal_p(double z);

}  // namespace arcus::statistics
