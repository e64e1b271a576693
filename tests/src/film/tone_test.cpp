#include "src/film/tone.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace arcus::render {
namespace {

double luminance(const Rgb& c) { return 0.21263901 * c.r + 0.71516868 * c.g + 0.07219231 * c.b; }

constexpr double y_of_cd = 1 / cd_per_m2_of_y;

struct Chromaticity {
  double x, y;
};
/// On a screen whose white is D65.
Chromaticity chromaticity(const Rgb& c) {
  const double x = 0.4124564 * c.r + 0.3575761 * c.g + 0.1804375 * c.b, y = luminance(c), z = 0.0193339 * c.r + 0.1191920 * c.g + 0.9503041 * c.b;
  return {x / (x + y + z), y / (x + y + z)};
}

Rgb grey(double cd_per_m2) { return {cd_per_m2 * y_of_cd, cd_per_m2 * y_of_cd, cd_per_m2 * y_of_cd}; }

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

TEST(NightAdaptation, LeavesBrightLightAsItIs) {
  const ToRgb to_rgb = to_rgb_from_white(equal_energy_white());
  const Rgb c{5 * y_of_cd, 6 * y_of_cd, 7 * y_of_cd};
  const Rgb seen = night_seen(c, to_rgb);
  EXPECT_EQ(seen.r, c.r);
  EXPECT_EQ(seen.g, c.g);
  EXPECT_EQ(seen.b, c.b);
}

TEST(NightAdaptation, InTheDarkAllIsTheRodsBluishGrey) {
  const ToRgb to_rgb = to_rgb_from_white(equal_energy_white());
  for (const Rgb& c : {Rgb{1, 1, 1}, Rgb{1, 0.2, 0.1}, Rgb{0.1, 1, 0.3}, Rgb{0, 0.1, 1}}) {
    const double dark = 0.005 * y_of_cd;
    const Chromaticity seen = chromaticity(night_seen({c.r * dark, c.g * dark, c.b * dark}, to_rgb));
    EXPECT_NEAR(seen.x, 0.25, 1e-4);
    EXPECT_NEAR(seen.y, 0.25, 1e-4);
  }
  // Equal-energy light: X = Y = Z, V = 2.31 Y (Larson, Rushmeier and Piatko), shown as 0.4468 V.
  EXPECT_NEAR(luminance(night_seen(grey(0.005), to_rgb)) / (0.005 * y_of_cd), 0.4468 * 2.31, 0.002);
  EXPECT_EQ(luminance(night_seen({}, to_rgb)), 0);
}

TEST(NightAdaptation, RodsSeeBlueBrighterThanRed) {
  const ToRgb to_rgb = to_rgb_from_white(equal_energy_white());
  // Red and blue of the same luminance: Purkinje's shift.
  const double dark = 0.005 * y_of_cd;
  const double red = luminance(night_seen({dark / 0.2126, 0, 0}, to_rgb)), blue = luminance(night_seen({0, 0, dark / 0.0722}, to_rgb));
  EXPECT_GT(blue, 5 * red);
}

TEST(NightAdaptation, FadesColourAndKeepsTheOrderOfLuminance) {
  const ToRgb to_rgb = to_rgb_from_white(d65_white());
  double before = 0, blue_before = 1;
  for (double cd = 1e-4; cd < 10; cd *= 1.1) {
    const Rgb seen = night_seen(grey(cd), to_rgb);
    EXPECT_GT(luminance(seen), before) << cd;
    before = luminance(seen);
    // The bluish tint leaves as the cones take over.
    const double x = chromaticity(seen).x;
    EXPECT_LE(blue_before == 1 ? 0 : blue_before, x + 1e-9) << cd;
    blue_before = x;
  }
  EXPECT_NEAR(share_of_cones(0.01), 0, 1e-12);
  EXPECT_NEAR(share_of_cones(std::pow(10, -0.7)), 0.5, 1e-12) << "in the middle between 0.01 and 4 cd/m2";
  EXPECT_NEAR(share_of_cones(4), 1, 1e-6);
}

TEST(NightAdaptation, KnowsTheLightBehindThePicturesWhite) {
  // A white of 4000 K is R = G = B in its own picture, yet has less for the rods than equal-energy light.
  const Xyz warm = planck_white(4000);
  const double own = luminance(night_seen(grey(0.005), to_rgb_from_white(warm))), even = luminance(night_seen(grey(0.005), to_rgb_from_white(equal_energy_white())));
  EXPECT_NEAR(own / even, (1.33 * (1 + (warm.y + warm.z) / warm.x) - 1.68) / 2.31, 0.01);
}

TEST(NightAdaptation, IsForThePngAlone) {
  Image image(1, 1, {"R", "G", "B"});
  for (std::size_t c = 0; c < 3; ++c) image.value(0, 0, c) = static_cast<float>((c + 1) * 0.003 * y_of_cd);
  ToneSettings tone{0, 0.02 * y_of_cd};
  const DisplayPicture day = tone_mapped(image, tone);
  tone.night = to_rgb_from_white(equal_energy_white());
  const DisplayPicture night = tone_mapped(image, tone);
  EXPECT_NE(day.rgb, night.rgb);
  EXPECT_EQ(image.value(0, 0, 1), static_cast<float>(2 * 0.003 * y_of_cd));
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
