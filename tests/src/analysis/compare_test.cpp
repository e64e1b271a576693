#include "src/analysis/compare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "phase/base/error.h"
#include "tests/src/analysis/ring_picture.h"

namespace arcus::render {
namespace {

RingPicture noisy_ring(std::uint64_t seed) {
  RingPicture ring{camera_towards_antisolar("perspective", 90, 120, 100)};
  ring.noise = 0.1;
  ring.has_variance = true;
  ring.seed = seed;
  return ring;
}

}  // namespace

TEST(Compare, KnownDifferencesGiveKnownFigures) {
  Image a(2, 2, {"R", "Q"}), b(2, 2, {"R", "P"});
  const float value_a[] = {1, 2, 3, 4}, value_b[] = {1, 2, 5, 4};
  for (int i = 0; i < 4; ++i) {
    a.value(i % 2, i / 2, 0) = value_a[i];
    b.value(i % 2, i / 2, 0) = value_b[i];
  }
  const Comparison c = compare(a, b, "a", "b");
  ASSERT_EQ(c.channels.size(), 1u);
  EXPECT_DOUBLE_EQ(c.channels[0].mean_a, 2.5);
  EXPECT_DOUBLE_EQ(c.channels[0].mean_b, 3);
  EXPECT_DOUBLE_EQ(c.channels[0].mean_difference, -0.5);
  EXPECT_DOUBLE_EQ(c.channels[0].rmse, 1);
  EXPECT_DOUBLE_EQ(c.channels[0].relative_mse, 1 / (25 + 0.009));
  EXPECT_DOUBLE_EQ(c.channels[0].largest, 2);
  EXPECT_EQ(c.channels[0].largest_x, 0);
  EXPECT_EQ(c.channels[0].largest_y, 1);
  EXPECT_FALSE(c.channels[0].noise);
  EXPECT_EQ(c.only_a, std::vector<std::string>{"Q"});
  EXPECT_EQ(c.only_b, std::vector<std::string>{"P"});
  EXPECT_FALSE(c.is_equal);
  EXPECT_TRUE(compare(a, a, "a", "a").is_equal);
}

TEST(Compare, PureNoiseHasUnitZAndABiasIsSeen) {
  const Image a = noisy_ring(1).made();
  Image b = noisy_ring(2).made();
  const Comparison same = compare(a, b, "a", "b");
  for (const auto& c : same.channels) {
    ASSERT_TRUE(c.noise);
    EXPECT_NEAR(c.noise->rms_z, 1, 0.03);
    EXPECT_NEAR(c.noise->share_beyond_3, 0.0027, 0.0025);
    EXPECT_LT(std::fabs(c.noise->mean_difference_z), 4);
    EXPECT_NEAR(c.rmse, 0.1 * std::sqrt(2.0), 0.003);
  }
  for (float& value : b.values()) value += 0.01f;  // a tenth of the noise of a pixel
  EXPECT_GT(std::fabs(compare(a, b, "a", "b").channels[0].noise->mean_difference_z), 6);
}

TEST(Compare, DifferentSizesOrNoCommonChannelAreAMismatch) {
  const auto fault_of = [](const Image& a, const Image& b) {
    try {
      compare(a, b, "a", "b");
    } catch (const Error& error) {
      return error.fault();
    }
    return Fault::failed;
  };
  EXPECT_EQ(fault_of(Image(2, 2, {"R"}), Image(2, 3, {"R"})), Fault::mismatch);
  EXPECT_EQ(fault_of(Image(2, 2, {"R"}), Image(2, 2, {0, 0, 1, 2}, {"R"})), Fault::mismatch);
  EXPECT_EQ(fault_of(Image(2, 2, {"R"}), Image(2, 2, {"G"})), Fault::mismatch);
}

TEST(Compare, ValuesThatAreNotFiniteAreCountedAndLeftOut) {
  Image a(2, 1, {"R", "G"}), b = a;
  a.value(0, 0, 0) = std::numeric_limits<float>::infinity();
  b.value(0, 0, 1) = std::nanf("");
  a.value(1, 0, 0) = 1;
  const Comparison c = compare(a, b, "a", "b");
  EXPECT_EQ(c.not_finite, 1u);
  EXPECT_EQ(c.pixels, 1u);
  EXPECT_DOUBLE_EQ(c.channels[0].rmse, 1);
  EXPECT_FALSE(c.is_equal);
}

TEST(Compare, DifferencePictureIsRedWhereAIsBrighterAndBlueWhereBIs) {
  Image a(3, 1, {"R"}), b(3, 1, {"R"});
  a.value(0, 0, 0) = 1;
  b.value(1, 0, 0) = 1;
  const DisplayPicture picture = difference_picture(a, b, "R", 1);
  EXPECT_GT(picture.rgb[0], picture.rgb[2] + 100);
  EXPECT_GT(picture.rgb[5], picture.rgb[3] + 100);
  EXPECT_EQ(picture.rgb[6], 255);
}

TEST(Compare, ReportIsOnePageWithItsPicturesInside) {
  const Image a = noisy_ring(1).made(), b = noisy_ring(2).made();
  const std::string page = html_report(a, b, compare(a, b, "x<y.exr", "b.exr"), "x<y.exr", "b.exr");
  EXPECT_NE(page.find("x&lt;y.exr"), std::string::npos);
  EXPECT_EQ(page.find("http"), std::string::npos) << "nothing from elsewhere";
  std::size_t pictures = 0;
  for (std::size_t at = page.find("data:image/png;base64,iVBOR"); at != std::string::npos;
       at = page.find("data:image/png;base64,iVBOR", at + 1))
    ++pictures;
  EXPECT_EQ(pictures, 2u + 6u + 1u);
}

}  // namespace arcus::render
