#include "src/film/colour.h"

#include <gtest/gtest.h>

#include <cmath>

#include "phase/base/error.h"
#include "src/light/sun.h"

namespace arcus::render {
namespace {

Xyz mean_of_samples(const std::function<double(double)>& spectrum, int count) {
  Xyz sum;
  for (int i = 0; i < count; ++i) {
    const Wavelengths wavelengths = draw_wavelengths((i + 0.5) / count);
    Spectrum radiance;
    for (int k = 0; k < wavelength_count; ++k)
      radiance[k] = static_cast<float>(spectrum(wavelengths[k]));
    sum += xyz_of_sample(radiance, wavelengths);
  }
  return sum * (1.0 / count);
}

void expect_grey(const Rgb& c, double value, double tolerance) {
  EXPECT_NEAR(c.r, value, tolerance);
  EXPECT_NEAR(c.g, value, tolerance);
  EXPECT_NEAR(c.b, value, tolerance);
}

}  // namespace

TEST(Colour, EqualEnergyLightHasLuminanceOfItsRadiance) {
  const Xyz white = equal_energy_white();
  EXPECT_NEAR(white.y, 1, 1e-7);
  // The three functions have nearly the same integral: that is how the CIE defined them.
  EXPECT_NEAR(white.x, 1, 5e-4);
  EXPECT_NEAR(white.z, 1, 5e-4);
}

TEST(Colour, ExpectationOfASampleIsTheIntegralOfTheSpectrum) {
  const auto flat = [](double) { return 3.0; };
  const auto steep = [](double nm) { return std::exp((nm - 500) / 60); };
  const auto line = [](double nm) { return std::exp(-0.5 * std::pow((nm - 611) / 4, 2)); };
  for (const std::function<double(double)>& spectrum :
       {std::function<double(double)>(flat), {steep}, {line}}) {
    const Xyz expected = xyz_of(spectrum), mean = mean_of_samples(spectrum, 40000);
    EXPECT_NEAR(mean.x / expected.x, 1, 2e-6);
    EXPECT_NEAR(mean.y / expected.y, 1, 2e-6);
    EXPECT_NEAR(mean.z / expected.z, 1, 2e-6);
  }
  EXPECT_NEAR(mean_of_samples(flat, 40000).y, 3, 3e-6);
}

TEST(Colour, GreyLightUnderAnEqualEnergySunIsGreyForAutoAndEqualEnergy) {
  const Xyz sun = xyz_of([](double) { return 1.0; });
  for (const char* setting : {"auto", "equal_energy"}) {
    const Rgb c = to_rgb_from_white(white_of(setting, sun))(
        mean_of_samples([](double) { return 0.25; }, 40000));
    expect_grey(c, 0.25, 0.25e-6);
  }
}

TEST(Colour, LightOfTheWhiteIsGreyWhateverTheWhite) {
  const auto reddish = [](double nm) { return nm / 550; };
  const Xyz white = xyz_of(reddish);
  expect_grey(to_rgb_from_white(white_of("auto", white))(white), white.y, 1e-12);
  const Xyz hot = planck_white(12000);
  expect_grey(to_rgb_from_white(white_of("12000", white))(hot), 1, 1e-12);
}

TEST(Colour, D65AndPlanckHaveTheirPublishedChromaticities) {
  const auto x_of = [](const Xyz& c) { return c.x / (c.x + c.y + c.z); };
  const auto y_of = [](const Xyz& c) { return c.y / (c.x + c.y + c.z); };
  const Xyz d65 = d65_white();
  EXPECT_NEAR(x_of(d65), 0.31272, 1e-4);  // CIE 015:2018, table T.3
  EXPECT_NEAR(y_of(d65), 0.32903, 1e-4);
  // Illuminant A is by definition a Planck radiator of 2856 K in the temperature scale of today (c2
  // = 1.4388e-2 m K).
  EXPECT_NEAR(x_of(planck_white(2855.54)), 0.44758, 1e-4);
  EXPECT_NEAR(y_of(planck_white(2855.54)), 0.40745, 1e-4);
}

TEST(Colour, WithoutAdaptationTheMatrixIsThatOfRec709) {
  // CIE XYZ to linear sRGB, IEC 61966-2-1 as recomputed with the primaries' exact chromaticities.
  const double expected[3][3] = {{3.2404542, -1.5371385, -0.4985314},
                                 {-0.9692660, 1.8760108, 0.0415560},
                                 {0.0556434, -0.2040259, 1.0572252}};
  const ToRgb to_rgb = to_rgb_from_white({0.3127 / 0.3290, 1, 0.3583 / 0.3290});
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(to_rgb.matrix[i][j], expected[i][j], 6e-4);
}

TEST(Colour, BradfordMatrixFromEqualEnergyToD65IsThePublishedOne) {
  // B. Lindbloom, "Chromatic Adaptation", Bradford, E to D65 (his D65 is (0.95047, 1, 1.08883)).
  const double adaptation[3][3] = {{0.9531874, -0.0265906, 0.0238731},
                                   {-0.0382467, 1.0288406, 0.0094060},
                                   {0.0026068, -0.0030332, 1.0892565}};
  const ToRgb adapted = to_rgb_from_white({1, 1, 1}),
              plain = to_rgb_from_white({0.3127 / 0.3290, 1, 0.3583 / 0.3290});
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      double product = 0;
      for (std::size_t k = 0; k < 3; ++k) product += plain.matrix[i][k] * adaptation[k][j];
      EXPECT_NEAR(adapted.matrix[i][j], product, 3e-4);
    }
}

TEST(Colour, SunHasTheChromaticityAndIlluminanceThatItsSourceStates) {
  const Curve irradiance = sun_irradiance(SunSettings{}, "");
  const Xyz sun = xyz_of([&](double nm) { return irradiance(nm); });
  const double sum = sun.x + sun.y + sun.z;
  EXPECT_NEAR(sun.x / sum, 0.3192, 1e-4);
  EXPECT_NEAR(sun.y / sum, 0.3288, 1e-4);
  EXPECT_NEAR(683 * 106.857 * sun.y, 133377,
              40);  // its wavelengths are in air, where they are 0.03 % shorter
}

TEST(Colour, BlackSunMeansEqualEnergyAndNonsenseIsRefused) {
  EXPECT_EQ(white_of("auto", {}).y, equal_energy_white().y);
  EXPECT_THROW(white_of("D56", {}), Error);
  EXPECT_THROW(white_of("500", {}), Error);
  EXPECT_THROW(to_rgb_from_white({1, 1, 0.0}), Error);  // no blue cone answers
}

}  // namespace arcus::render
