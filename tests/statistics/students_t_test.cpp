#include "tests/statistics/students_t.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/statistics/budget.h"
#include "tests/statistics/seed.h"

namespace arcus::statistics {

namespace {

Moments normal_numbers(std::uint64_t seed, int count, double mean, double deviation) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> distribution(mean, deviation);
  Moments moments;
  for (int i = 0; i < count; ++i) moments.add(distribution(generator));
  return moments;
}

}  // namespace

TEST(Sidak, GivesTheTotalBack) {
  for (const double n : {1.0, 7.0, 1e6})
    EXPECT_NEAR(-std::expm1(n * std::log1p(-sidak(1e-4, n))), 1e-4, 1e-12);
}

TEST(Moments, AgreeWithTheDefinitionFarFromZero) {
  Moments moments;
  for (const double x : {1e9 + 1, 1e9 + 2, 1e9 + 6}) moments.add(x);
  EXPECT_EQ(moments.count(), 3);
  EXPECT_NEAR(moments.mean(), 1e9 + 3, 1e-6);
  EXPECT_NEAR(moments.variance(), 7, 1e-9);
  EXPECT_NEAR(moments.standard_error(), std::sqrt(7.0 / 3), 1e-9);
}

TEST(Batches, LeaveOutAnUnfinishedOne) {
  Batches batches(10);
  for (int i = 0; i < 25; ++i) batches.add(i);
  EXPECT_EQ(batches.means().count(), 2);
  EXPECT_NEAR(batches.means().mean(), 9.5, 1e-12);
}

TEST(StudentsT, HasThePValuesOfTheTables) {
  // Abramowitz & Stegun, table 26.10.
  EXPECT_NEAR(students_p(12.706, 1), 0.05, 1e-5);
  EXPECT_NEAR(students_p(2.228, 10), 0.05, 1e-4);
  EXPECT_NEAR(students_p(-2.750, 30), 0.01, 1e-4);
}

TEST(StudentsT, AcceptsTheRightMean) {
  EXPECT_TRUE(mean_is(normal_numbers(test_seed(), 10'000, 3, 1), 3));
}

TEST(StudentsT, RejectsAMeanOffByTwoPercent) {
  for (std::uint64_t i = 0; i < 5; ++i)  // 2 % are 6 standard errors
    EXPECT_FALSE(mean_is(normal_numbers(test_seed(i), 100'000, 1.02, 1.0), 1));
}

TEST(StudentsT, RejectsByChanceAsOftenAsItSays) {
  // With 5 numbers only t, not z, keeps the level: at 5 % z would reject 12 %.
  int rejections = 0;
  const int experiments = 20'000;
  for (int i = 0; i < experiments; ++i) {
    const Moments m = normal_numbers(test_seed(static_cast<std::uint64_t>(i)), 5, 1, 1);
    rejections += students_p((m.mean() - 1) / m.standard_error(), 4) < 0.05;
  }
  EXPECT_NEAR(rejections, 0.05 * experiments, 4 * std::sqrt(0.05 * 0.95 * experiments));
}

TEST(StudentsT, AllowsASystematicDifferenceOnlyWhenTold) {
  const Moments found = normal_numbers(test_seed(), 1'000'000, 1.01, 0.1);
  EXPECT_FALSE(mean_is(found, 1));
  EXPECT_TRUE(mean_is(found, 1, {.tolerance = 0.0105}));
  EXPECT_FALSE(mean_is(found, 1, {.tolerance = 0.008}));
}

TEST(StudentsT, ComparesExactlyWhereNothingVaries) {
  Moments constant;
  for (int i = 0; i < 10; ++i) constant.add(0.25);
  EXPECT_TRUE(mean_is(constant, 0.25));
  EXPECT_FALSE(mean_is(constant, 0.2501));
}

TEST(StudentsT, RejectsWhatIsNoNumberOrTooFew) {
  Moments broken;
  broken.add(1);
  EXPECT_FALSE(mean_is(broken, 1));
  broken.add(std::nan(""));
  EXPECT_FALSE(mean_is(broken, 1));
  Moments infinite;
  infinite.add(1);
  infinite.add(INFINITY);
  EXPECT_FALSE(mean_is(infinite, 1));
}

TEST(Welch, AcceptsEqualMeansOfUnequalSpread) {
  EXPECT_TRUE(means_agree(normal_numbers(test_seed(0), 1000, 2, 5),
                          normal_numbers(test_seed(1), 20'000, 2, 0.1)));
}

TEST(Welch, RejectsMeansThatDifferByTwoPercent) {
  EXPECT_FALSE(means_agree(normal_numbers(test_seed(0), 100'000, 1.00, 0.5),
                           normal_numbers(test_seed(1), 100'000, 1.02, 0.8)));
}

TEST(StudentsT, ExplainsARejection) {
  const auto result = mean_is(normal_numbers(test_seed(), 1000, 2, 1), 1);
  ASSERT_FALSE(result);
  const std::string text = result.message();
  for (const char* part : {"mean", "of 1000", "expected 1", "t = ", "p = ", "TEST_SEED="})
    EXPECT_NE(text.find(part), std::string::npos) << part << " in " << text;
}

}  // namespace arcus::statistics
