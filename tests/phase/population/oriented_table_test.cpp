#include "phase/population/oriented_table.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "phase/base/frame.h"
#include "phase/base/units.h"
#include "phase/optics/refractive_index.h"
#include "phase/population/map_smoother.h"
#include "phase/population/sky_grid.h"
#include "phase/population/tabulate_crystals.h"
#include "tests/statistics/chi_square.h"
#include "tests/statistics/seed.h"

namespace arcus::phase {
namespace {

/// Few rays at few wavelengths, and no smoothing beyond what the noise asks for.
CrystalTableSettings settings_of(const std::string& habit, std::vector<double> wavelength_nm = {550}) {
  CrystalTableSettings settings;
  settings.crystals = crystals_of_habit(habit);
  settings.size_um = {200};
  const RefractiveIndex ice = RefractiveIndex::ice();
  for (const double nm : wavelength_nm) {
    const auto index = ice.relative_to_air(nm);
    settings.waves.push_back({nm, index.real(), absorption_per_um(index.imag(), nm)});
  }
  settings.rays = 2e5;
  settings.map_step_deg = 1;
  settings.map_noise = 0.05;
  return settings;
}

double sky_sr(const SkyGrid& grid, int row, int column) { return grid.cell_sr(row) * SkyGrid::images(column, grid.steps()); }

double total_m2(const OrientedTable& t, std::size_t size, std::size_t wavelength) {
  const int steps = static_cast<int>(t.azimuth_deg.size()) - 1;
  const SkyGrid grid(180.0 / steps);
  double sum = 0;
  for (int row = 0; row <= steps; ++row)
    for (int column = 0; column <= steps; ++column)
      sum += sky_sr(grid, row, column) *
             t.scattering_m2_per_sr[t.cell(size, static_cast<std::size_t>(row), static_cast<std::size_t>(column)) * t.wavelength_nm.size() + wavelength];
  return sum;
}

/// A quantity by the sine of elevation, at the sun's.
double at_the_sun(const OrientedTable& t, const std::vector<double>& values, std::size_t row) {
  const double sine = std::fabs(std::sin(radians(t.sun_elevation_deg)));
  std::size_t i = 0;
  while (i + 2 < t.sine_elevation.size() && t.sine_elevation[i + 1] < sine) ++i;
  const double share = (sine - t.sine_elevation[i]) / (t.sine_elevation[i + 1] - t.sine_elevation[i]);
  const double* from = &values[row * t.sine_elevation.size() + i];
  return from[0] * (1 - share) + from[1] * share;
}

float value(const OrientedTable& t, std::size_t wavelength, double elevation_deg, double azimuth_deg) {
  const double step = t.azimuth_deg[1];
  const auto row = static_cast<std::size_t>(std::lround((elevation_deg + 90) / step)), column = static_cast<std::size_t>(std::lround(azimuth_deg / step));
  return t.scattering_m2_per_sr[t.cell(0, row, column) * t.wavelength_nm.size() + wavelength];
}

/// Plates that lie flat under a point of light, without diffraction: their halos are lines and points of closed form.
OrientedTable flat_plates(double sun_deg, std::vector<double> wavelength_nm, double step_deg, double rays = 5e4) {
  CrystalTableSettings settings = settings_of("plate", std::move(wavelength_nm));
  settings.crystals.orientation.tilt_deg = 0;
  settings.diffraction = false;
  settings.map_step_deg = step_deg;
  settings.map_noise = 1;
  settings.rays = rays;
  return tabulate_oriented_crystals(settings, sun_deg, 0);
}

double ice_index(double nm) { return RefractiveIndex::ice().relative_to_air(nm).real(); }

/// Azimuth of parhelia from the sun: Bravais' index in the least deviation of a 60 degree prism.
double parhelion_deg(double n, double sun_deg) {
  const double s = std::sin(radians(sun_deg)), c = std::cos(radians(sun_deg));
  const double skew = std::sqrt(n * n - s * s) / c;
  return degrees(2 * std::asin(skew * std::sin(radians(30))) - radians(60));
}

double circumzenithal_deg(double n, double sun_deg) {
  const double c = std::cos(radians(sun_deg));
  return degrees(std::asin(std::sqrt(n * n - c * c)));
}

}  // namespace

TEST(OrientedTable, WhatIsStoppedIsInTheMapOrGoesStraightOn) {
  for (const char* habit : {"plate", "column"})
    for (const double size_um : {200.0, 20.0})
      for (const bool remove : {true, false}) {
        if (size_um < 100 && !remove) continue;  // small ones keep all either way
        CrystalTableSettings settings = settings_of(habit);
        settings.rays = 5e5;
        settings.size_um = {size_um};
        settings.remove_forward = remove;
        settings.size_spread = 0.3;
        const OrientedTable t = tabulate_oriented_crystals(settings, 35, 0.2666);
        check_table(t, habit);
        const double stopped = at_the_sun(t, t.extinction_cross_section_m2, 0) * (1 - at_the_sun(t, t.forward_fraction, 0));
        // 0.3 % may be still in the crystals; what goes straight on, most of it, is known from 8 thousand rays.
        EXPECT_NEAR(total_m2(t, 0, 0) / stopped, 1, 0.035) << habit << " " << size_um << " " << remove;
        if (size_um < 100 || !remove) EXPECT_EQ(at_the_sun(t, t.forward_fraction, 0), 0);
        else EXPECT_GT(at_the_sun(t, t.forward_fraction, 0), 0.5);
      }
}

TEST(OrientedTable, MeanExtinctionIsThatOverAllDirections) {
  for (const char* habit : {"plate", "column", "pyramid"}) {
    CrystalTableSettings settings = settings_of(habit);
    settings.rays = 6e5;
    settings.map_step_deg = 5;
    const OrientedTable t = tabulate_oriented_crystals(settings, 35, 0.2666);
    double sum = 0;
    for (std::size_t i = 1; i < t.sine_elevation.size(); ++i)
      sum += 0.5 * (t.sine_elevation[i] - t.sine_elevation[i - 1]) * (t.extinction_cross_section_m2[i] + t.extinction_cross_section_m2[i - 1]);
    EXPECT_NEAR(sum / t.mean_extinction_cross_section_m2[0], 1, 4e-3) << habit;
  }
}

TEST(OrientedTable, ParheliaStandWhereTheLeastDeviationPutsThem) {
  const std::vector<double> nm{450, 550, 650};
  for (const double sun : {0.0, 20.0, 40.0}) {
    const OrientedTable t = flat_plates(sun, nm, 0.1);
    for (std::size_t w = 0; w < nm.size(); ++w) {
      // The first bright node from the sun: light piles up at the least deviation and falls off behind it.
      const double expected = parhelion_deg(ice_index(nm[w]), sun);
      double best = 0, at = 0;
      for (double azimuth = expected - 3; azimuth < expected + 3; azimuth += 0.1)
        if (value(t, w, sun, azimuth) > best) {
          best = value(t, w, sun, azimuth);
          at = std::round(azimuth * 10) / 10;
        }
      EXPECT_NEAR(at, expected, 0.1001) << sun << " " << nm[w];
    }
  }
}

TEST(OrientedTable, CircumzenithalArcStandsAtItsHeightAndOnlyUnderALowSun) {
  for (const double sun : {5.0, 15.0, 25.0}) {
    const OrientedTable t = flat_plates(sun, {550}, 0.1);
    const double expected = circumzenithal_deg(ice_index(550), sun);
    double best = 0, at = 0;
    for (double elevation = 45; elevation < 89; elevation += 0.1)
      if (value(t, 0, elevation, 10) > best) {
        best = value(t, 0, elevation, 10);
        at = std::round(elevation * 10) / 10;
      }
    EXPECT_NEAR(at, expected, 0.1001) << sun;
  }
  const OrientedTable high = flat_plates(34, {550}, 1, 2e5);
  for (double elevation = 45; elevation < 90; ++elevation)
    for (double azimuth = 0; azimuth < 90; ++azimuth) EXPECT_EQ(value(high, 0, elevation, azimuth), 0) << elevation << " " << azimuth;
}

TEST(OrientedTable, ParhelicCircleAndSubsunLieAtTheSunsHeightAndBelow) {
  const OrientedTable t = flat_plates(20, {550}, 1, 2e5);
  for (double azimuth = 40; azimuth < 180; azimuth += 5) {
    EXPECT_GT(value(t, 0, 20, azimuth), 0) << azimuth;
    for (const double beside : {15.0, 25.0}) EXPECT_EQ(value(t, 0, beside, azimuth), 0) << azimuth;
  }
  for (const double e : {-24, -22, -18, -16})
    for (double azimuth = 0; azimuth < 10; ++azimuth) EXPECT_EQ(value(t, 0, e, azimuth), 0) << e;
  EXPECT_GT(value(t, 0, -20, 0), 100 * value(t, 0, -20, 3));
}

TEST(OrientedTable, RandomCrystalsScatterByTheAngleFromTheSunAlone) {
  CrystalTableSettings settings = settings_of("prism");
  settings.diffraction = false;
  settings.map_noise = 1;
  settings.rays = 1e6;
  const double sun = 30;
  const OrientedTable t = tabulate_oriented_crystals(settings, sun, 0);
  // Shares of the light by the angle from the sun: of the map, and of single draws.
  const std::vector<double> edges_deg{5, 21, 24, 30, 40, 60, 90, 130, 180};
  std::vector<double> map(edges_deg.size() - 1), drawn(edges_deg.size() - 1);
  const auto add = [&](std::vector<double>& shares, double angle_deg, double weight) {
    const auto edge = std::upper_bound(edges_deg.begin(), edges_deg.end(), angle_deg);
    if (edge != edges_deg.begin() && edge != edges_deg.end()) shares[static_cast<std::size_t>(edge - edges_deg.begin() - 1)] += weight;
  };
  const SkyGrid grid(1);
  const Vec3 towards_sun = direction_of(0, sun);
  for (int row = 0; row <= 180; ++row)
    for (int column = 0; column <= 180; ++column)
      add(map, degrees(angle_between_rad(direction_of(t.azimuth_deg[static_cast<std::size_t>(column)], t.elevation_deg[static_cast<std::size_t>(row)]), towards_sun)),
          sky_sr(grid, row, column) * value(t, 0, row - 90, column));
  const CrystalPopulation crystals(settings.crystals, 200);
  Random random(7, 0, 0);
  const int draws = 100000;
  for (int i = 0; i < draws; ++i)
    if (const auto exit = crystals.draw(-towards_sun, settings.waves[0].n, 0, random))
      add(drawn, degrees(angle_between_rad(exit->direction, -towards_sun)), exit->light.i);
  double map_sum = 0, drawn_sum = 0;
  for (std::size_t i = 0; i < map.size(); ++i) {
    map_sum += map[i];
    drawn_sum += drawn[i];
  }
  // Cells on the edges of rings, a degree wide, fall on one side: 2 % of the narrow ones.
  for (std::size_t i = 0; i < map.size(); ++i) {
    const double share = drawn[i] / drawn_sum;
    EXPECT_NEAR(map[i] / map_sum, share, 5 * std::sqrt(share / drawn_sum) + 0.03 * share) << edges_deg[i];
  }
}

TEST(OrientedTable, DrawsFallIntoTheMapsCells) {
  CrystalTableSettings settings = settings_of("plate");
  settings.crystals.orientation.tilt_deg = 10;
  settings.diffraction = false;
  settings.map_step_deg = 1;
  settings.map_noise = 1;
  settings.rays = 2e6;
  const double sun = 20;
  const OrientedTable t = tabulate_oriented_crystals(settings, sun, 0);
  const SkyGrid grid(1);
  // Blocks of 10 by 10 degrees; nodes on their edges would be shared, so blocks go from node to node plus a half.
  constexpr int blocks = 18;
  const auto block = [](double elevation, double azimuth) {
    const int row = std::clamp(static_cast<int>((std::round(elevation) + 90) / 10), 0, blocks - 1);
    const int column = std::clamp(static_cast<int>(std::round(azimuth) / 10), 0, blocks - 1);
    return static_cast<std::size_t>(row * blocks + column);
  };
  std::vector<double> probability(blocks * blocks);
  double whole = 0;
  for (int row = 0; row <= 180; ++row)
    for (int column = 0; column <= 180; ++column) {
      const double power = sky_sr(grid, row, column) * value(t, 0, row - 90, column);
      probability[block(row - 90, column)] += power;
      whole += power;
    }
  for (double& p : probability) p /= whole;
  const CrystalPopulation crystals(settings.crystals, 200);
  const Vec3 light = -direction_of(0, sun);
  const auto test = [&](double index) {
    Random random(statistics::test_seed(), 0, 0);
    std::vector<std::int64_t> counts(blocks * blocks);
    for (int i = 0; i < 100000; ++i) {
      const auto exit = crystals.draw(light, index, 0, random);
      if (!exit || sin2_half_angle(exit->direction, light) < 1e-9) continue;
      const Vec3 seen = -exit->direction;
      ++counts[block(degrees(std::asin(std::clamp(seen.z, -1.0, 1.0))), degrees(std::atan2(std::fabs(seen.x), seen.y)))];
    }
    return statistics::chi_square(counts, 0, probability, [](std::size_t cell) { return std::to_string(cell); }, 2);
  };
  EXPECT_TRUE(test(settings.waves[0].n));
  EXPECT_FALSE(test(settings.waves[0].n + 0.01));  // it would see an index of another ice
}

TEST(OrientedTable, BitsAreEqualForAnyNumberOfThreads) {
  CrystalTableSettings settings = settings_of("column", {400, 500, 600, 700});
  settings.rays = 2e4;
  settings.map_step_deg = 2;
  const OrientedTable two = tabulate_oriented_crystals(settings, 20, 0.2666);
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const OrientedTable one = tabulate_oriented_crystals(settings, 20, 0.2666);
  EXPECT_EQ(one.scattering_m2_per_sr, two.scattering_m2_per_sr);
  EXPECT_EQ(one.relative_error, two.relative_error);
  EXPECT_EQ(one.forward_fraction, two.forward_fraction);
}

// ---- smoothing ------------------------------------------------------------------------------------

namespace {

/// Counts of a sky that is ten times as bright above a level as below.
struct Edge {
  SkyGrid grid{0.5};
  std::vector<float> light, squares, truth;
  Edge(double per_sr_below) : light(grid.size()), squares(grid.size()), truth(grid.size()) {
    std::mt19937_64 random(5);
    for (int row = 0; row <= grid.steps(); ++row)
      for (int column = 0; column <= grid.steps(); ++column) {
        const std::size_t at = static_cast<std::size_t>(row) * grid.row() + static_cast<std::size_t>(column);
        truth[at] = static_cast<float>(per_sr_below * (grid.elevation_deg(row) > 10.2 ? 10 : 1));
        const double mean = truth[at] * sky_sr(grid, row, column);
        light[at] = squares[at] = static_cast<float>(std::poisson_distribution<int>(mean)(random));
      }
  }
};

}  // namespace

TEST(MapSmoother, NoiseFallsToTheStatedLevelAndTheMeanStays) {
  const Edge sky(1e4);  // 0.8 counts a cell
  std::vector<float> smoothed = sky.light;
  const MapSmoother smoother(sky.grid, sky.light, sky.squares, 0.05);
  smoother.smooth(smoothed);
  double squares = 0, weight = 0, before = 0, after = 0;
  for (int row = 0; row <= sky.grid.steps(); ++row)
    for (int column = 0; column <= sky.grid.steps(); ++column) {
      const std::size_t at = static_cast<std::size_t>(row) * sky.grid.row() + static_cast<std::size_t>(column);
      const double sr = sky_sr(sky.grid, row, column);
      before += sky.light[at];
      after += smoothed[at] * sr;
      if (std::fabs(sky.grid.elevation_deg(row) - 10) < 6) continue;
      const double miss = smoothed[at] / sky.truth[at] - 1;
      squares += miss * miss * sr;
      weight += sr;
    }
  EXPECT_NEAR(after / before, 1, 1e-5);
  EXPECT_LT(std::sqrt(squares / weight), 0.06);
  EXPECT_GT(std::sqrt(squares / weight), 0.02);
}

TEST(MapSmoother, KeepsEdges) {
  const Edge sky(1e4);
  std::vector<float> smoothed = sky.light;
  MapSmoother(sky.grid, sky.light, sky.squares, 0.05).smooth(smoothed);
  for (int row = 0; row <= sky.grid.steps(); ++row) {
    const double above = sky.grid.elevation_deg(row) - 10.25;
    if (std::fabs(above) < 0.9 || std::fabs(above) > 3) continue;  // two rows on either side may share
    double mean = 0;
    for (int column = 0; column <= sky.grid.steps(); ++column) {
      const std::size_t at = static_cast<std::size_t>(row) * sky.grid.row() + static_cast<std::size_t>(column);
      mean += smoothed[at] / sky.truth[at] / static_cast<double>(sky.grid.row());
    }
    EXPECT_NEAR(mean, 1, 0.25) << above;  // of a step from 1 to 10
  }
}

}  // namespace arcus::phase
