#include "tests/statistics/pixel_z.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "tests/statistics/seed.h"

namespace arcus::statistics {

namespace {

/// 40 by 30 pixels of brightness 1, each known to 5 %.
Picture noisy(std::uint64_t seed, double brightness) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> noise(brightness, 0.05);
  Picture picture{40, {}, std::vector<double>(1200, 0.05 * 0.05)};
  for (int i = 0; i < 1200; ++i) picture.mean.push_back(noise(generator));
  return picture;
}

}  // namespace

TEST(PixelZ, AcceptsPicturesThatDifferByTheirNoise) {
  EXPECT_TRUE(pictures_agree(noisy(test_seed(0), 1), noisy(test_seed(1), 1)));
}

TEST(PixelZ, RejectsOnePixelSevenStandardErrorsOff) {
  Picture a = noisy(test_seed(0), 1);
  const Picture exact{40, std::vector<double>(1200, 1.0), std::vector<double>(1200, 0.0)};
  EXPECT_TRUE(pictures_agree(a, exact));
  a.mean[41] = 1 + 7 * 0.05;
  const auto result = pictures_agree(a, exact);
  ASSERT_FALSE(result);
  EXPECT_NE(std::string(result.message()).find("pixel (1, 1)"), std::string::npos)
      << result.message();
}

TEST(PixelZ, RejectsAPictureTwoPercentBrighterThoughNoPixelShowsIt) {
  // 2 % of a pixel are 0.3 standard errors, of the whole picture 10.
  EXPECT_FALSE(pictures_agree(noisy(test_seed(0), 1.02), noisy(test_seed(1), 1)));
}

TEST(PixelZ, AllowsASystematicDifferenceOnlyWhenTold) {
  EXPECT_TRUE(pictures_agree(noisy(test_seed(0), 1.02), noisy(test_seed(1), 1),
                             {.relative_tolerance = 0.025}));
  EXPECT_FALSE(pictures_agree(noisy(test_seed(0), 1.02), noisy(test_seed(1), 1),
                              {.relative_tolerance = 0.005}));
}

TEST(PixelZ, ComparesExactlyWhereNothingVaries) {
  const std::vector<double> zero(4, 0.0);
  const Picture a{2, {1, 2, 0, 4}, zero}, b{2, {1, 2, 0, 4.01}, zero};
  EXPECT_TRUE(pictures_agree(a, a));
  EXPECT_FALSE(pictures_agree(a, b));
}

TEST(PixelZ, RejectsWhatIsNoPicture) {
  const Picture good{2, {1, 2}, {0.1, 0.1}}, wider{1, {1, 2}, {0.1, 0.1}};
  const Picture broken{2, {1, std::nan("")}, {0.1, 0.1}}, negative{2, {1, 2}, {0.1, -0.1}};
  EXPECT_TRUE(pictures_agree(good, good));
  for (const Picture& other : {wider, broken, negative, Picture{}})
    EXPECT_FALSE(pictures_agree(good, other));
  EXPECT_FALSE(pictures_agree(Picture{}, Picture{}));
}

}  // namespace arcus::statistics
