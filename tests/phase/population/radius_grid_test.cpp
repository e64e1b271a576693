#include "phase/population/radius_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "phase/optics/refractive_index.h"

namespace arcus::phase {
namespace {

/// Σ w rᵒ over both grids.
double mean_power(const RadiusGrids& grids, std::size_t size, double order) {
  double sum = 0;
  for (const RadiusGrid* grid : {&grids.wave, &grids.large})
    for (std::size_t i = 0, n = grid->radius_um.size(); i < n; ++i)
      sum += grid->weight[size * n + i] * std::pow(grid->radius_um[i], order);
  return sum;
}

}  // namespace

TEST(RadiusGrid, WeightsGiveTheMomentsOfEveryPopulation) {
  const SizesSettings rain{.type = "marshall_palmer"};
  const std::vector<Sizes> sizes{Sizes(rain, 100), Sizes(rain, 300), Sizes(rain, 1000)};
  const RadiusGrids grids = radius_grids(sizes, 550, 1000, 3000);
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    EXPECT_NEAR(mean_power(grids, i, 2) / sizes[i].mean_power_um(2), 1, 1e-12);
    EXPECT_NEAR(mean_power(grids, i, 3) / sizes[i].mean_power_um(3), 1, 1e-4);
    EXPECT_NEAR(mean_power(grids, i, 4) / sizes[i].mean_power_um(4), 1, 1e-3);
  }
}

TEST(RadiusGrid, WavesAndLargeDropsMeetAtTheBorder) {
  const std::vector<Sizes> sizes{Sizes({.type = "gamma", .variance = 0.1}, 100)};
  const RadiusGrids grids = radius_grids(sizes, 550, 1000, 500);
  // A share of the 500 that waves for the whole population would have.
  EXPECT_GT(grids.wave.radius_um.size(), 100u);
  EXPECT_LT(grids.wave.radius_um.size(), 400u);
  EXPECT_NEAR(size_parameter(grids.wave.radius_um.back(), 550), 1000, 1e-9);
  EXPECT_EQ(grids.wave.radius_um.back(), grids.large.radius_um.front());
  EXPECT_TRUE(std::is_sorted(grids.wave.radius_um.begin(), grids.wave.radius_um.end()));
  EXPECT_TRUE(std::is_sorted(grids.large.radius_um.begin(), grids.large.radius_um.end()));
  EXPECT_GE(*std::min_element(grids.wave.weight.begin(), grids.wave.weight.end()), 0);
}

TEST(RadiusGrid, OnePopulationBelowTheBorderBringsAllRadii) {
  const SizesSettings gamma{.type = "gamma", .variance = 0.1};
  const std::vector<Sizes> with_small{Sizes(gamma, 10), Sizes(gamma, 100)};
  EXPECT_EQ(radius_grids(with_small, 550, 1000, 500).wave.radius_um.size(), 500u);
}

TEST(RadiusGrid, NeglectedTailsCountNothing) {
  const SizesSettings narrow{.type = "gamma", .variance = 0.02};
  const std::vector<Sizes> sizes{Sizes(narrow, 20), Sizes(narrow, 1000)};
  const RadiusGrid wave = radius_grids(sizes, 550, 1000, 500).wave;
  const std::size_t count = wave.radius_um.size();
  for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(wave.weight[count + i], 0) << wave.radius_um[i];
}

TEST(RadiusGrid, NarrowPopulationsOfLargeDropsGetFinerSteps) {
  const auto largest_step = [](double variance) {
    const std::vector<Sizes> sizes{Sizes({.type = "gamma", .variance = variance}, 500)};
    const RadiusGrid grid = radius_grids(sizes, 550, 1000, 100).large;
    // Where the population has its bulk.
    double step = 0;
    for (std::size_t i = 0; i < grid.radius_um.size(); ++i)
      if (std::fabs(grid.radius_um[i] / 500 - 1) < 0.1) step = std::max(step, grid.relative_step[i]);
    return step;
  };
  EXPECT_NEAR(largest_step(0.3), 0.03, 0.001);
  EXPECT_NEAR(largest_step(0.01), 0.01, 0.0005);
}

TEST(RadiusGrid, OneRadiusStandsForItself) {
  const SizesSettings one{.type = "monodisperse"};
  const std::vector<Sizes> sizes{Sizes(one, 5), Sizes(one, 50), Sizes(one, 500)};
  const RadiusGrids grids = radius_grids(sizes, 550, 1000, 3000);
  EXPECT_EQ(grids.wave.radius_um, (std::vector<double>{5, 50}));
  EXPECT_EQ(grids.wave.weight, (std::vector<double>{1, 0, 0, 1, 0, 0}));
  EXPECT_EQ(grids.large.radius_um, (std::vector<double>{500}));
  EXPECT_EQ(grids.large.weight, (std::vector<double>{0, 0, 1}));
  EXPECT_EQ(grids.large.relative_step, (std::vector<double>{0}));
}

}  // namespace arcus::phase
