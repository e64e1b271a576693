// Colours of the tabulated clear sky against published measurements: docs/clear_sky.md, "Colours".

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <string>

#include "media/air/sky_table.h"
#include "phase/base/frame.h"
#include "phase/base/units.h"
#include "phase/species/species_cache.h"
#include "src/film/colour.h"
#include "src/light/sun.h"

namespace arcus::render {
namespace {

struct Colour {
  double x, y;        ///< CIE 1931
  double cd_per_m2;
};

Colour colour_of(const Xyz& xyz) {
  constexpr double lumens_per_watt = 683.002, ybar_nm = 106.857;  // Y is a mean that is weighted with ybar
  const double sum = xyz.x + xyz.y + xyz.z;
  return {xyz.x / sum, xyz.y / sum, lumens_per_watt * ybar_nm * xyz.y};
}

/// Correlated colour temperature [K]: J. Hernández-Andrés, R. L. Lee, J. Romero, "Calculating correlated color temperatures across the entire gamut of
/// daylight and skylight chromaticities", Applied Optics 38, 5703, 1999: 3,000 to 10^6 K, with an epicentre for those above 50,000 K.
double temperature_k(const Colour& colour) {
  const double n = (colour.x - 0.3366) / (colour.y - 0.1735);
  const double low = -949.86315 + 6253.80338 * std::exp(-n / 0.92159) + 28.70599 * std::exp(-n / 0.20039) + 0.00004 * std::exp(-n / 0.07125);
  if (low <= 50000) return low;
  const double m = (colour.x - 0.3356) / (colour.y - 0.1691);
  return 36284.48953 + 0.00228 * std::exp(-m / 0.07861) + 5.4535e-36 * std::exp(-m / 0.01543);
}

/// How far above the CIE daylight locus: y less that of the locus at the same x (CIE 15; made from x = 0.25 to 0.38).
double above_daylight(const Colour& colour) { return colour.y - (-3 * colour.x * colour.x + 2.870 * colour.x - 0.275); }

void show(const std::string& name, const Colour& colour) {
  std::cout << "  " << name << ": x " << colour.x << ", y " << colour.y << ", " << temperature_k(colour) << " K, " << above_daylight(colour) << " above the daylight locus, " << colour.cd_per_m2 << " cd/m2\n";
}

class SkyColours : public testing::Test {
 protected:
  static media::SkyTable table(double sun_elevation_deg, double haze_depth, double ozone_dobson_units = 300) {
    media::AirSettings air;
    air.haze_depth_550 = haze_depth;
    air.ozone_dobson_units = ozone_dobson_units;
    const SunSettings sun;
    const auto haze = haze_depth > 0 ? std::make_shared<const media::Haze>("continental", phase::SpeciesOptions{.cache_folder = phase::default_cache_folder()}) : nullptr;
    return media::SkyTable(media::Atmosphere(air), haze, {direction_of(0, sun_elevation_deg), radians(sun.angular_radius_deg), 0.15}, 10, 0);
  }
  Colour seen(const media::SkyTable& table, double azimuth_deg, double elevation_deg) const {
    return colour_of(xyz_of([&](double nm) {
      Wavelengths wavelengths;
      wavelengths.nm.fill(static_cast<float>(nm));
      return static_cast<double>(table.radiance({0, 0, 1.7}, direction_of(azimuth_deg, elevation_deg), wavelengths)[0]) * irradiance_(nm);
    }));
  }
  Colour sunlight() const {
    return colour_of(xyz_of([&](double nm) { return irradiance_(nm); }));
  }

 private:
  Curve irradiance_ = sun_irradiance({}, "");
};

}  // namespace

/// D65, D100 and a Planck radiator of 20,000 K by their published chromaticities.
TEST_F(SkyColours, TemperaturesAreThoseOfKnownLights) {
  EXPECT_NEAR(temperature_k({0.3127, 0.3290, 0}), 6504, 10);
  EXPECT_NEAR(temperature_k({0.2787, 0.2920, 0}), 10000, 200);
  const Xyz planck = planck_white(20000);
  EXPECT_NEAR(temperature_k(colour_of(planck)), 20000, 400);
  EXPECT_NEAR(above_daylight({0.3127, 0.3290, 0}), 0, 3e-4);
}

// J. Hernández-Andrés, J. Romero, R. L. Lee, "Colorimetric and spectroradiometric characteristics of narrow-field-of-view clear skylight in Granada, Spain",
// Journal of the Optical Society of America A 18, 412, 2001 (abstract): of 1,500 spectra in 44 directions chromaticities "are close to but do not coincide with the
// CIE daylight locus", and temperatures range "from 3800 K to infinity".
TEST_F(SkyColours, LieAlongTheDaylightLocusFrom3800KUpwards) {
  for (const double sun_deg : {60.0, 20.0, 5.0}) {
    const media::SkyTable sky = table(sun_deg, 0.1);
    const Colour zenith = seen(sky, 0, 90);
    double least = 1e30;
    std::cout << "sun at " << sun_deg << " degrees:\n";
    show("zenith", zenith);
    for (const double azimuth_deg : {45.0, 90.0, 180.0})
      for (const double elevation_deg : {4.0, 20.0, 45.0}) {
        const Colour colour = seen(sky, azimuth_deg, elevation_deg);
        show("azimuth " + std::to_string(static_cast<int>(azimuth_deg)) + " elevation " + std::to_string(static_cast<int>(elevation_deg)), colour);
        EXPECT_GT(temperature_k(colour), 3800);
        EXPECT_NEAR(above_daylight(colour), 0, 0.012) << "sun " << sun_deg << " azimuth " << azimuth_deg << " elevation " << elevation_deg;
        if (elevation_deg == 4) least = std::min(least, temperature_k(colour));
      }
    // Blue above, whitish at the horizon; the less the higher the sun.
    EXPECT_GT(temperature_k(zenith), 10000) << sun_deg;
    EXPECT_GT(temperature_k(zenith), 1.4 * least) << sun_deg;
    EXPECT_LT(least, 8500) << sun_deg;
  }
}

// C. Chain, D. Dumortier, M. Fontoynont, "A comprehensive model of luminance, correlated colour temperature and spectral distribution of skylight: comparison with
// experimental data", Solar Energy 65, 285, 1999: measured at Vaulx-en-Velin; under a clear sky a place of luminance L [cd/m2] has 10^6 / (59.77 log10 L - 132.1) K.
// In mired, 10^6 / K, in which that is a straight line.
TEST_F(SkyColours, GoWithLuminanceAsMeasured) {
  for (const double haze_depth : {0.1, 0.25}) {
    const media::SkyTable sky = table(40, haze_depth);
    double sum = 0, most = 0;
    int count = 0;
    for (const double azimuth_deg : {60.0, 90.0, 135.0, 180.0})
      for (const double elevation_deg : {6.0, 12.0, 20.0, 30.0, 50.0}) {
        const Colour colour = seen(sky, azimuth_deg, elevation_deg);
        const double above_mired = 1e6 / temperature_k(colour) - (59.77 * std::log10(colour.cd_per_m2) - 132.1);
        sum += above_mired;
        most = std::max(most, std::fabs(above_mired));
        ++count;
      }
    std::cout << "haze " << haze_depth << ": " << sum / count << " mired above those measured, at most " << most << " from them\n";
    EXPECT_NEAR(sum / count, 0, haze_depth == 0.1 ? 35 : 20);
    EXPECT_LT(most, 70);
  }
}

// E. O. Hulburt, "Explanation of the brightness and color of the sky, particularly the twilight sky", Journal of the Optical Society of America 43, 113, 1953: with the sun on the
// horizon a third of the zenith's blue is by scattering, two thirds by ozone; found again by A. Lange, A. Rozanov, C. von Savigny, Atmospheric Chemistry and
// Physics 23, 14829, 2023 (abstract).
TEST_F(SkyColours, OzoneMakesTheZenithBlueAtSunset) {
  const auto zenith = [&](double sun_deg, double dobson_units) { return seen(table(sun_deg, 0, dobson_units), 0, 90); };
  // What counts as white: equal energy, and sunlight before the air.
  const Colour whites[2] = {colour_of(equal_energy_white()), sunlight()};
  const auto away = [](const Colour& a, const Colour& b) { return std::hypot(a.x - b.x, a.y - b.y); };
  for (const double sun_deg : {60.0, 0.0, -4.0}) {
    const Colour with = zenith(sun_deg, 300), without = zenith(sun_deg, 0);
    show("with ozone", with);
    show("without", without);
    double share[2];
    for (const int i : {0, 1}) share[i] = 1 - away(without, whites[i]) / away(with, whites[i]);
    std::cout << "sun at " << sun_deg << ": ozone's share of the zenith's distance from equal energy " << share[0] << ", from sunlight " << share[1] << "\n";
    if (sun_deg == 60) {
      EXPECT_NEAR(share[0], 0, 0.1) << "by day it hardly matters";
      continue;
    }
    EXPECT_GT(temperature_k(with), 13000);
    EXPECT_LT(temperature_k(without), 8000);
    if (sun_deg == 0) {
      EXPECT_NEAR(0.5 * (share[0] + share[1]), 2.0 / 3, 0.06);
      EXPECT_NEAR(share[0], share[1], 0.15);
    }
  }
}

}  // namespace arcus::render
