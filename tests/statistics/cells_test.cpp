#include "tests/statistics/cells.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <stdexcept>

#include "phase/base/units.h"

namespace arcus::statistics {

namespace {

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

/// Henyey-Greenstein around an axis, the peaked density most easily integrated by hand [1/sr].
struct Peak {
  double g;
  Vec3 axis;
  double operator()(const Vec3& direction) const {
    const double s = sin2_half_angle(axis, direction);
    return (1 - g * g) / (4 * pi * std::pow((1 - g) * (1 - g) + 4 * g * s, 1.5));
  }
};

}  // namespace

TEST(IntervalCells, HoldTheIntegralsOfTheDensity) {
  const auto cumulative = [](double x) { return 1 - std::exp(-5 * x); };
  const IntervalCells cells([](double x) { return 5 * std::exp(-5 * x); }, 0, 4, 50);
  EXPECT_NEAR(sum(cells.probabilities()), cumulative(4), 1e-9);
  EXPECT_GE(cells.size(), 40u);
  EXPECT_LE(cells.size(), 50u);
  // Edges are found by asking which cell a point is in.
  double previous = 0;
  for (std::size_t cell = 0; cell + 1 < cells.size(); ++cell) {
    double low = previous, high = 4;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (*cells.find(middle) > cell ? high : low) = middle;
    }
    EXPECT_NEAR(cells.probabilities()[cell], cumulative(high) - cumulative(previous), 1e-8);
    EXPECT_LE(cells.probabilities()[cell], 1.25 / 50);
    previous = high;
  }
}

TEST(IntervalCells, MakeCellsOfTheirOwnWhereTheDensityVanishes) {
  const auto density = [](double x) { return x < 0.3 || x > 0.7 ? 1 / 0.6 : 0.0; };
  const IntervalCells cells(density, 0, 1, 10, {0.3, 0.7});
  EXPECT_NEAR(sum(cells.probabilities()), 1, 1e-9);
  EXPECT_EQ(cells.probabilities()[*cells.find(0.5)], 0);
  EXPECT_EQ(cells.probabilities()[*cells.find(0.69999)], 0);
  EXPECT_GT(cells.probabilities()[*cells.find(0.29999)], 0);
  EXPECT_GT(cells.probabilities()[*cells.find(0.70001)], 0);
}

TEST(IntervalCells, FindNothingOutsideTheirRange) {
  const IntervalCells cells([](double) { return 1.0; }, 0, 1, 4);
  EXPECT_FALSE(cells.find(-1e-12));
  EXPECT_FALSE(cells.find(1 + 1e-12));
  EXPECT_FALSE(cells.find(std::nan("")));
  EXPECT_EQ(cells.find(0), 0u);
  EXPECT_EQ(cells.find(1), cells.size() - 1);
}

TEST(IntervalCells, RefuseANegativeDensity) {
  EXPECT_THROW(IntervalCells([](double x) { return x - 0.5; }, 0, 1, 4), std::invalid_argument);
  EXPECT_THROW(IntervalCells([](double) { return std::nan(""); }, 0, 1, 4), std::invalid_argument);
}

TEST(SphereCells, IntegrateAPeakOfAnyWidthAroundTheirAxis) {
  const Vec3 axis = normalize(Vec3(0.3, -0.4, 0.8));
  for (const double g : {0.0, 0.85, -0.85, 0.99, 0.9999, 0.999999}) {
    const SphereCells cells(Peak{g, axis}, axis, 100);
    EXPECT_NEAR(sum(cells.probabilities()), 1, 1e-5) << "g = " << g;
    EXPECT_GE(cells.size(), 100u);
    EXPECT_LE(cells.size(), 500u);
  }
}

TEST(SphereCells, IntegrateAPeakElsewhereWhenTold) {
  const Vec3 axis(0, 0, 1), sun = normalize(Vec3(0.9, 0.1, -0.2));
  const SphereCells cells(Peak{0.9999, sun}, axis, 100, {sun});
  EXPECT_NEAR(sum(cells.probabilities()), 1, 1e-4);
}

TEST(SphereCells, HoldTheIntegralOverTheirPatch) {
  // The patch of every cell is felt out by drawing directions uniformly: cells hold area / (4 pi).
  const Vec3 axis = normalize(Vec3(-1, 2, 0.5));
  const SphereCells cells([](const Vec3&) { return 1 / (4 * pi); }, axis, 32);
  std::vector<double> counts(cells.size());
  const int n = 200;
  const Frame frame = frame_around(axis);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      counts[*cells.find(direction_at(frame, (i + 0.5) / n, 2 * pi * (j + 0.5) / n))] +=
          1.0 / (n * n);
  for (std::size_t i = 0; i < cells.size(); ++i)
    EXPECT_NEAR(counts[i], cells.probabilities()[i], 0.02 / 32) << cells.name(i);
}

TEST(SphereCells, KeepDarknessApart) {
  const auto upper = [](const Vec3& d) { return d.z > 0 ? 1 / (2 * pi) : 0.0; };
  const SphereCells cells(upper, Vec3(0, 0, 1), 20);
  EXPECT_NEAR(sum(cells.probabilities()), 1, 1e-4);
  EXPECT_EQ(cells.probabilities()[*cells.find(normalize(Vec3(1, 1, -0.001)))], 0);
  EXPECT_GT(cells.probabilities()[*cells.find(normalize(Vec3(1, 1, 0.001)))], 0);
}

TEST(SphereCells, FindNothingForWhatIsNoDirection) {
  const SphereCells cells([](const Vec3&) { return 1 / (4 * pi); }, Vec3(0, 0, 1), 4);
  EXPECT_FALSE(cells.find(Vec3(0, 0, 0)));
  EXPECT_FALSE(cells.find(Vec3(0, 0, 1.01)));
  EXPECT_FALSE(cells.find(Vec3(0, std::nan(""), 1)));
}

}  // namespace arcus::statistics
