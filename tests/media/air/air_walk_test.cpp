#include "media/air/air_walk.h"

#include <gtest/gtest.h>

#include <cmath>

#include "phase/base/units.h"

namespace arcus::media {
namespace {

Wavelengths visible() {
  Wavelengths wavelengths;
  wavelengths.nm = {400, 500, 600, 700};
  return wavelengths;
}

TEST(AirWalk, OpticalDepthIsThatOfEachWavelength) {
  const Wavelengths wavelengths = visible();
  const AirOptics optics(wavelengths);
  const Atmosphere air({});
  const AirColumns columns = air.columns({{0, 0, 0}, {0, 0.6, 0.8}});
  for (int j = 0; j < wavelength_count; ++j)
    EXPECT_NEAR(optics.optical_depth(columns)[j] / Atmosphere::optical_depth(columns, wavelengths[j]), 1, 1e-6);
  EXPECT_LT(optics.molecular_scattering(columns)[2], optics.optical_depth(columns)[2]) << "ozone absorbs";
}

TEST(AirWalk, CollidesWhereTheDepthIsReached) {
  const AirOptics optics(visible());
  const Atmosphere air({});
  for (const double elevation_deg : {90.0, 20.0, 1.0, -5.0})
    for (const double height_m : {0.0, 9000.0, 300000.0}) {
      const double e = radians(height_m > 100000 ? -elevation_deg : elevation_deg);
      Ray ray{{0, 0, height_m}, {std::cos(e), 0, std::sin(e)}};
      ray.farthest_m = std::min(ray.farthest_m, air.distance_to_sea_level_m(ray));
      const double whole = optics.optical_depth(air.columns(ray))[0];
      if (whole == 0) continue;
      for (const double part : {1e-4, 0.1, 0.5, 0.999}) {
        const auto found = air_collision_at(air, ray, optics, part * whole);
        ASSERT_TRUE(found) << elevation_deg << " " << height_m << " " << part;
        EXPECT_NEAR(found->optical_depth[0] / (part * whole), 1, 1e-5);
        Ray until = ray;
        until.farthest_m = found->distance_m;
        EXPECT_NEAR(optics.optical_depth(air.columns(until))[0] / (part * whole), 1, 1e-5) << elevation_deg << " " << height_m << " " << part;
        EXPECT_NEAR(optics.optical_depth(found->density)[1] / optics.optical_depth(air.density(air.height_m(ray.at(found->distance_m))))[1], 1, 1e-6);
      }
      EXPECT_FALSE(air_collision_at(air, ray, optics, 1.001 * whole));
    }
}

TEST(AirWalk, TheFirstWavelengthChangesPlaces) {
  const AirOptics optics(visible()), other = optics.with_first(2);
  EXPECT_EQ(other.scattering_m2[0], optics.scattering_m2[2]);
  EXPECT_EQ(other.scattering_m2[2], optics.scattering_m2[0]);
  EXPECT_EQ(other.ozone_m2[1], optics.ozone_m2[1]);
}

}  // namespace
}  // namespace arcus::media
