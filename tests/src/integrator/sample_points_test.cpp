#include "src/integrator/sample_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace arcus::render {
namespace {

std::array<double, 5> numbers(std::uint64_t pixel, std::uint32_t sample) {
  const FirstNumbers n = first_numbers(1, pixel, sample);
  return {n.pixel_x, n.pixel_y, n.wavelength, n.collision, n.choice};
}

}  // namespace

TEST(FirstNumbers, EveryDimensionOfAPowerOfTwoOfSamplesIsStratified) {
  for (const std::uint64_t pixel : {0u, 1u, 77777u})
    for (std::size_t d = 0; d < 5; ++d) {
      std::set<int> cells;
      for (std::uint32_t i = 0; i < 64; ++i) cells.insert(static_cast<int>(numbers(pixel, i)[d] * 64));
      EXPECT_EQ(cells.size(), 64u) << "dimension " << d;
    }
}

TEST(FirstNumbers, ThePixelIsCoveredInTwoDimensions) {
  std::set<int> cells;
  for (std::uint32_t i = 0; i < 64; ++i) {
    const auto u = numbers(5, i);
    cells.insert(static_cast<int>(u[0] * 8) * 8 + static_cast<int>(u[1] * 8));
  }
  EXPECT_EQ(cells.size(), 64u);
}

TEST(FirstNumbers, PixelsAreIndependent) {
  // Correlation of the first samples of neighbouring pixels.
  const int n = 20000;
  for (std::size_t d = 0; d < 5; ++d) {
    double product = 0;
    for (std::uint64_t pixel = 0; pixel < n; ++pixel)
      product += (numbers(pixel, 0)[d] - 0.5) * (numbers(pixel + 1, 0)[d] - 0.5);
    EXPECT_NEAR(product / n, 0, 4.0 / 12 / std::sqrt(static_cast<double>(n)));
  }
}

}  // namespace arcus::render
