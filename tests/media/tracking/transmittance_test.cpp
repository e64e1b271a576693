#include "media/tracking/transmittance.h"

#include <gtest/gtest.h>

#include "media/tracking/collision_walk.h"
#include "media/tracking/optical_depth.h"
#include "tests/media/kit.h"
#include "tests/statistics/seed.h"
#include "tests/statistics/students_t.h"

namespace arcus::media {
namespace {

using statistics::MeanOptions;
using statistics::Moments;

struct Case {
  std::string name;
  Medium medium;
  Ray ray;
};

/// The fields of house rules: uniform, ramp, checkerboard; seen obliquely, from outside and from inside.
std::vector<std::unique_ptr<Case>> cases() {
  std::vector<std::unique_ptr<Case>> result;
  const auto add = [&](const std::string& name, std::vector<Component> components, const Ray& ray) {
    result.emplace_back(new Case{name, Medium(std::move(components)), ray});
  };
  const auto thin = [](Component c, float scale) {
    c.extinction_scale = scale;
    return std::vector<Component>{c};
  };
  const Vec3 oblique = normalize(Vec3(1, 0.35, -0.2));
  add("uniform block", {kit::block({{0, 0, 0}, {10, 10, 10}}, 0.15f)}, {{-3, 4, 6}, oblique});
  add("uniform grid", thin(kit::component(kit::uniform_grid(40)), 0.04f), {{-3, 10, 26}, oblique});
  add("ramp", thin(kit::component(kit::ramp_grid(64)), 0.05f), {{-3, 10, 40}, oblique});
  add("ramp, nearest", thin(kit::component(kit::ramp_grid(64), {}, Interpolation::nearest), 0.05f), {{-3, 10, 40}, oblique});
  add("checkerboard", thin(kit::component(kit::checkerboard_grid(64, 5)), 0.06f), {{-3, 10, 40}, oblique});
  add("checkerboard, nearest, from inside", thin(kit::component(kit::checkerboard_grid(64, 5), {}, Interpolation::nearest), 0.06f),
      {{11, 12, 33}, oblique});
  for (const auto& [name, map] : kit::transforms())
    add("rough, " + name, thin(kit::component(kit::rough_grid({{0, 0, 0}, {80, 60, 70}}), map), 0.02f),
        {map.point({40, 30, 35}) - oblique * 100, oblique});
  add("overlapping", {kit::block({{0, 0, 0}, {30, 30, 30}}, 0.02f),
                      thin(kit::component(kit::ramp_grid(40), Affine::rotation_deg({10, 20, 30})), 0.03f)[0],
                      thin(kit::component(kit::checkerboard_grid(32, 3), Affine::scaling(Vec3(1.3))), 0.03f)[0]},
      {{-3, 10, 20}, oblique});
  return result;
}

TEST(RatioTransmittance, HasTheMeanThatQuadratureGives) {
  const auto all = cases();
  for (const auto& c : all) {
    const double expected = std::exp(-optical_depth(c->medium, c->ray, 550));
    ASSERT_LT(expected, 0.9) << c->name;
    Moments moments;
    for (int i = 0; i < 40000; ++i) {
      Random random(statistics::test_seed(), 1, static_cast<std::uint32_t>(i));
      moments.add(ratio_transmittance(c->medium, c->ray, kit::green(), random)[0]);
    }
    EXPECT_TRUE(statistics::mean_is(moments, expected, {.comparisons = static_cast<int>(all.size()), .tolerance = 1e-6}))
        << c->name;
  }
}

TEST(DeltaTracking, SurvivesAsOftenAsQuadratureSays) {
  const auto all = cases();
  for (const auto& c : all) {
    const double expected = std::exp(-optical_depth(c->medium, c->ray, 550));
    Moments moments;
    for (int i = 0; i < 40000; ++i) {
      Random random(statistics::test_seed(), 2, static_cast<std::uint32_t>(i));
      CollisionWalk walk(c->medium, c->ray, kit::green(), random);
      Collision collision;
      bool survives = true;
      while (survives && walk.next(collision))
        survives = random.uniform() * collision.majorant_per_m >= collision.extinction_per_m[0];
      moments.add(survives);
    }
    EXPECT_TRUE(statistics::mean_is(moments, expected, {.comparisons = static_cast<int>(all.size()), .tolerance = 1e-6}))
        << c->name;
  }
}

TEST(RatioTransmittance, IsUnbiasedWhereAlmostNothingIsLeft) {
  const Medium medium({kit::block({{0, 0, 0}, {10, 10, 10}}, 0.7f)});
  const Ray ray{{-1, 5, 5}, {1, 0, 0}};
  Moments moments;
  for (int i = 0; i < 200000; ++i) {
    Random random(statistics::test_seed(), 3, static_cast<std::uint32_t>(i));
    moments.add(ratio_transmittance(medium, ray, kit::green(), random)[0]);
  }
  EXPECT_TRUE(statistics::mean_is(moments, std::exp(-7.0), {.tolerance = 1e-7}));
}

// What a wrong majorant would do: a medium in which every fiftieth collision is left out must be told from the right one.
TEST(RatioTransmittance, TestsNoticeAMajorantTwoPercentTooLow) {
  const auto all = cases();
  for (const std::string name : {"uniform block", "ramp", "checkerboard"}) {
    const auto c = std::find_if(all.begin(), all.end(), [&](const auto& x) { return x->name == name; });
    const double expected = std::exp(-optical_depth((*c)->medium, (*c)->ray, 550));
    Moments moments;
    for (int i = 0; i < 200000; ++i) {
      Random random(statistics::test_seed(), 4, static_cast<std::uint32_t>(i));
      CollisionWalk walk((*c)->medium, (*c)->ray, kit::green(), random);
      Collision collision;
      double remaining = 1;
      while (walk.next(collision))
        if (random.uniform() >= 0.02f) remaining *= 1 - collision.extinction_per_m[0] / collision.majorant_per_m;
      moments.add(remaining);
    }
    EXPECT_FALSE(statistics::mean_is(moments, expected, {.comparisons = static_cast<int>(all.size()), .tolerance = 1e-6}))
        << name;
  }
}

TEST(OpticalDepth, MeetsClosedForms) {
  const Medium block({kit::block({{0, 0, 0}, {10, 20, 30}}, 0.25f)});
  EXPECT_NEAR(optical_depth(block, {{-5, 3, 3}, {1, 0, 0}}, 550), 2.5, 1e-6);
  EXPECT_NEAR(optical_depth(block, {{5, 3, 3}, {1, 0, 0}}, 550), 1.25, 1e-6);
  EXPECT_NEAR(optical_depth(block, {{5, 3, 3}, {1, 0, 0}, 1, 3}, 550), 0.5, 1e-6);
  // A uniform grid of n voxels fades out over one voxel on either side: n voxels' worth along an axis in between.
  for (const auto& [name, map] : kit::transforms()) {
    const Medium grid({kit::component(kit::uniform_grid(20), map)});
    const Vec3 along = map.vector({1, 0, 0});
    const double depth = optical_depth(grid, {map.point({-30, 9.4, 9.6}), normalize(along)}, 550);
    EXPECT_NEAR(depth, 20 * length(along), 1e-4) << name;
  }
  // Nearest: voxel i fills [i − ½, i + ½].
  const Medium nearest({kit::component(kit::uniform_grid(20), {}, Interpolation::nearest)});
  EXPECT_NEAR(optical_depth(nearest, {{-30, 9.4, 9.6}, {1, 0, 0}}, 550), 20, 1e-5);
  EXPECT_NEAR(optical_depth(nearest, {{-30, 19.4, 9.6}, {1, 0, 0}}, 550), 20, 1e-5);
  EXPECT_NEAR(optical_depth(nearest, {{-30, 19.6, 9.6}, {1, 0, 0}}, 550), 0, 1e-5);
  // A ramp in x, crossed along x: the integral of x/(n−1) with the fading at its end.
  const Medium ramp({kit::component(kit::ramp_grid(11))});
  EXPECT_NEAR(optical_depth(ramp, {{-5, 5, 5}, {1, 0, 0}}, 550), 5.5, 1e-5);
  // Crossed obliquely: compared with a fine sum.
  const Medium rough({kit::component(kit::rough_grid({{0, 0, 0}, {40, 40, 40}}), kit::transforms()[3].second)});
  const Ray ray{{-5, -2, 5}, normalize(Vec3(1, 0.7, 0.6))};
  double sum = 0;
  constexpr int steps = 200000;
  for (int i = 0; i < steps; ++i) sum += rough.extinction_per_m(ray.at((i + 0.5) * 100.0 / steps), kit::green())[0] * 100.0 / steps;
  EXPECT_NEAR(optical_depth(rough, ray, 550), sum, 2e-3);
  EXPECT_GT(sum, 10);
}

}  // namespace
}  // namespace arcus::media
