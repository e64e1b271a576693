#include "tests/statistics/chi_square.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>

#include "phase/base/units.h"
#include "tests/statistics/cells.h"
#include "tests/statistics/seed.h"

namespace arcus::statistics {

namespace {

using Generator = std::mt19937_64;

double uniform(Generator& generator) { return static_cast<double>(generator() >> 11) * 0x1p-53; }

/// Density (1 + tilt (2x - 1)) on [0, 1].
double draw_tilted(Generator& generator, double tilt) {
  const double u = uniform(generator);
  if (tilt == 0) return u;
  // Root of (1 - tilt) x + tilt x^2 = u.
  return 2 * u / (1 - tilt + std::sqrt((1 - tilt) * (1 - tilt) + 4 * tilt * u));
}

testing::AssertionResult uniformity(int draws, double tilt, std::uint64_t seed) {
  const IntervalCells cells([](double) { return 1.0; }, 0, 1, 50);
  Tally tally(cells);
  Generator generator(seed);
  for (int i = 0; i < draws; ++i) tally.add(draw_tilted(generator, tilt));
  return chi_square(tally);
}

Vec3 draw_peak(Generator& generator, const Frame& frame, double g) {
  const double u = uniform(generator);
  const double root = (1 - g * g) / (1 - g + 2 * g * u);
  const double cosine = (1 + g * g - root * root) / (2 * g);
  return direction_at(frame, 0.5 * (1 - cosine), 2 * pi * uniform(generator));
}

double peak(double g, double s) {
  return (1 - g * g) / (4 * pi * std::pow((1 - g) * (1 - g) + 4 * g * s, 1.5));
}

}  // namespace

TEST(ChiSquare, HasThePValuesOfTheTables) {
  // Abramowitz & Stegun, table 26.8.
  EXPECT_NEAR(chi_square_p(3.84146, 1), 0.05, 1e-6);
  EXPECT_NEAR(chi_square_p(18.3070, 10), 0.05, 1e-5);
  EXPECT_NEAR(chi_square_p(59.7031, 30), 0.001, 1e-7);
}

TEST(ChiSquare, AcceptsDrawsFromTheDensity) { EXPECT_TRUE(uniformity(1'000'000, 0, test_seed())); }

TEST(ChiSquare, RejectsATiltOfTwoPercentAtAMillionDraws) {
  for (std::uint64_t i = 0; i < 5; ++i) EXPECT_FALSE(uniformity(1'000'000, 0.02, test_seed(i)));
}

TEST(ChiSquare, RejectsByChanceAsOftenAsItSays) {
  // p-values of 2000 honest experiments are uniform: Kolmogorov-Smirnov, critical value for 1e-4.
  std::vector<double> p;
  Generator generator(test_seed());
  for (int experiment = 0; experiment < 2000; ++experiment) {
    std::vector<std::int64_t> counts(20);
    for (int i = 0; i < 2000; ++i) ++counts[static_cast<std::size_t>(20 * uniform(generator))];
    double x = 0;
    for (const auto n : counts)
      x += (static_cast<double>(n) - 100) * (static_cast<double>(n) - 100) / 100;
    p.push_back(chi_square_p(x, 19));
  }
  std::sort(p.begin(), p.end());
  double distance = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    distance = std::max(distance, std::fabs(p[i] - static_cast<double>(i) / 2000));
    distance = std::max(distance, std::fabs(p[i] - static_cast<double>(i + 1) / 2000));
  }
  EXPECT_LT(distance, std::sqrt(std::log(2 / 1e-4) / 2 / 2000));
}

TEST(ChiSquare, AcceptsAForwardPeakOnTheSphere) {
  const double g = 0.99;
  const Frame frame = frame_around(normalize(Vec3(0.2, 0.5, -0.7)));
  const SphereCells cells([&](const Vec3& d) { return peak(g, sin2_half_angle(frame.along, d)); },
                          frame.along, 64);
  Tally tally(cells);
  Generator generator(test_seed());
  for (int i = 0; i < 300'000; ++i) tally.add(draw_peak(generator, frame, g));
  EXPECT_TRUE(chi_square(tally));
}

TEST(ChiSquare, RejectsAnAsymmetryOffByAHundredth) {
  const Frame frame = frame_around(Vec3(0, 0, -1));
  const SphereCells cells(
      [&](const Vec3& d) { return peak(0.85, sin2_half_angle(frame.along, d)); }, frame.along, 64);
  Tally tally(cells);
  Generator generator(test_seed());
  for (int i = 0; i < 300'000; ++i) tally.add(draw_peak(generator, frame, 0.86));
  EXPECT_FALSE(chi_square(tally));
}

TEST(ChiSquare, RejectsAnAzimuthThatIsNotUniform) {
  const Frame frame = frame_around(Vec3(1, 0, 0));
  const SphereCells cells([](const Vec3&) { return 1 / (4 * pi); }, frame.along, 64);
  Tally tally(cells);
  Generator generator(test_seed());
  for (int i = 0; i < 1'000'000; ++i)
    tally.add(direction_at(frame, uniform(generator), 2 * pi * draw_tilted(generator, 0.02)));
  EXPECT_FALSE(chi_square(tally));
}

TEST(ChiSquare, RejectsASingleDrawWhereTheDensityIsZero) {
  const IntervalCells cells([](double x) { return x < 0.5 ? 2.0 : 0.0; }, 0, 1, 10, {0.5});
  Tally tally(cells);
  Generator generator(test_seed());
  for (int i = 0; i < 100'000; ++i) tally.add(0.5 * uniform(generator));
  EXPECT_TRUE(chi_square(tally));
  tally.add(0.75);
  const auto result = chi_square(tally);
  EXPECT_FALSE(result);
  EXPECT_NE(std::string(result.message()).find("where the density is 0"), std::string::npos);
}

TEST(ChiSquare, RejectsADrawOutsideOfTheCells) {
  const IntervalCells cells([](double) { return 1.0; }, 0, 1, 10);
  Tally tally(cells);
  for (int i = 0; i < 10'000; ++i) tally.add((i + 0.5) / 10'000);
  EXPECT_TRUE(chi_square(tally));
  tally.add(std::nan(""));
  EXPECT_FALSE(chi_square(tally));
}

TEST(ChiSquare, RejectsADensityThatDoesNotIntegrateToOne) {
  const IntervalCells cells([](double) { return 1.001; }, 0, 1, 10);
  Tally tally(cells);
  for (int i = 0; i < 10'000; ++i) tally.add((i + 0.5) / 10'000);
  EXPECT_FALSE(chi_square(tally));
}

TEST(ChiSquare, RejectsWhatCannotFail) {
  const IntervalCells cells([](double) { return 1.0; }, 0, 1, 10);
  Tally tally(cells);
  for (int i = 0; i < 30; ++i) tally.add((i + 0.5) / 30);
  EXPECT_FALSE(chi_square(tally)) << "30 draws fill one cell of 20 and a rest";
}

TEST(ChiSquare, PoolsCellsThatExpectFewDraws) {
  // 90 cells expect 1 draw each, one expects 910: Pearson's statistic of the single cells is not
  // chi-square, that of the pool is.
  std::vector<double> probabilities(90, 0.001);
  probabilities.push_back(0.91);
  std::vector<std::int64_t> counts(90, 0);
  counts[0] = 90;
  counts.push_back(910);
  const auto name = [](std::size_t cell) { return std::to_string(cell); };
  const auto result = chi_square(counts, 0, probabilities, name);
  EXPECT_TRUE(result);
  EXPECT_NE(std::string(result.message()).find("in 2 cells (91 before pooling)"),
            std::string::npos);
}

TEST(ChiSquare, ExplainsARejection) {
  const auto result = uniformity(100'000, 0.3, test_seed());
  ASSERT_FALSE(result);
  const std::string text = result.message();
  for (const char* part :
       {"p = ", "before pooling", "worst:", "observed", "expected", "TEST_SEED="})
    EXPECT_NE(text.find(part), std::string::npos) << part << " in " << text;
  const auto start = text.find("cells in ") + 9;
  EXPECT_TRUE(std::filesystem::exists(text.substr(start))) << text.substr(start);
}

TEST(ChiSquare, SharesItsBudgetAmongComparisons) {
  // p = 5e-5 is below the budget of one comparison, and above a tenth of it.
  const std::vector<double> probabilities{0.5, 0.5};
  const std::vector<std::int64_t> counts{50'000 + 641, 50'000 - 641};
  const auto name = [](std::size_t cell) { return std::to_string(cell); };
  EXPECT_FALSE(chi_square(counts, 0, probabilities, name, 1));
  EXPECT_TRUE(chi_square(counts, 0, probabilities, name, 10));
}

}  // namespace arcus::statistics
