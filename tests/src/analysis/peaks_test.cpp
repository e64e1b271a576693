#include "src/analysis/peaks.h"

#include <gtest/gtest.h>

#include <cmath>

namespace arcus::render {
namespace {

std::vector<double> axis(double from, double to, double step) {
  std::vector<double> x;
  for (double v = from; v <= to; v += step) x.push_back(v);
  return x;
}

double bump(double x, double at, double width) {
  return std::exp(-0.5 * std::pow((x - at) / width, 2));
}

}  // namespace

TEST(Peaks, AreFoundBetweenTheNodes) {
  const auto x = axis(0, 60, 0.3);
  std::vector<double> y;
  for (const double v : x) y.push_back(0.01 * v + bump(v, 42.37, 0.8) + 0.3 * bump(v, 51.04, 1.5));
  const auto peaks = find_peaks(x, y, {});
  ASSERT_EQ(peaks.size(), 2u);
  EXPECT_NEAR(peaks[0].position, 42.37, 0.02);  // the slope moves it by 0.006
  EXPECT_NEAR(peaks[1].position, 51.04, 0.09);
  EXPECT_NEAR(peaks[0].height, 1 + 0.4237, 0.02);
}

TEST(Peaks, SmallerThanTheirErrorsAreNone) {
  const auto x = axis(0, 10, 0.1);
  std::vector<double> y, small(x.size(), 0.001), large(x.size(), 0.05);
  for (const double v : x) y.push_back(bump(v, 3, 0.5) + 0.1 * bump(v, 7, 0.5));
  EXPECT_EQ(find_peaks(x, y, small).size(), 2u);
  EXPECT_EQ(find_peaks(x, y, large).size(), 1u);
  EXPECT_EQ(find_peaks(x, y, {}, 0.2).size(), 1u) << "less than a fifth of the range";
}

TEST(Peaks, EndsConstantsAndTooFewPointsHaveNone) {
  EXPECT_TRUE(find_peaks(std::vector<double>{0, 1, 2}, std::vector<double>{3, 2, 1}, {}).empty());
  EXPECT_TRUE(find_peaks(std::vector<double>{0, 1, 2}, std::vector<double>{1, 1, 1}, {}).empty());
  EXPECT_TRUE(find_peaks(std::vector<double>{0, 1}, std::vector<double>{1, 2}, {}).empty());
}

TEST(Peaks, APlateauIsOnePeakInItsMiddle) {
  const auto peaks =
      find_peaks(std::vector<double>{0, 1, 2, 3, 4, 5}, std::vector<double>{0, 0, 1, 1, 0, 0}, {});
  ASSERT_EQ(peaks.size(), 1u);
  EXPECT_NEAR(peaks[0].position, 2.5, 1e-9);
}

}  // namespace arcus::render
