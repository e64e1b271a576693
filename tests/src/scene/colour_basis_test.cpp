#include "src/scene/colour_basis.h"

#include <gtest/gtest.h>

#include "phase/base/error.h"
#include "src/light/sun.h"
#include "src/scene/colour_spectrum.h"

namespace arcus::render {
namespace {

Rgb colour_of(const ThreeSpectra& basis, const std::array<float, 3>& shares, const ToRgb& to_rgb) {
  return to_rgb(xyz_of([&](double nm) { return static_cast<double>(basis.sum(shares.data(), nm)); }));
}

const std::vector<std::array<float, 3>> colours{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {0.2f, 0.5f, 1}, {1, 0.01f, 0.3f}};

}  // namespace

TEST(ColourBasis, LightHasTheColourOfItsPixelUnderEveryWhite) {
  const Curve sun = sun_irradiance({}, "");
  const Xyz sun_xyz = xyz_of([&](double nm) { return sun(nm); });
  for (const std::string white : {"auto", "D65", "equal_energy"}) {
    const ToRgb to_rgb = to_rgb_from_white(white_of(white, sun_xyz));
    const ThreeSpectra basis = light_basis(to_rgb, [&](double nm) { return white == "auto" ? sun(nm) : 1; });
    for (const auto& rgb : colours) {
      const Rgb found = colour_of(basis, rgb, to_rgb);
      EXPECT_NEAR(found.r, rgb[0], 1e-5) << white;
      EXPECT_NEAR(found.g, rgb[1], 1e-5) << white;
      EXPECT_NEAR(found.b, rgb[2], 1e-5) << white;
    }
    for (double nm = 380; nm <= 780; nm += 0.5) EXPECT_GE(basis.at(nm).min(), 0) << white;
  }
}

TEST(ColourBasis, WhitesWithoutSuchPrimariesAreRefused) {
  // Under the light of a Planck radiator of 1000 K Rec.709's blue would have to be bluer than any light.
  const ToRgb to_rgb = to_rgb_from_white(planck_white(1000));
  EXPECT_THROW(light_basis(to_rgb, [](double) { return 1; }), Error);
}

TEST(ColourBasis, WhiteLightHasTheShapeOfTheSun) {
  const Curve sun = sun_irradiance({}, "");
  const Xyz xyz = xyz_of([&](double nm) { return sun(nm); });
  const ThreeSpectra basis = light_basis(to_rgb_from_white(xyz), [&](double nm) { return sun(nm); });
  const std::array<float, 3> white{1, 1, 1};
  for (double nm = 380; nm <= 780; nm += 1) EXPECT_NEAR(basis.sum(white.data(), nm), sun(nm) / xyz.y, 1e-3 * sun(550) / xyz.y) << nm;
}

TEST(ColourBasis, ReflectancesKeepTheirColoursAndStayBelowOne) {
  const ToRgb to_rgb = to_rgb_from_white(equal_energy_white());
  const ThreeSpectra basis = reflectance_basis();
  for (const auto& rgb : colours) {
    const Rgb found = colour_of(basis, rgb, to_rgb);
    EXPECT_NEAR(found.r, rgb[0], 1e-5);
    EXPECT_NEAR(found.g, rgb[1], 1e-5);
    EXPECT_NEAR(found.b, rgb[2], 1e-5);
    for (double nm = 380; nm <= 780; nm += 0.5) {
      EXPECT_GE(basis.sum(rgb.data(), nm), 0);
      EXPECT_LE(basis.sum(rgb.data(), nm), 1 + 1e-6);
    }
  }
}

}  // namespace arcus::render
