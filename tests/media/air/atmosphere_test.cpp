#include "media/air/atmosphere.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "phase/base/quadrature.h"
#include "phase/base/units.h"
#include "phase/optics/air.h"

namespace arcus::media {
namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

AirSettings hazy() {
  AirSettings settings;
  settings.haze_depth_550 = 0.2;
  return settings;
}

Ray at_elevation(double elevation_deg, double height_m, double farthest_m = endless) {
  const double e = elevation_deg * pi / 180;
  return {{0, 0, height_m}, {0, std::cos(e), std::sin(e)}, 0, farthest_m};
}

/// Without any care for digits but long ones.
double height_by_long_numbers(const Ray& ray, double s, double radius_m) {
  const long double y = ray.origin_m.y + static_cast<long double>(s) * ray.direction.y, x = ray.origin_m.x + static_cast<long double>(s) * ray.direction.x;
  const long double z = ray.origin_m.z + static_cast<long double>(s) * ray.direction.z + radius_m;
  return static_cast<double>(std::sqrt(x * x + y * y + z * z) - radius_m);
}

/// Another quadrature: adaptive, of the density at each point, cut only where ozone has its corners.
AirColumns columns_by_halving(const Atmosphere& air, const Ray& ray, double length_m) {
  const double radius_m = air.settings().planet_radius_m;
  const auto integral = [&](auto member, double tolerance) {
    double sum = 0;
    const int parts = 400;
    for (int i = 0; i < parts; ++i)
      sum += integrate([&](double s) { return air.density(height_by_long_numbers(ray, s, radius_m)).*member; }, length_m * i / parts, length_m * (i + 1) / parts,
                       tolerance / parts);
    return sum;
  };
  return {integral(&AirColumns::molecules_per_m2, 1e21), integral(&AirColumns::ozone_per_m2, 1e15), integral(&AirColumns::haze_depth_550, 1e-9)};
}

/// To where the top of the air is.
double length_to_top(const Atmosphere& air, const Ray& ray) {
  double low = 0, high = 3e6;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (height_by_long_numbers(ray, middle, air.settings().planet_radius_m) < air.settings().top_m ? low : high) = middle;
  }
  return low;
}

TEST(Atmosphere, ColumnsStraightUpAreClosedForms) {
  const AirSettings settings = hazy();
  const AirColumns up = Atmosphere(settings).columns(at_elevation(90, 0));
  const double molecules = phase::air_molecules_per_m3_at_sea_level * settings.molecule_scale_height_m * -std::expm1(-settings.top_m / settings.molecule_scale_height_m);
  EXPECT_NEAR(up.molecules_per_m2 / molecules, 1, 1e-7);
  EXPECT_NEAR(up.ozone_per_m2 / (300 * phase::molecules_per_m2_in_dobson_unit), 1, 1e-9);
  EXPECT_NEAR(up.haze_depth_550 / 0.2, 1, 1e-7);
}

// The weight of the air: 1013.25 hPa over the mean mass of a molecule (28.9644 u) and gravity, 9.80665 m/s2.
TEST(Atmosphere, TheColumnOfAirHasItsWeight) {
  const double molecules = Atmosphere({}).columns(at_elevation(90, 0)).molecules_per_m2;
  EXPECT_NEAR(molecules * 28.9644 * 1.66053907e-27 * 9.80665 / 101325, 1, 2e-3);
}

// Hansen and Travis, Space Science Reviews 16, 527, 1974: optical depth 0.0973 at 550 nm, from 0.008569 λ⁻⁴ (1 + 0.0113 λ⁻² + 0.00013 λ⁻⁴), λ in µm.
TEST(Atmosphere, OpticalDepthOfMoleculesIsThatOfTheLiterature) {
  AirSettings settings;
  settings.ozone_dobson_units = 0;
  const AirColumns up = Atmosphere(settings).columns(at_elevation(90, 0));
  for (const double nm : {400.0, 550.0, 700.0}) {
    const double s = 1e6 / (nm * nm);
    EXPECT_NEAR(Atmosphere::optical_depth(up, nm) / (0.008569 * s * s * (1 + 0.0113 * s + 0.00013 * s * s)), 1, 0.01) << nm;
  }
}

TEST(Atmosphere, SunlightIsDimmedAsAnotherQuadratureSays) {
  const Atmosphere air(hazy());
  for (const double height : {0.0, 1.7, 3000.0})
    for (const double elevation : {90.0, 30.0, 10.0, 5.0, 2.0, 0.0}) {
      const Ray ray = at_elevation(elevation, height);
      const AirColumns found = air.columns(ray), expected = columns_by_halving(air, ray, length_to_top(air, ray));
      EXPECT_NEAR(found.molecules_per_m2 / expected.molecules_per_m2, 1, 1e-6) << elevation << "° at " << height << " m";
      EXPECT_NEAR(found.ozone_per_m2 / expected.ozone_per_m2, 1, 1e-6) << elevation << "° at " << height << " m";
      EXPECT_NEAR(found.haze_depth_550 / expected.haze_depth_550, 1, 1e-6) << elevation << "° at " << height << " m";
      for (double nm = 380; nm <= 780; nm += 50) {
        const double transmittance = std::exp(-Atmosphere::optical_depth(found, nm)), exact = std::exp(-Atmosphere::optical_depth(expected, nm));
        EXPECT_NEAR(transmittance / exact, 1, 1e-3) << elevation << "°, " << nm << " nm";
      }
    }
}

// F. Kasten and A. T. Young, Applied Optics 28, 4735, 1989, who count refraction, which hardly matters from 10° on.
TEST(Atmosphere, AirMassIsThatOfKastenAndYoung) {
  AirSettings settings;
  const Atmosphere air(settings);
  const double up = air.columns(at_elevation(90, 0)).molecules_per_m2;
  for (const double elevation : {60.0, 30.0, 10.0}) {
    const double expected = 1 / (std::sin(elevation * pi / 180) + 0.50572 * std::pow(elevation + 6.07995, -1.6364));
    EXPECT_NEAR(air.columns(at_elevation(elevation, 0)).molecules_per_m2 / up / expected, 1, 0.012) << elevation;
  }
}

TEST(Atmosphere, PartsAddUp) {
  const Atmosphere air(hazy());
  for (const double elevation : {40.0, 3.0, -1.0, -30.0}) {
    Ray whole = at_elevation(elevation, 9000, 15000), first = whole, second = whole;
    first.farthest_m = second.nearest_m = 5432;
    AirColumns sum = air.columns(first);
    sum += air.columns(second);
    const AirColumns all = air.columns(whole);
    EXPECT_NEAR(sum.molecules_per_m2 / all.molecules_per_m2, 1, 1e-9);
    EXPECT_NEAR(sum.haze_depth_550 / all.haze_depth_550, 1, 1e-7);
  }
}

TEST(Atmosphere, ShortStretchesAreWhatManyPointsSay) {
  AirSettings settings = hazy();
  for (const double haze_scale_height : {300.0, 1200.0}) {
    settings.haze_scale_height_m = haze_scale_height;
    const Atmosphere air(settings);
    for (const double elevation : {90.0, 20.0, 2.0, 0.0, -3.0, -60.0})
      for (const double length : {0.5, 30.0, 700.0, 19000.0}) {
        Ray stretch = at_elevation(elevation, 3000, 100 + length);
        stretch.nearest_m = 100;
        if (air.height_m(stretch.at(stretch.farthest_m)) < 0) continue;
        AirColumns sum;
        const int points = 20000;
        for (int i = 0; i < points; ++i) {
          const AirColumns here = air.density(air.height_m(stretch.at(100 + length * (i + 0.5) / points)));
          sum += {here.molecules_per_m2 * length / points, here.ozone_per_m2 * length / points, here.haze_depth_550 * length / points};
        }
        const AirColumns columns = air.columns(stretch);
        EXPECT_NEAR(columns.molecules_per_m2 / sum.molecules_per_m2, 1, 1e-6) << elevation << "°, " << length << " m";
        EXPECT_NEAR(columns.haze_depth_550 / sum.haze_depth_550, 1, 1e-6) << elevation << "°, " << length << " m";
        EXPECT_NEAR(columns.ozone_per_m2, sum.ozone_per_m2, 1e-6 * sum.ozone_per_m2);
      }
  }
}

TEST(Atmosphere, OnASmallPlanetItIsWhatManyPointsSay) {
  AirSettings settings = hazy();
  settings.planet_radius_m = 200000;
  const Atmosphere air(settings);
  for (const double elevation : {0.0, 5.0, 40.0}) {
    const Ray ray = at_elevation(elevation, 0, 400000);
    double sum = 0;
    constexpr int points = 400000;
    for (int i = 0; i < points; ++i) sum += air.density(air.height_m(ray.at(400000 * (i + 0.5) / points))).molecules_per_m2 * 400000 / points;
    EXPECT_NEAR(air.columns(ray).molecules_per_m2 / sum, 1, 1e-6) << elevation;
  }
}

TEST(Atmosphere, BelowSeaLevelTheDensityIsThatOfSeaLevel) {
  const Atmosphere air(hazy());
  Ray through = at_elevation(-90, 2000, 3000), above = through;
  above.farthest_m = 2000;
  EXPECT_NEAR(air.columns(through).molecules_per_m2, air.columns(above).molecules_per_m2 + 1000 * air.density(0).molecules_per_m2,
              1e-6 * air.columns(through).molecules_per_m2);
  EXPECT_NEAR(air.columns(at_elevation(10, -400, 100)).haze_depth_550, 100 * air.density(0).haze_depth_550, 1e-9);
}

TEST(Atmosphere, FromSpaceALineThatPassesByHasBothHalves) {
  const Atmosphere air({});
  const double radius = air.settings().planet_radius_m;
  const Ray limb{{-3e6, 0, 20000}, {1, 0, 0}};  // lowest, 20 km, above the origin
  const Ray half{{0, 0, 20000}, {1, 0, 0}};
  EXPECT_NEAR(air.columns(limb).molecules_per_m2 / (2 * air.columns(half).molecules_per_m2), 1, 1e-8);
  EXPECT_EQ(air.columns({{0, 0, 200000}, {0, 0, 1}}).molecules_per_m2, 0);
  EXPECT_NEAR(air.distance_to_sea_level_m({{0, 0, 400000}, {0, 0, -1}}), 400000, 1e-6);
  EXPECT_EQ(air.distance_to_sea_level_m(limb), endless);
  // The horizon, as far as geometry says.
  const double dip = std::acos(radius / (radius + 1000));
  EXPECT_EQ(air.distance_to_sea_level_m({{0, 0, 1000}, {std::cos(dip) , 0, -std::sin(dip) + 1e-9}}), endless);
  EXPECT_NEAR(air.distance_to_sea_level_m({{0, 0, 1000}, {std::cos(dip + 1e-6), 0, -std::sin(dip + 1e-6)}}), std::sqrt(1000 * (2 * radius + 1000)), 10000);
}

TEST(Atmosphere, HeightsAreExactFarFromTheOrigin) {
  const Atmosphere air({});
  for (const Vec3& place : {Vec3(0, 0, 1.7), Vec3(1e5, -2e4, 12.25), Vec3(-3e5, 1e5, -7000.125), Vec3(0, 0, 4e5)}) {
    const Ray ray{place, {0, 0, 1}};
    EXPECT_NEAR(air.height_m(place), height_by_long_numbers(ray, 0, air.settings().planet_radius_m), 1e-9 * std::fabs(place.z) + 1e-8);
  }
}

}  // namespace
}  // namespace arcus::media
