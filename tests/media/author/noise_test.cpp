#include "media/author/noise.h"

#include <gtest/gtest.h>

#include <cmath>

#include "phase/base/random.h"

namespace arcus::media {
namespace {

TEST(Noise, IsSmoothBoundedAndVanishesOnItsLattice) {
  const Noise noise(5);
  Random random(1, 1, 1);
  for (int i = 0; i < 20000; ++i) {
    const Vec3 p(200 * random.uniform_double() - 100, 200 * random.uniform_double() - 100, 200 * random.uniform_double() - 100);
    const double value = noise.at(p);
    EXPECT_LE(std::fabs(value), 1.0);
    EXPECT_LT(std::fabs(noise.at(p + Vec3(1e-6, -1e-6, 1e-6)) - value), 1e-5);
    EXPECT_EQ(noise.at({std::floor(p.x), std::floor(p.y), std::floor(p.z)}), 0);
  }
}

TEST(Noise, HasMeanZeroAndFractalsOfItVarianceOne) {
  const Noise noise(9);
  Random random(2, 1, 1);
  for (const int octaves : {1, 4}) {
    double sum = 0, squares = 0;
    constexpr int count = 200000;
    for (int i = 0; i < count; ++i) {
      const Vec3 p(1e3 * random.uniform_double(), 1e3 * random.uniform_double(), 1e3 * random.uniform_double());
      const double value = noise.fractal(p, octaves, 0.6);
      sum += value;
      squares += value * value;
    }
    EXPECT_NEAR(sum / count, 0, 0.02);
    EXPECT_NEAR(squares / count, 1, 0.03) << octaves << " octaves";
  }
}

TEST(Noise, DoesNotRepeatAndFollowsItsSeed) {
  const Noise one(1), same(1), other(2);
  EXPECT_EQ(one.at({0.3, 0.4, 0.5}), same.at({0.3, 0.4, 0.5}));
  EXPECT_NE(one.at({0.3, 0.4, 0.5}), other.at({0.3, 0.4, 0.5}));
  EXPECT_NE(one.at({0.3, 0.4, 0.5}), one.at({256.3, 0.4, 0.5}));
}

// These numbers must come out on every machine, to the last bit: they were computed apart from the program, with the
// formulas in noise.h and whole-number arithmetic modulo 2^64, in fractions.
TEST(Noise, IsEqualOnEveryMachine) {
  const Noise noise(42);
  const std::pair<Vec3, double> golden[] = {
      {{0.5, 0.25, 0.125}, -3445415 / 134217728.0}, {{-3.75, 12.5, 0.5}, -821 / 2048.0}, {{100.5, -0.25, 7.75}, -688959 / 2097152.0}};
  for (const auto& [p, expected] : golden) EXPECT_EQ(noise.at(p), expected) << std::hexfloat << noise.at(p);
}

}  // namespace
}  // namespace arcus::media
