#include "phase/crystal/crystal_population.h"

#include <gtest/gtest.h>

#include <cmath>

#include "phase/base/error.h"
#include "phase/base/frame.h"
#include "phase/base/units.h"
#include "phase/settings/toml_text.h"
#include "tests/statistics/seed.h"
#include "tests/statistics/students_t.h"

namespace arcus::phase {
namespace {

using statistics::test_seed;

/// Length over diameter of a prism, from its volume and surface alone: the shapes do not tell.
double aspect_of(const CrystalShape& shape) {
  double top = 0;
  for (const CrystalFace& face : shape.faces())
    if (face.number == 1) top = face.area;
  const double radius = std::sqrt(top / (1.5 * std::sqrt(3.0)));
  return shape.volume() / top / (2 * radius);
}

}  // namespace

TEST(CrystalPopulation, SpreadsItsAspectRatiosLogNormally) {
  const CrystalPopulation crystals({.habit = {.aspect_ratio = 0.2}, .aspect_spread = 0.5}, 80);
  ASSERT_EQ(crystals.shapes().size(), 32u);
  double mean = 0, square = 0;
  for (const CrystalShape& shape : crystals.shapes()) {
    EXPECT_NEAR(shape.maximum_dimension(), 80, 1e-9);
    const double logarithm = std::log(aspect_of(shape) / 0.2);
    mean += logarithm / 32;
    square += logarithm * logarithm / 32;
  }
  EXPECT_NEAR(mean, 0, 1e-9);
  EXPECT_NEAR(std::sqrt(square), 0.5, 0.01);  // the middles of shares leave out the outermost
  EXPECT_EQ(CrystalPopulation({}, 80).shapes().size(), 1u);
  EXPECT_THROW(CrystalPopulation({.aspect_spread = -1}, 80), Error);
}

TEST(CrystalPopulation, LightMeetsCrystalsByTheirShadows) {
  const CrystalPopulation plates({.habit = {.aspect_ratio = 0.1},
                                  .aspect_spread = 0.7,
                                  .orientation = {.type = "plate", .tilt_deg = 30}},
                                 80);
  const Vec3 light = -direction_of(40, 25);
  Random random(test_seed(), 0, 0);
  // <A^2> / <A> over all is <A> over those met.
  statistics::Moments met;
  double sum = 0, squares = 0;
  const auto shadow = [&](const CrystalPopulation::Lying& lying) {
    return lying.shape.projected_area(lying.orientation.to_crystal(light));
  };
  for (int i = 0; i < 1'000'000; ++i) {
    const double area = shadow(plates.draw_any(random));
    sum += area;
    squares += area * area;
  }
  for (int i = 0; i < 200'000; ++i) met.add(shadow(plates.draw_met(light, random)));
  EXPECT_TRUE(statistics::mean_is(met, squares / sum, {.tolerance = 2e-3 * squares / sum}));
  EXPECT_FALSE(statistics::mean_is(met, sum / 1e6, {.tolerance = 2e-3 * squares / sum}));
}

TEST(CrystalPopulation, WhiteFurnace) {
  const CrystalPopulation columns({.habit = {.aspect_ratio = 3}, .orientation = {.type = "column"}},
                                  80);
  Random random(test_seed(), 0, 0);
  for (int i = 0; i < 20'000; ++i) {
    const auto exit = columns.draw(-direction_of(0, 30), 1.311, 0, random);
    ASSERT_TRUE(exit);
    EXPECT_NEAR(exit->light.i, 1, 1e-12);
    EXPECT_NEAR(length(exit->direction), 1, 1e-9);
  }
}

TEST(CrystalPopulation, IsWrittenAndRead) {
  CrystalSettings settings{.habit = {.aspect_ratio = 0.3}, .aspect_spread = 0.2};
  settings.habit.side_distances = {1, 1.5, 1, 1.5, 1, 1.5};
  settings.habit.upper.height = 0.5;
  settings.orientation = {.type = "parry", .tilt_deg = 0.4, .spread = "uniform", .roll_deg = 0.7};
  const std::string text = text_of(settings);
  CrystalSettings again;
  read_toml(text, "crystals", {}, [&](Keys& keys) { list_keys(keys, again); });
  EXPECT_EQ(text_of(again), text);
  EXPECT_EQ(again.habit.side_distances, settings.habit.side_distances);
  EXPECT_EQ(again.orientation.roll_deg, 0.7);
}

}  // namespace arcus::phase
