#include <gtest/gtest.h>

#include "phase/optics/fresnel.h"
#include "src/film/colour.h"
#include "src/scene/colour_spectrum.h"
#include "tests/src/simple_surfaces.h"

namespace arcus::render {
namespace {

const Wavelengths green{{550, 550, 550, 550}};

Vec3 arriving(double angle_deg) { return {std::sin(radians(angle_deg)), 0, -std::cos(radians(angle_deg))}; }
const Vec3 up(0, 0, 1);

}  // namespace

TEST(Dielectric, SharesAreFresnelsAndAddUp) {
  for (const double n : {1.0, 1.33, 1.5, 1 / 1.33})
    for (const double angle_deg : {0.0, 10.0, 45.0, 48.0, 49.0, 80.0, 89.999, 90.0}) {
      const Turns turns = fresnel_turns(arriving(angle_deg), up, n, {});
      EXPECT_NEAR(turns.reflected.share[0] + turns.transmitted.share[0], 1, 1e-6) << n << " " << angle_deg;
      EXPECT_NEAR(turns.reflected.share[0], phase::fresnel_reflectance(std::cos(radians(angle_deg)), n).unpolarised(), 1e-6);
      if (turns.transmitted.is_there()) {
        EXPECT_NEAR(turns.transmitted.direction.x * n, std::sin(radians(angle_deg)), 1e-12);  // Snell
      }
    }
  EXPECT_NEAR(fresnel_turns(arriving(0), up, 1.5, {}).reflected.share[0], 0.04, 1e-7);
  EXPECT_EQ(fresnel_turns(arriving(50), up, 1 / 1.33, {}).transmitted.share[0], 0);  // beyond 48.75 degrees
  EXPECT_NEAR(fresnel_turns(arriving(89.9999), up, 1.33, {}).reflected.share[0], 1, 1e-4);
}

TEST(Dielectric, PolarisationIsCarriedFromFaceToFace) {
  // Reflected under Brewster's angle light is polarised across the plane of incidence; a second such face whose plane is turned by a right
  // angle reflects nothing of it, and one in the same plane twice what it reflects of natural light.
  const double n = 1.5, brewster_deg = degrees(std::atan(n));
  const Turn once = fresnel_turns(arriving(brewster_deg), up, n, {}).reflected;
  EXPECT_NEAR(once.polarised.light.q, -1, 1e-9);
  const Vec3 in_plane = normalize(Vec3(once.direction.z, 0, -once.direction.x));
  const auto face = [&](const Vec3& across) {  // its normal leans back from the ray, by the angle, in the plane of ray and `across`
    return normalize(-once.direction * std::cos(radians(brewster_deg)) + across * std::sin(radians(brewster_deg)));
  };
  const double natural = fresnel_turns(arriving(brewster_deg), up, n, {}).reflected.share[0];
  EXPECT_NEAR(fresnel_turns(once.direction, face(Vec3(0, 1, 0)), n, once.polarised).reflected.share[0], 0, 1e-9);
  EXPECT_NEAR(fresnel_turns(once.direction, face(in_plane), n, once.polarised).reflected.share[0], 2 * natural, 1e-6);
}

TEST(Dielectric, LightTakesTheSameShareBackThroughAnyTwoFaces) {
  // Reciprocity, with polarisation: through two faces that are turned against one another, and back from natural light again.
  const double n = 1.4;
  const Vec3 first = normalize(Vec3(0.5, 0.1, 1)), second = normalize(Vec3(-0.3, 0.7, -0.8));
  const Vec3 in = normalize(Vec3(-0.4, 0.2, -1));
  const Turn a = fresnel_turns(in, first, n, {}).transmitted;
  const Vec3 inner = dot(a.direction, second) < 0 ? second : -second;
  const Turn b = fresnel_turns(a.direction, inner, 1 / n, a.polarised).transmitted;
  ASSERT_TRUE(b.is_there());
  const Turn back_b = fresnel_turns(-b.direction, -inner, n, {}).transmitted;
  const Turn back_a = fresnel_turns(back_b.direction, -first, 1 / n, back_b.polarised).transmitted;
  EXPECT_NEAR(length(back_a.direction + in), 0, 1e-12);
  EXPECT_NEAR(a.share[0] * b.share[0], back_b.share[0] * back_a.share[0], 1e-7);
  // Natural light at the second face would not do.
  const Turn careless = fresnel_turns(a.direction, inner, 1 / n, {}).transmitted;
  EXPECT_GT(std::fabs(careless.share[0] - b.share[0]), 1e-4);
}

TEST(Transparent, SharesAreConstantBelowTotalReflection) {
  const Material glass(Transparent{ClearBody(phase::RefractiveIndex::constant({1.5, 0}), SmoothSpectrum(1), 1), 0.2, 0.7});
  const Turns slant = glass.turns(arriving(70), up, false, green, {});
  EXPECT_FLOAT_EQ(slant.reflected.share[0], 0.2f);
  EXPECT_FLOAT_EQ(slant.transmitted.share[0], 0.7f);
  const Turns total = glass.turns(arriving(70), up, true, green, {});
  EXPECT_EQ(total.reflected.share[0], 1);
  EXPECT_FALSE(total.transmitted.is_there());
}

TEST(Mirror, ReflectsItsColour) {
  const Material copper(Mirror{spectrum_of_colour({0.9, 0.5, 0.3})});
  const Wavelengths far{{440, 550, 640, 700}};
  const Turns turns = copper.turns(arriving(30), up, false, far, {});
  EXPECT_NEAR(turns.reflected.direction.z, std::cos(radians(30)), 1e-12);
  EXPECT_LT(turns.reflected.share[0], turns.reflected.share[1]);
  EXPECT_LT(turns.reflected.share[1], turns.reflected.share[2]);
  EXPECT_FALSE(turns.transmitted.is_there());
}

TEST(ClearBody, AbsorbsByBeerAndLambert) {
  // k = 1e-7 at 550 nm: 4 pi k n_air / 550 nm = 2.2855 per metre; a filter that leaves half in 2 m: ln 2 / 2 more.
  const ClearBody body(phase::RefractiveIndex::constant({1.33, 1e-7}), SmoothSpectrum(0.5), 2);
  EXPECT_NEAR(body.transmittance(1.5, green)[0], std::exp(-1.5 * (2.2855 + std::log(2) / 2)), 2e-5);
  EXPECT_FALSE(body.is_dispersive());
  EXPECT_TRUE(ClearBody(phase::RefractiveIndex::water(), SmoothSpectrum(1), 1).is_dispersive());
}

TEST(ClearBody, WaterBendsAsDaimonAndMasumuraMeasured) {
  const ClearBody body(phase::RefractiveIndex::water(), SmoothSpectrum(1), 1);
  for (const double nm : {400.0, 550.5, 700.0}) EXPECT_NEAR(body.index(nm), phase::RefractiveIndex::water().relative_to_air(nm).real(), 1e-6);
}

TEST(SmoothSpectrum, HasTheColourThatWasAskedFor) {
  const ToRgb to_rgb = to_rgb_from_white(equal_energy_white());
  for (const std::vector<double>& colour : {std::vector<double>{0.8, 0.2, 0.1}, {0.1, 0.5, 0.2}, {0.05, 0.1, 0.7}, {0.9, 0.85, 0.2}, {0.02, 0.02, 0.03}}) {
    const SmoothSpectrum spectrum = spectrum_of_colour(colour);
    const Rgb rgb = to_rgb(xyz_of([&](double nm) { return spectrum.at(nm); }));
    EXPECT_NEAR(rgb.r, colour[0], 1e-4);
    EXPECT_NEAR(rgb.g, colour[1], 1e-4);
    EXPECT_NEAR(rgb.b, colour[2], 1e-4);
    for (double nm = 380; nm <= 780; nm += 10) {
      EXPECT_GE(spectrum.at(nm), 0);
      EXPECT_LE(spectrum.at(nm), 1);
    }
  }
  // Beyond what a reflectance can be it comes near, and stays one.
  const SmoothSpectrum red = spectrum_of_colour({1, 0, 0});
  const Rgb rgb = to_rgb(xyz_of([&](double nm) { return red.at(nm); }));
  EXPECT_GT(rgb.r, 0.6);
  EXPECT_LT(rgb.g, 0.15);
  EXPECT_EQ(spectrum_of_colour({0.25}).at(600), 0.25);
  EXPECT_EQ(spectrum_of_colour({1, 1, 1}).at(600), 1);
}

TEST(Matte, ChequerboardHasTwoColours) {
  const Matte board(SmoothSpectrum(0.8), SmoothSpectrum(0.1), 0.5);
  EXPECT_EQ(board.albedo_at({0.2, 0.2, 0}).at(550), board.albedo_at({-0.2, -0.2, 0}).at(550));
  EXPECT_NE(board.albedo_at({0.2, 0.2, 0}).at(550), board.albedo_at({-0.2, 0.2, 0}).at(550));
}

}  // namespace arcus::render
