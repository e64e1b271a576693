// Cosine series on the grid and between its points: against the plain sum.
#include "phase/particle/cosine_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "phase/base/units.h"

namespace arcus::phase {
namespace {

// Two complex series of eight spheres with random coefficients, summed on the grid.
struct Summed {
  Summed(const CosineGrid& grid, int degree_of_series, int half, Instructions instructions)
      : degree(degree_of_series),
        series((degree + 1) * 4 * lanes),
        values(CosineGrid::grid_size(grid.points())) {
    std::mt19937_64 random(degree);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (double& coefficient : series) coefficient = uniform(random);
    const LaneMemory series_memory((degree + 1) * 4), work(2 * grid.points());
    const LaneMemory grid_memory(values.size() * sizeof(float) / (lanes * sizeof(double)));
    std::copy(series.begin(), series.end(), series_memory.data());
    float* floats = reinterpret_cast<float*>(grid_memory.data());
    std::fill_n(floats, values.size(), 0.0f);
    grid.sum(degree, series_memory.data(), work.data(), floats, half, instructions);
    std::copy_n(floats, values.size(), values.begin());
  }

  // quantity: of real and imaginary part of both series.
  double plain_sum(int quantity, int lane, double angle) const {
    double sum = 0;
    for (int j = 0; j <= degree; ++j)
      sum += (j ? 2 : 1) / pi * series[(j * 4 + quantity) * lanes + lane] * std::cos(j * angle);
    return sum;
  }

  double interpolated(const CosineGrid& grid, int quantity, int half, int lane, int angle) const {
    double sum = 0;
    for (int tap = 0; tap < CosineGrid::taps; ++tap)
      sum += grid.weights()[angle * CosineGrid::taps + tap] *
             values[(((grid.first_rows()[angle] + tap) * 4 + quantity) * 2 + half) * lanes + lane];
    return sum;
  }

  int degree;
  std::vector<double> series;
  std::vector<float> values;
};

TEST(CosineGrid, GivesTheSeriesAtAnyAngle) {
  std::vector<double> angles = {0, 1e-6, 1e-3, 0.5, 1.0, pi / 2, 2.0, 3.0, pi - 1e-4, pi};
  for (int i = 0; i < 40; ++i) angles.push_back(1.0 + 0.0137 * i);
  for (const int degree : {0, 1, 5, 20, 21, 30, 31, 63, 64, 200, 340, 682, 1000, 6000}) {
    const CosineGrid grid(CosineGrid::points_for(degree), angles);
    for (const int half : {0, 1}) {
      const Summed sums(grid, degree, half, best_instructions());
      const double size = std::sqrt(degree + 1.0);
      for (std::size_t i = 0; i < angles.size(); ++i)
        for (const int quantity : {0, 1, 2, 3}) {
          const double expected = sums.plain_sum(quantity, 5, angles[i]);
          EXPECT_NEAR(sums.interpolated(grid, quantity, half, 5, static_cast<int>(i)), expected,
                      2e-6 * size)
              << "degree " << degree << " quantity " << quantity << " angle " << angles[i];
        }
    }
  }
}

TEST(CosineGrid, IsLargeEnoughForItsSeriesAndNotMuchLarger) {
  for (int degree = 0; degree < 5000; ++degree) {
    const int points = CosineGrid::points_for(degree);
    EXPECT_GE(points, 1.5 * (degree + 1)) << degree;
    EXPECT_TRUE(points == 32 || points <= 1.5 * 1.5 * (degree + 1)) << degree;
  }
}

TEST(CosineGrid, ForwardPeakDoesntSpillIntoTheDark) {
  // sum of cos(j t), j = -n ... n, is 2 n + 1 at 0 and at most 1/sin(t/2) elsewhere: errors are
  // relative to that.
  std::vector<double> angles;
  for (int i = 0; i < 200; ++i) angles.push_back(1.5 + i * 1e-3);
  const int degree = 4000;
  const CosineGrid grid(CosineGrid::points_for(degree), angles);
  const LaneMemory series((degree + 1) * 4), work(2 * grid.points());
  const LaneMemory memory(CosineGrid::grid_size(grid.points()) * sizeof(float) /
                          (lanes * sizeof(double)));
  std::fill_n(series.data(), (degree + 1) * 4 * lanes, pi);
  float* values = reinterpret_cast<float*>(memory.data());
  grid.sum(degree, series.data(), work.data(), values, 0, best_instructions());
  for (std::size_t i = 0; i < angles.size(); ++i) {
    double sum = 0;
    for (int tap = 0; tap < CosineGrid::taps; ++tap)
      sum += grid.weights()[i * CosineGrid::taps + tap] *
             values[(grid.first_rows()[i] + tap) * 8 * lanes];
    EXPECT_NEAR(sum, std::sin((degree + 0.5) * angles[i]) / std::sin(angles[i] / 2), 2e-6)
        << angles[i];
  }
}

TEST(CosineGrid, BothInstructionSetsGiveTheSameBits) {
  if (best_instructions() != Instructions::avx512) GTEST_SKIP() << "this processor has no AVX-512";
  const double angle[] = {1.0};
  for (const int degree : {3, 50, 100, 500, 3000, 9000}) {
    const CosineGrid grid(CosineGrid::points_for(degree), angle);
    EXPECT_EQ(Summed(grid, degree, 1, Instructions::avx2).values,
              Summed(grid, degree, 1, Instructions::avx512).values);
  }
}

}  // namespace
}  // namespace arcus::phase
