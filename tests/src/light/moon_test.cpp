#include "src/light/moon.h"

#include <gtest/gtest.h>

#include <cmath>

#include "phase/base/random.h"
#include "src/film/colour.h"
#include "src/light/sun.h"
#include "src/render/picture.h"
#include "tests/statistics/moments.h"
#include "tests/statistics/seed.h"
#include "tests/statistics/students_t.h"

namespace arcus::render {
namespace {

constexpr double lux_per_y = 683 * 106.857;

SunSettings moon_at(double phase_angle_deg, double bright_limb_deg = 270) {
  return {.azimuth_deg = 130, .elevation_deg = 35, .body = "moon", .phase_angle_deg = phase_angle_deg, .bright_limb_deg = bright_limb_deg,
          .angular_radius_deg = phase::mean_moon_radius_deg};
}

double magnitudes(double ratio) { return -2.5 * std::log10(ratio); }

}  // namespace

TEST(Moon, IsAsBrightAndAsRedAsItIsMeasured) {
  const double sun_lux = lux_per_y * sun_colour(sun_irradiance({}, "")).y, full_lux = lux_per_y * sun_colour(sun_irradiance(moon_at(0), "")).y;
  EXPECT_NEAR(sun_lux, 133.4e3, 200) << "solar_spectrum_toa.csv";
  // V = -12.73 is 0.31 lx with Allen's 2.54e-6 lx for V = 0; the sun's V = -26.74 is 126 klx by the same figure, 6 % less than its measured spectrum
  // has.
  EXPECT_NEAR(full_lux, 0.33, 0.015);
  EXPECT_NEAR(full_lux / sun_lux * 126e3, 0.31, 0.01);
  // B - V is 0.92 for the full moon and 0.65 for the sun (Allen, Astrophysical Quantities, 1976; 0.653 for the sun: Ramirez et al., ApJ 752, 5,
  // 2012). B and V see around 440 and 550 nm.
  const MoonReflection full(0);
  EXPECT_NEAR(magnitudes(full.irradiance_over_suns(440) / full.irradiance_over_suns(550)), 0.92 - 0.65, 0.04);
}

TEST(Moon, FadesWithItsPhaseAsBothSourcesSay) {
  const auto fainter = [](double g) { return magnitudes(MoonReflection(g).irradiance_over_suns(550) / MoonReflection(0).irradiance_over_suns(550)); };
  EXPECT_NEAR(fainter(90), 2.60, 0.01) << "Krisciunas and Schaefer, equation 9: a half moon has an eleventh of the light";
  EXPECT_NEAR(fainter(120), 3.95, 0.01);
  // Kieffer and Stone's disc reflectance at 549.1 nm, their equation 10 by hand, times the moon's solid angle over pi: 6.4177e-5 / pi = 2.0428e-5.
  for (const auto& [g, reflectance] : {std::pair{7.0, 0.1006}, {30.0, 0.0546}, {60.0, 0.0260}, {90.0, 0.01055}})
    EXPECT_NEAR(MoonReflection(g).irradiance_over_suns(550) / (reflectance * 2.0428e-5), 1, 0.09) << g;
}

TEST(Moon, GrowsRedderAwayFromFull) {
  const auto red_over_blue = [](double g) { return MoonReflection(g).irradiance_over_suns(650) / MoonReflection(g).irradiance_over_suns(450); };
  EXPECT_GT(red_over_blue(90), 1.02 * red_over_blue(10));
}

TEST(MoonFace, ItsRadianceHasTheMeanOfOneAndItsDarkPartNone) {
  for (const double g : {0.0, 20.0, 90.0, 150.0, 170.0}) {
    const MoonFace face(g);
    double sum = 0, lit = 0;
    constexpr int n = 1000;
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < n; ++k) {
        const MoonFace::Place p{2 * (i + 0.5) / n - 1, 2 * (k + 0.5) / n - 1};
        if (p.x * p.x + p.y * p.y >= 1) continue;
        const double radiance = face.relative_radiance(p);
        EXPECT_LE(radiance, face.most_radiance() * (1 + 1e-12));
        EXPECT_EQ(radiance > 0, face.is_lit(p));
        sum += radiance;
        lit += face.is_lit(p);
      }
    const double cells = pi / 4 * n * n;
    EXPECT_NEAR(sum / cells, 1, g > 160 ? 0.02 : 0.004) << g;
    EXPECT_NEAR(lit / cells, face.lit_share(), 0.002) << g;
  }
}

TEST(MoonLight, DrawnFromItsLitPartMeansWhatTheWholeDiscSends) {
  // Light through a filter that lets pass by the place on the sky: wrong densities, or draws off the lit part, would change its mean.
  const auto filter = [](const Vec3& direction, const Vec3& centre) { return 1 + 200 * (direction.x - centre.x) + 150 * (direction.z - centre.z); };
  const Wavelengths wavelengths = {{550, 550, 550, 550}};
  for (const double g : {0.0, 60.0, 120.0, 165.0}) {
    const SunSettings settings = moon_at(g, 30);
    const Sun moon(settings, sun_irradiance(settings, ""));
    SunSettings full_settings = moon_at(0);
    const Sun full(full_settings, sun_irradiance(full_settings, ""));  // draws from the whole disc
    const SunLight light = moon.light(wavelengths);
    statistics::Moments drawn, chance;
    Random random(statistics::test_seed(), 1, 0);
    for (int i = 0; i < 200000; ++i) {
      const Vec3 a = moon.draw(random.uniform_double(), random.uniform_double()), b = full.draw(random.uniform_double(), random.uniform_double());
      ASSERT_GT(moon.density_per_sr(a), 0);
      drawn.add(moon.radiance(a, light)[0] / moon.density_per_sr(a) * filter(a, moon.to_centre()));
      chance.add(moon.radiance(b, light)[0] / full.density_per_sr(b) * filter(b, moon.to_centre()));
    }
    EXPECT_TRUE(statistics::means_agree(drawn, chance, {.comparisons = 4})) << g;
    if (g > 0) {
      EXPECT_LT(drawn.variance(), chance.variance()) << g;
    }
  }
}

TEST(MoonLight, HasTheIrradianceOfItsSpectrumAndItsBrightLimbWhereItIsSaid) {
  const Wavelengths wavelengths = {{450, 550, 600, 650}};
  for (const double limb : {0.0, 90.0, 270.0}) {
    const SunSettings settings = moon_at(100, limb);
    const Sun moon(settings, sun_irradiance(settings, ""));
    const SunLight light = moon.light(wavelengths);
    Random random(statistics::test_seed(), 2, 0);
    Vec3 middle(0, 0, 0);
    Spectrum sum;
    constexpr int n = 100000;
    for (int i = 0; i < n; ++i) {
      const Vec3 to = moon.draw(random.uniform_double(), random.uniform_double());
      const Spectrum part = moon.radiance(to, light) * static_cast<float>(1 / moon.density_per_sr(to) / n);
      sum += part;
      middle = middle + (to - moon.to_centre()) * static_cast<double>(part[1]);
    }
    for (int k = 0; k < wavelength_count; ++k) EXPECT_NEAR(sum[k] / light.irradiance_w_per_m2_nm[k], 1, 0.01);
    const Vec3 up(-std::sin(radians(35)) * std::sin(radians(130)), -std::sin(radians(35)) * std::cos(radians(130)), std::cos(radians(35)));
    const Vec3 right(std::cos(radians(130)), -std::sin(radians(130)), 0);
    const Vec3 towards = normalize(middle);
    EXPECT_NEAR(dot(towards, up), std::cos(radians(limb)), 0.02);
    EXPECT_NEAR(dot(towards, right), -std::sin(radians(limb)), 0.02);
  }
}

TEST(MoonLight, IsExposedAsTheSunIs) {
  SceneSettings scene;
  scene.sun = moon_at(0);
  const Xyz colour = sun_colour(sun_irradiance(scene.sun, ""));
  EXPECT_NEAR(tone_of(scene, colour).reference_radiance, colour.y / pi, 1e-12);
  EXPECT_LT(colour.y, 1e-5);
}

}  // namespace arcus::render
