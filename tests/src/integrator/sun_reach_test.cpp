#include "src/integrator/sun_reach.h"

#include <gtest/gtest.h>

#include "src/integrator/volume_path.h"
#include "tests/src/integrator/slab.h"
#include "tests/statistics/seed.h"
#include "tests/statistics/students_t.h"

namespace arcus::render {
namespace {

TEST(SunReach, IsExactInAHomogeneousBlock) {
  media::Component block;
  block.box = media::Box{Vec3(-10, -20, 0), Vec3(30, 20, 50)};
  block.extinction_scale = 0.2f;
  const std::vector<media::Component> components{block};
  const media::Medium medium(components);
  for (const double zenith_deg : {0.0, 15.0}) {
    const Vec3 to_sun = direction_of(90, 90 - zenith_deg);
    const SunReach reach(medium, to_sun);
    // Deep under the top and far from the side that the sun's rays would leave by.
    for (const double z : {49.0, 30.0, 1.3})
      EXPECT_NEAR(reach.optical_depth(Vec3(-4, 3, z)), 0.2 * (50 - z) / to_sun.z, 1e-3) << zenith_deg;
    EXPECT_EQ(reach.optical_depth(Vec3(0, 0, 50.1)), 0);
    EXPECT_EQ(reach.optical_depth(Vec3(0, -21, 10)), 0);
  }
  // From the east, level: the way out is the east face.
  const SunReach level(medium, Vec3(1, 0, 0));
  EXPECT_NEAR(level.optical_depth(Vec3(-5, 7, 20)), 0.2 * 35, 1e-3);
}

TEST(SunReach, IsNothingWhereThereIsNoMedium) {
  const media::Medium none{std::vector<media::Component>{}};
  EXPECT_EQ(SunReach(none, Vec3(0, 0, 1)).optical_depth(Vec3(0)), 0);
}

/// However wrong the guess, the mean stays: a thousand times too deep, most rays to the sun are left to chance.
TEST(SunReach, SteersAndNeverBiases) {
  Scene scene = slab_scene({.asymmetry = 0.6, .optical_depth = 3});
  const auto traced = [&](const VolumePath& integrator, int stream) {
    statistics::Moments moments;
    for (std::uint32_t i = 0; i < 60000; ++i) {
      Random random(statistics::test_seed(stream), 0, i);
      const Wavelengths wavelengths = draw_wavelengths(random.uniform_double());
      const FirstNumbers first{0.5, 0.5, 0.5, random.uniform_double(), random.uniform_double()};
      moments.add(integrator.radiance(slab_ray(0.7, 50), wavelengths, first, random).mean());
    }
    return moments;
  };
  const Scene opaque = slab_scene({.optical_depth = 3000});
  const VolumePath guided(scene, 1000), misled(scene, 1000, SunReach(*opaque.medium, opaque.sun.to_centre()));
  const statistics::Moments right = traced(guided, 0), wrong = traced(misled, 1);
  EXPECT_TRUE(statistics::means_agree(right, wrong));
  EXPECT_GT(wrong.variance(), 2 * right.variance()) << "the guess must matter, or this shows nothing";
  EXPECT_LT(wrong.standard_error(), 0.03 * wrong.mean());
}

}  // namespace
}  // namespace arcus::render
