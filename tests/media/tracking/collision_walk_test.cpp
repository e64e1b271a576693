#include "media/tracking/collision_walk.h"

#include <gtest/gtest.h>

#include "media/tracking/optical_depth.h"
#include "media/tracking/transmittance.h"
#include "tests/media/kit.h"
#include "tests/statistics/cells.h"
#include "tests/statistics/chi_square.h"
#include "tests/statistics/seed.h"
#include "tests/statistics/students_t.h"

namespace arcus::media {
namespace {

using statistics::Moments;

TEST(CollisionWalk, PlacesCollisionsInOrderInsideTheRay) {
  const Medium medium({kit::component(kit::rough_grid({{0, 0, 0}, {80, 60, 70}}))});
  const Ray ray{{-5, 20, 30}, normalize(Vec3(1, 0.2, 0.1)), 10, 60};
  int collisions = 0;
  for (std::uint32_t i = 0; i < 200; ++i) {
    Random random(statistics::test_seed(), 0, i);
    CollisionWalk walk(medium, ray, kit::green(), random);
    Collision collision;
    double last = 10;
    while (walk.next(collision)) {
      EXPECT_GE(collision.distance_m, last);
      EXPECT_LE(collision.distance_m, 60);
      EXPECT_LE(collision.extinction_per_m.max(), collision.majorant_per_m);
      EXPECT_GE(collision.extinction_per_m.min(), 0);
      EXPECT_LT(length(collision.position_m - ray.at(collision.distance_m)), 1e-12);
      last = collision.distance_m;
      ++collisions;
    }
    EXPECT_FALSE(walk.next(collision)) << "a walk that has ended stays at its end";
  }
  EXPECT_GT(collisions, 200);
}

TEST(CollisionWalk, DependsOnItsRandomNumbersAlone) {
  const Medium medium({kit::component(kit::rough_grid({{0, 0, 0}, {80, 60, 70}})), kit::block({{0, 0, 0}, {50, 50, 50}}, 0.1f)});
  const Ray ray{{-5, 20, 30}, normalize(Vec3(1, 0.2, 0.1))};
  const auto walk_through = [&](std::uint32_t sample) {
    Random random(7, 3, sample);
    CollisionWalk walk(medium, ray, kit::green(), random);
    std::vector<double> all;
    Collision collision;
    while (walk.next(collision))
      all.insert(all.end(), {collision.distance_m, collision.extinction_per_m[0], static_cast<double>(collision.component)});
    return all;
  };
  EXPECT_EQ(walk_through(1), walk_through(1));
  EXPECT_NE(walk_through(1), walk_through(2));
}

TEST(CollisionWalk, LookupsHaveTheMeanOfTheInterpolatedField) {
  // With a ray of one point's length, every collision asks for the same place.
  const Medium medium({kit::component(kit::rough_grid({{0, 0, 0}, {80, 60, 70}}), kit::transforms()[2].second)});
  Random places(statistics::test_seed(1), 0, 0);
  int asked = 0;
  for (int i = 0; i < 400 && asked < 12; ++i) {
    const Vec3 p = kit::point_in(medium.bounds_m(), places);
    const float expected = medium.extinction_per_m(p, kit::green())[0];
    if (expected < 0.1f) continue;
    ++asked;
    Random random(statistics::test_seed(), 0, static_cast<std::uint32_t>(i));
    Moments moments;
    const Vec3 x(1, 0, 0);
    while (moments.count() < 20000) {
      CollisionWalk walk = CollisionWalk::forced(medium, {p, x, 0, 1e-9}, kit::green(), random,
                                                 majorant_depth(medium, {p, x, 0, 1e-9}), random.uniform_double());
      Collision collision;
      ASSERT_TRUE(walk.next(collision));
      moments.add(collision.extinction_per_m[0]);
    }
    EXPECT_TRUE(statistics::mean_is(moments, expected, {.comparisons = 12, .tolerance = 1e-6}));
  }
  EXPECT_EQ(asked, 12);
}

TEST(CollisionWalk, ChoosesComponentsInProportionToTheirExtinction) {
  std::vector<Component> components{kit::block({{0, 0, 0}, {10, 10, 10}}, 0.1f), kit::block({{2, 0, 0}, {12, 10, 10}}, 0.3f),
                                    kit::block({{20, 0, 0}, {30, 10, 10}}, 0.5f), kit::block({{0, 0, 0}, {8, 10, 10}}, 0.2f)};
  const Medium medium(components);
  const Ray ray{{4, 5, 5}, {1, 0, 0}, 0, 3};  // where the first, second and fourth overlap
  std::vector<Moments> shares(4);
  for (std::uint32_t i = 0; i < 40000; ++i) {
    Random random(statistics::test_seed(), 0, i);
    CollisionWalk walk(medium, ray, kit::green(), random);
    Collision collision;
    while (walk.next(collision)) {
      if (collision.extinction_per_m[0] == 0) continue;
      EXPECT_NEAR(collision.extinction_per_m[0], 0.6, 1e-6);
      EXPECT_NEAR(collision.component_extinction_per_m[0], medium.component(collision.component).extinction_scale, 1e-6);
      for (int k = 0; k < 4; ++k) shares[static_cast<std::size_t>(k)].add(collision.component == k);
    }
  }
  EXPECT_TRUE(statistics::mean_is(shares[0], 1.0 / 6, {.comparisons = 4}));
  EXPECT_TRUE(statistics::mean_is(shares[1], 3.0 / 6, {.comparisons = 4}));
  EXPECT_EQ(shares[2].mean(), 0);
  EXPECT_TRUE(statistics::mean_is(shares[3], 2.0 / 6, {.comparisons = 4}));
  EXPECT_FALSE(statistics::mean_is(shares[3], 2.1 / 6, {.comparisons = 4})) << "five percent must be seen";
}

TEST(CollisionWalk, FirstCollisionIsExponential) {
  const Medium medium({kit::block({{0, 0, 0}, {10, 10, 10}}, 0.3f)});
  const Ray ray{{-2, 5, 5}, {1, 0, 0}};
  const double majorant = medium.majorants().at(Vec3(5)).majorant_per_m, miss = std::exp(-10 * majorant);
  const statistics::IntervalCells cells(
      [&](double x) { return x < 2 ? 0.0 : x < 12 ? majorant * std::exp(-majorant * (x - 2)) : miss; }, 0, 13, 50, {2, 12});
  const statistics::IntervalCells tilted(
      [&](double x) {
        return x < 2 ? 0.0 : x < 12 ? majorant * std::exp(-majorant * (x - 2)) * (1 + 0.02 * (x - 5.2)) : miss;
      },
      0, 13, 50, {2, 12});
  statistics::Tally tally(cells), wrong(tilted);
  for (std::uint32_t i = 0; i < 400000; ++i) {
    Random random(statistics::test_seed(), 0, i);
    CollisionWalk walk(medium, ray, kit::green(), random);
    Collision collision;
    const double at = walk.next(collision) ? collision.distance_m : 12 + random.uniform_double();  // a miss
    tally.add(at);
    wrong.add(at);
  }
  EXPECT_TRUE(statistics::chi_square(tally));
  EXPECT_FALSE(statistics::chi_square(wrong));
}

TEST(CollisionWalk, ForcedFirstCollisionTimesItsProbabilityGivesTheSameMeans) {
  const Medium medium({kit::component(kit::rough_grid({{0, 0, 0}, {80, 60, 70}}))});
  for (const double scale : {1.0, 0.01}) {
    std::vector<Component> components{kit::component(kit::rough_grid({{0, 0, 0}, {80, 60, 70}}))};
    components[0].extinction_scale = static_cast<float>(0.05 * scale);
    const Medium thin(components);
    const Ray ray{{-5, 20, 30}, normalize(Vec3(1, 0.2, 0.1))};
    const double depth = majorant_depth(thin, ray);
    ASSERT_GT(depth, 0);
    // Probability that light is scattered at all: 1 − T.
    Moments forced, plain;
    for (std::uint32_t i = 0; i < 40000; ++i) {
      Random random(statistics::test_seed(), 0, i);
      Collision collision;
      CollisionWalk walk = CollisionWalk::forced(thin, ray, kit::green(), random, depth, random.uniform_double());
      bool scattered = false;
      ASSERT_TRUE(walk.next(collision));
      do scattered = random.uniform() * collision.majorant_per_m < collision.extinction_per_m[0];
      while (!scattered && walk.next(collision));
      forced.add(scattered ? -std::expm1(-depth) : 0);
      Random other(statistics::test_seed(1), 0, i);
      CollisionWalk usual(thin, ray, kit::green(), other);
      scattered = false;
      while (!scattered && usual.next(collision))
        scattered = other.uniform() * collision.majorant_per_m < collision.extinction_per_m[0];
      plain.add(scattered);
    }
    const double expected = -std::expm1(-optical_depth(thin, ray, 550));
    EXPECT_TRUE(statistics::mean_is(forced, expected, {.comparisons = 4, .tolerance = 1e-6}));
    EXPECT_TRUE(statistics::mean_is(plain, expected, {.comparisons = 4, .tolerance = 1e-6}));
    if (scale < 1) {
      EXPECT_LT(2 * forced.variance(), plain.variance()) << "this is what it is for";
    }
  }
}

TEST(CollisionWalk, StartsInsideTheMedium) {
  const Medium medium({kit::component(kit::uniform_grid(64))});
  const Ray ray{{32, 32, 32}, normalize(Vec3(0.3, -0.2, 1))};
  Moments first;
  for (std::uint32_t i = 0; i < 40000; ++i) {
    Random random(statistics::test_seed(), 0, i);
    CollisionWalk walk(medium, ray, kit::green(), random);
    Collision collision;
    ASSERT_TRUE(walk.next(collision));
    first.add(std::min(collision.distance_m, 20.0));
  }
  EXPECT_TRUE(statistics::mean_is(first, 1 - std::exp(-20.0), {.tolerance = 1e-5}));
}

TEST(CollisionWalk, OfNothingEndsAtOnce) {
  const Medium medium(std::vector<Component>{});
  Random random(1, 1, 1);
  CollisionWalk walk(medium, {{0, 0, 0}, {0, 0, 1}}, kit::green(), random);
  Collision collision;
  EXPECT_FALSE(walk.next(collision));
  EXPECT_EQ(majorant_depth(medium, {{0, 0, 0}, {0, 0, 1}}), 0);
  EXPECT_EQ(ratio_transmittance(medium, {{0, 0, 0}, {0, 0, 1}}, kit::green(), random).min(), 1);
}

}  // namespace
}  // namespace arcus::media
