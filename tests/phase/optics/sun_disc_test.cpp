#include "phase/optics/sun_disc.h"

#include <gtest/gtest.h>

#include <cmath>

#include "phase/base/quadrature.h"
#include "phase/base/units.h"

namespace arcus::phase {

namespace {

double mean_over_disc(const DiscProfile& disc, double wavelength_nm) {
  return integrate(
      [&](double rho) { return 2 * rho * disc.relative_radiance(rho, wavelength_nm); }, 0, 1, 1e-9);
}

}  // namespace

TEST(DiscProfile, HasMeanOneOverTheDisc) {
  const DiscProfile disc(radians(mean_sun_radius_deg));
  for (const double nm : {200.0, 365.875, 400.0, 559.95, 601.3, 780.0, 1500.0})
    EXPECT_NEAR(mean_over_disc(disc, nm), 1, 1e-6) << nm << " nm";
}

// The published mean over centre intensity, a column that the profile does not read.
TEST(DiscProfile, HasThePublishedCentreAtTheTablesWavelengths) {
  const DiscProfile disc(radians(mean_sun_radius_deg));
  EXPECT_NEAR(1 / disc.relative_radiance(0, 401.97), 0.7303, 1e-4);
  EXPECT_NEAR(1 / disc.relative_radiance(0, 519.93), 0.7925, 1e-4);
  EXPECT_NEAR(1 / disc.relative_radiance(0, 700.875), 0.8434, 1e-4);
}

TEST(DiscProfile, DarkensTowardsTheEdgeAsThePolynomialSays) {
  const DiscProfile disc(radians(mean_sun_radius_deg));
  // Row 559.95 nm at mu = 0.5: Σ a_k / 2^k.
  const double at_half =
      0.26892 + 1.34319 / 2 - 1.58427 / 4 + 1.91271 / 8 - 1.31350 / 16 + 0.37295 / 32;
  const double rho = std::sqrt(0.75);
  EXPECT_NEAR(disc.relative_radiance(rho, 559.95) / disc.relative_radiance(0, 559.95), at_half, 1e-5);
  EXPECT_NEAR(disc.relative_radiance(1, 559.95) / disc.relative_radiance(0, 559.95), 0.26892, 1e-5);
  EXPECT_LT(disc.relative_radiance(1, 400), disc.relative_radiance(1, 700));  // redder at the edge
}

TEST(DiscProfile, IsDarkBeyondTheEdge) {
  EXPECT_EQ(DiscProfile(radians(mean_sun_radius_deg)).relative_radiance(1.0001, 550), 0);
}

TEST(DiscProfile, InterpolatesBetweenWavelengths) {
  const DiscProfile disc(radians(mean_sun_radius_deg));
  const double a = disc.relative_radiance(0.9, 519.93), b = disc.relative_radiance(0.9, 541.76);
  EXPECT_NEAR(disc.relative_radiance(0.9, 0.5 * (519.93 + 541.76)), 0.5 * (a + b), 1e-12);
}

TEST(DiscProfile, OfTheMoonIsUniform) {
  const DiscProfile moon(radians(mean_moon_radius_deg), DiscKind::uniform);
  for (const double rho : {0.0, 0.5, 0.999})
    for (const double nm : {400.0, 700.0}) EXPECT_EQ(moon.relative_radiance(rho, nm), 1);
  EXPECT_EQ(moon.relative_radiance(1.001, 550), 0);
  EXPECT_NEAR(mean_over_disc(moon, 550), 1, 1e-9);
  EXPECT_NEAR(moon.solid_angle_sr(), 6.4177e-5, 3e-8) << "Kieffer and Stone (2005)";
}

TEST(DiscProfile, HasTheSunsSolidAngle) {
  EXPECT_NEAR(DiscProfile(radians(mean_sun_radius_deg)).solid_angle_sr(), 6.80e-5, 1e-7);
}

}  // namespace arcus::phase
