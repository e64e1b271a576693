#include <gtest/gtest.h>

#include <random>

#include "src/analysis/drops_comparison.h"
#include "tests/statistics/moments.h"
#include "tests/statistics/seed.h"

namespace arcus::render {
namespace {

std::vector<std::vector<double>> runs_of(std::mt19937_64& random, double scale) {
  std::vector<std::vector<double>> runs(16, std::vector<double>(40));
  for (auto& run : runs)
    for (std::size_t i = 0; i < run.size(); ++i) run[i] = scale * std::normal_distribution(1.0 + static_cast<double>(i), 0.3)(random);
  return runs;
}

}  // namespace

TEST(DropsAgreement, ChanceAloneGivesWhatIsExpected) {
  std::mt19937_64 random(statistics::test_seed());
  statistics::Moments sigma, ratio, share;
  for (int i = 0; i < 400; ++i) {
    const Agreement a = agreement_of(runs_of(random, 1), runs_of(random, 1));
    EXPECT_EQ(a.places, 40u);
    sigma.add(a.sigma);
    ratio.add(a.chi_square / a.expected);
    share.add((a.mean_ratio - 1) / a.mean_ratio_error);
  }
  EXPECT_NEAR(ratio.mean(), 1, 4 * ratio.standard_error());
  EXPECT_NEAR(share.mean(), 0, 4 * share.standard_error());
  // Squares of Student's t scatter a little more than those of the normal distribution.
  EXPECT_LT(std::fabs(sigma.mean()), 0.3);
}

TEST(DropsAgreement, SeesWhatDiffers) {
  std::mt19937_64 random(statistics::test_seed());
  const Agreement a = agreement_of(runs_of(random, 1.02), runs_of(random, 1));
  EXPECT_GT(a.sigma, 5);
  EXPECT_NEAR(a.mean_ratio, 1.02, 4 * a.mean_ratio_error);
}

}  // namespace arcus::render
