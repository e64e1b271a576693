#include "media/author/water_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "media/author/air_density.h"
#include "media/author/droplets.h"
#include "media/author/field_units.h"
#include "phase/base/error.h"

namespace arcus::media {
namespace {

/// One column of cells.
WaterField column(std::vector<double> level_m, std::vector<float> water, std::vector<float> radius = {}) {
  WaterField field;
  field.where = "column";
  field.count = {1, 1, static_cast<int>(water.size())};
  field.step_x_m = field.step_y_m = 20;
  field.level_m = std::move(level_m);
  field.water_g_per_m3 = std::move(water);
  field.radius_um = std::move(radius);
  return field;
}

struct ColumnSums {
  double water_g_per_m2 = 0, depth = 0;
  int voxels = 0;
};
ColumnSums sums_of(const NewSpecies& species, double variance) {
  const DropletExtinction extinction(variance, 2, 50);
  const double height = species.world_from_index.z.z;
  ColumnSums sums;
  for (std::size_t b = 0; b < species.extinction.size(); ++b)
    for (std::size_t i = 0; i < SparseGrid::brick_voxels; ++i) {
      const double sigma = species.extinction[b].values[i], radius = species.size[b].values[i];
      if (sigma == 0) continue;
      ++sums.voxels;
      sums.depth += sigma * height;
      sums.water_g_per_m2 += sigma / extinction.per_m(1, radius) * height;
    }
  return sums;
}

std::string refusal(const WaterField& field, const DropletSettings& settings = {}) {
  try {
    species_of_water(field, settings);
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::input);
    return error.what();
  }
  ADD_FAILURE() << "was taken";
  return "";
}

TEST(WaterField, EvenLayersBecomeVoxelsAsTheyAre) {
  const WaterSpecies made = species_of_water(column({100, 140, 180, 220}, {0.1f, 0, 0.4f}, {8, 0, 12}), {});
  EXPECT_TRUE(made.notes.empty());
  ASSERT_EQ(made.species.extinction.size(), 1u);
  EXPECT_EQ(made.species.size[0].values[0], 8);
  EXPECT_EQ(made.species.extinction[0].values[1], 0);
  EXPECT_EQ(made.species.size[0].values[2], 12);
  // σ = 3 Q LWC / (4 ρ r_e), with Q near 2.07 at 12 µm.
  EXPECT_NEAR(made.species.extinction[0].values[2], 0.75 * 2.07 * 0.4e-6 / 12e-6, 0.01 * 0.052);
  EXPECT_EQ(made.species.world_from_index.point({0, 0, 2}), Vec3(0, 0, 200));
}

TEST(WaterField, UnevenLayersKeepWaterAndOpticalDepthOfEveryColumn) {
  const std::vector<double> level{100, 110, 135, 180, 260, 275};
  const std::vector<float> water{0.1f, 0.3f, 0.5f, 0, 0.2f}, radius{6, 9, 14, 0, 7};
  double expected_water = 0, expected_depth = 0;
  const DropletExtinction extinction(0.1, 6, 14);
  for (std::size_t k = 0; k < water.size(); ++k) {
    expected_water += water[k] * (level[k + 1] - level[k]);
    if (water[k] > 0) expected_depth += extinction.per_m(water[k], radius[k]) * (level[k + 1] - level[k]);
  }
  for (const double layer_m : {0.0, 7.0, 25.0, 60.0}) {
    DropletSettings settings;
    settings.layer_m = layer_m;
    const WaterSpecies made = species_of_water(column(level, water, radius), settings);
    const ColumnSums sums = sums_of(made.species, 0.1);
    EXPECT_NEAR(sums.water_g_per_m2, expected_water, 5e-3 * expected_water) << layer_m;
    EXPECT_NEAR(sums.depth, expected_depth, 5e-3 * expected_depth) << layer_m;  // Q changes by a hundredth from 6 to 14 µm
    ASSERT_EQ(made.notes.size(), 1u);
  }
  // Reading the water off at the middles of the voxels would not: the same sums see the difference.
  const WaterSpecies other = species_of_water(column(level, {0.1f, 0.3f, 0.52f, 0, 0.2f}, radius), {});
  EXPECT_GT(std::fabs(sums_of(other.species, 0.1).water_g_per_m2 - expected_water), 5e-3 * expected_water);
}

TEST(WaterField, NumbersBecomeSizes) {
  WaterField field = column({0, 20, 40}, {0.2f, 0.4f});
  field.drops_per_cm3 = {50, 100};
  DropletSettings settings;
  settings.variance = 0.05;
  const WaterSpecies made = species_of_water(field, settings);
  EXPECT_NEAR(made.species.size[0].values[0], effective_radius_um(0.2, 50, 0.05), 1e-4);
  EXPECT_NEAR(made.species.size[0].values[1], effective_radius_um(0.4, 100, 0.05), 1e-4);
  field.drops_per_cm3.clear();
  settings.drops_per_cm3 = 200;
  EXPECT_NEAR(species_of_water(field, settings).species.size[0].values[1], effective_radius_um(0.4, 200, 0.05), 1e-4);
  settings.drops_per_cm3 = 0;
  settings.size_um = 11;
  EXPECT_EQ(species_of_water(field, settings).species.size[0].values[1], 11);
}

TEST(WaterField, SizesOutsideOfTheLimitsAreSaid) {
  const WaterSpecies made = species_of_water(column({0, 20, 40, 60}, {0.2f, 0.4f, 0.1f}, {1, 90, 10}), {});
  EXPECT_EQ(made.species.size[0].values[0], 2);
  EXPECT_EQ(made.species.size[0].values[1], 50);
  ASSERT_EQ(made.notes.size(), 2u);
  EXPECT_NE(made.notes[0].find("33.3 %"), std::string::npos) << made.notes[0];
}

TEST(WaterField, RefusalsSayWhere) {
  EXPECT_NE(refusal(column({100, 120, 140}, {0.1f, -0.2f}, {8, 8})).find("cell (0, 0, 1) at x = 0 m, y = 0 m, z = 130 m: -0.2 g/m3"), std::string::npos);
  EXPECT_NE(refusal(column({100, 120, 140}, {0.1f, std::nanf("")}, {8, 8})).find("z = 130 m: NaN"), std::string::npos);
  EXPECT_NE(refusal(column({100, 120, 140}, {std::numeric_limits<float>::infinity(), 0}, {8, 8})).find("infinity"), std::string::npos);
  EXPECT_NE(refusal(column({100, 120, 140}, {0.1f, 0.1f}, {8, 0})).find("radius of 0 um"), std::string::npos);
  EXPECT_NE(refusal(column({100, 120, 140}, {0, 1e-6f}, {8, 8})).find("no cell"), std::string::npos);
  WaterField field = column({100, 120}, {0.1f});
  field.drops_per_cm3 = {0};
  EXPECT_NE(refusal(field).find("0 droplets"), std::string::npos);
  // Rounding of an advection scheme is no fault.
  const WaterSpecies made = species_of_water(column({100, 120, 140}, {0.1f, -1e-9f}, {8, 8}), {});
  ASSERT_EQ(made.notes.size(), 1u);
  EXPECT_NE(made.notes[0].find("below 0 by rounding"), std::string::npos);
}

TEST(AirDensity, IsThatOfTheStandardAtmosphere) {
  // ISO 2533, at geopotential heights.
  EXPECT_NEAR(standard_air_density_kg_per_m3(0), 1.225, 5e-5);
  EXPECT_NEAR(standard_air_density_kg_per_m3(1000), 1.11164, 5e-5);
  EXPECT_NEAR(standard_air_density_kg_per_m3(5000), 0.73612, 5e-5);
  EXPECT_NEAR(standard_air_density_kg_per_m3(11000), 0.36392, 5e-5);
  EXPECT_NEAR(standard_air_density_kg_per_m3(15000), 0.19367, 5e-5);
  EXPECT_NEAR(air_density_kg_per_m3(101325, 288.15), 1.225, 1e-4);
}

TEST(FieldUnits, AreKnownInManySpellings) {
  for (const char* text : {"g m-3", "g/m3", "g/m^3", "g m**-3", "g m^-3", "g.m-3", " g m-3 ", "g/(m3)"})
    EXPECT_EQ(plain_unit(text), "g m-3") << text;
  EXPECT_EQ(plain_unit("#/cm3"), "cm-3");
  EXPECT_EQ(plain_unit("1/kg"), "kg-1");
  EXPECT_EQ(plain_unit("1"), "1");
  EXPECT_TRUE(water_unit("kg kg**-1")->is_per_kg);
  EXPECT_EQ(water_unit("kg/m3")->factor, 1e3);
  EXPECT_EQ(water_unit("kg/kg")->factor, 1e3);
  EXPECT_EQ(number_unit("m^-3")->factor, 1e-6);
  EXPECT_EQ(radius_unit("m")->factor, 1e6);
  EXPECT_EQ(radius_unit("μm")->factor, 1);
  EXPECT_EQ(length_unit("km")->factor, 1e3);
  EXPECT_FALSE(water_unit("mm/h"));
  EXPECT_FALSE(water_unit("kg m-2"));
  EXPECT_FALSE(length_unit("degrees_north"));
}

}  // namespace
}  // namespace arcus::media
