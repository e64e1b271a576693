#include "src/film/tone.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace arcus::render {
namespace {

double luminance(const Rgb& c) { return 0.21263901 * c.r + 0.71516868 * c.g + 0.07219231 * c.b; }

}  // namespace

TEST(Tone, ColoursInsideTheGamutBelowTheShoulderAreUnchanged) {
  const Rgb c = display_linear({0.1, 0.5, 0.3});
  EXPECT_EQ(c.r, 0.1);
  EXPECT_EQ(c.g, 0.5);
  EXPECT_EQ(c.b, 0.3);
}

TEST(Tone, ColoursOutsideTheGamutKeepTheirLuminanceAndLoseOnlySaturation) {
  const Rgb cyan{-0.3, 0.4, 0.35};
  const Rgb shown = into_gamut(cyan);
  EXPECT_NEAR(luminance(shown), luminance(cyan), 1e-12);
  EXPECT_NEAR(shown.r, 0, 1e-15);
  const double grey = luminance(cyan);
  EXPECT_NEAR((shown.g - grey) / (cyan.g - grey), (shown.b - grey) / (cyan.b - grey), 1e-12);
  const Rgb none = into_gamut({-1, 0.1, 0.1});
  EXPECT_EQ(std::max({none.r, none.g, none.b}), 0) << "no luminance";
}

TEST(Tone, HighlightsStayBelowOneInOrderAndKeepTheirHue) {
  double before = 0.6;
  for (const double v : {0.61, 0.8, 1.0, 2.0, 10.0, 1e6}) {
    const Rgb c = display_linear({v, v / 2, v / 4});
    EXPECT_GT(c.r, before);
    EXPECT_LT(c.r, 1);
    EXPECT_NEAR(c.g / c.r, 0.5, 1e-12);
    before = c.r;
  }
  EXPECT_NEAR(display_linear({1, 1, 1}).g, 0.8, 1e-12) << "the reference";
  EXPECT_NEAR(display_linear({0.6 + 1e-6, 0, 0}).r, 0.6 + 1e-6, 1e-10)
      << "continuous with its slope";
}

TEST(Tone, SrgbCurveHasItsStandardValues) {
  EXPECT_EQ(srgb_encoded(0), 0);
  EXPECT_NEAR(srgb_encoded(1), 1, 1e-12);
  EXPECT_NEAR(srgb_encoded(0.0031308), 0.04045, 1e-5);
  EXPECT_NEAR(srgb_encoded(0.214041), 0.5, 1e-5);
}

TEST(Tone, ExposureAndReferenceScaleThePicture) {
  Image image(2, 1, {"R", "G", "B"});
  for (std::size_t c = 0; c < 3; ++c) image.value(0, 0, c) = 0.05f;
  image.value(1, 0, 1) = std::numeric_limits<float>::quiet_NaN();
  const auto level = [&](double exposure_ev, double reference) {
    return tone_mapped(image, {exposure_ev, reference}).rgb;
  };
  EXPECT_EQ(level(0, 0.1)[0], 188);  // sRGB of one half
  EXPECT_EQ(level(1, 0.2), level(0, 0.1));
  EXPECT_EQ(level(0, 0.1)[4], 0) << "not finite is black";
}

}  // namespace arcus::render
