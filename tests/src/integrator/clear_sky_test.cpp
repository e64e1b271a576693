// The traced clear sky against tests/published/rayleigh_sky.csv: flat layers of molecules over black and over white ground, every radiance within 1 %
// and three standard errors. Minutes of work: labelled slow.

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <optional>

#include "media/air/air_walk.h"
#include "phase/base/curve.h"
#include "phase/species/species_cache.h"
#include "phase/base/units.h"
#include "tests/src/integrator/traced.h"

namespace arcus::render {
namespace {

/// As much air as makes the optical depth, over a planet so large that layers are flat.
media::Atmosphere flat_air(double optical_depth) {
  media::AirSettings settings;
  settings.planet_radius_m = 1e11;
  settings.ozone_dobson_units = 0;
  const auto depth = [&] { return media::Atmosphere::optical_depth(media::Atmosphere(settings).columns({{0, 0, 0}, {0, 0, 1}}), 550); };
  settings.pressure_hpa *= optical_depth / depth();
  EXPECT_NEAR(depth(), optical_depth, 1e-9);
  return media::Atmosphere(settings);
}

Scene scene_of(double optical_depth, double ground_albedo, double sun_cosine) {
  SurfaceParts parts;
  if (ground_albedo > 0) {
    parts.planes.push_back({0, 0});
    parts.materials.push_back(Material(Matte(ground_albedo)));
  }
  const SunSettings sun{.azimuth_deg = 0, .elevation_deg = degrees(std::asin(sun_cosine)), .spectrum = "equal_energy"};
  return Scene{.medium = std::make_unique<media::Medium>(std::vector<media::Component>{}),
               .sun = Sun(sun, sun_irradiance(sun, "")),
               .sky = Sky({}, Curve({550}, {1}, "")),
               .surfaces = Surfaces(std::move(parts)),
               .air = flat_air(optical_depth),
               .camera = nullptr};
}

media::Ray ray_of(bool looks_down, double view_cosine, double azimuth_deg, double top_m) {
  const double elevation_deg = degrees(std::asin(view_cosine));
  return {Vec3(0, 0, looks_down ? top_m : 1e-3), direction_of(azimuth_deg, looks_down ? -elevation_deg : elevation_deg)};
}

}  // namespace

TEST(ClearSky, RadiancesOfFlatLayersMeetTheReference) {
  const Columns table = read_columns_file(std::string(PUBLISHED_DIR) + "/rayleigh_sky.csv");
  Moments deviations;
  const std::size_t rows = table.columns[0].size();
  ASSERT_GT(rows, 150u);
  for (std::size_t i = 0; i < rows; ++i) {
    const auto column = [&](const char* name) { return table.named(name)[i]; };
    const double sun_cosine = column("sun_cosine"), view = column("view_cosine"), expected = column("radiance_per_sr");
    const bool looks_down = column("looks_down") > 0;
    if (!looks_down && view == sun_cosine && (view == 1 || column("azimuth_deg") == 0)) continue;  // straight into the sun
    const Scene scene = scene_of(column("optical_depth"), column("ground_albedo"), sun_cosine);
    const Moments found = traced(scene, ray_of(looks_down, view, column("azimuth_deg"), scene.air->settings().top_m), i, one_wavelength(550));
    deviations.add((found.mean() - expected) / found.standard_error());
    EXPECT_NEAR(found.mean(), expected, 0.01 * expected + 3 * found.standard_error())
        << "depth " << column("optical_depth") << " albedo " << column("ground_albedo") << " sun " << sun_cosine << (looks_down ? " down " : " up ") << view << " azimuth "
        << column("azimuth_deg") << ": " << found.mean() << " +- " << found.standard_error() << ", reference " << expected;
  }
  // All of them together say more than each.
  EXPECT_NEAR(deviations.mean(), 0, 0.3) << "in standard errors";
  std::cout << rows << " radiances; mean deviation " << deviations.mean() << " standard errors\n";
}

TEST(ClearSky, TracedAndTabulatedAgree) {
  const Wavelengths blue = one_wavelength(450), red = one_wavelength(620);
  const auto haze = std::make_shared<const media::Haze>("continental", phase::SpeciesOptions{.cache_folder = phase::default_cache_folder()});
  std::size_t number = 0;
  for (const double haze_depth : {0.0, 0.2})
    for (const double sun_deg : {60.0, 20.0, 5.0, 0.0}) {
      Scene scene = scene_of(0.1, 0, std::sin(radians(sun_deg)));
      media::AirSettings settings;
      settings.haze_depth_550 = haze_depth;
      scene.air.emplace(settings);
      if (haze_depth > 0) scene.haze = haze;
      scene.ground.emplace(Matte(0.2));
      const media::SkyTable table(*scene.air, scene.haze, {scene.sun.to_centre(), scene.sun.angular_radius_rad(), 0.2}, 100, 0);
      Moments errors;
      double worst = 0;
      for (const double elevation_deg : {1.0, 6.0, 25.0, 50.0, 88.0})
        for (const double azimuth_deg : {8.0, 70.0, 180.0}) {
          for (const Wavelengths& wavelengths : {blue, red}) {
            const media::Ray ray{{0, 0, 2}, direction_of(azimuth_deg, elevation_deg)};
            const double irradiance = scene.sun.irradiance_w_per_m2_nm(wavelengths).mean();
            const Moments found = traced(scene, ray, 100000 + number++, wavelengths);
            const double expected = table.radiance(ray.origin_m, ray.direction, wavelengths).mean() * irradiance;
            const double error = expected / found.mean() - 1;
            EXPECT_NEAR(expected, found.mean(), 0.03 * found.mean() + 3 * found.standard_error())
                << "haze " << haze_depth << " sun " << sun_deg << " elevation " << elevation_deg << " azimuth " << azimuth_deg << " at " << wavelengths[0] << " nm: table "
                << expected << ", traced " << found.mean() << " +- " << found.standard_error();
            errors.add(error);
            worst = std::max(worst, std::fabs(error));
          }
        }
      std::cout << "haze " << haze_depth << ", sun at " << sun_deg << " degrees: table over traced - 1: mean " << errors.mean() << ", at most " << worst << "\n";
      EXPECT_NEAR(errors.mean(), 0, 0.015);
    }
}

TEST(ClearSky, AnotherAmountOfAirWouldBeSeen) {
  Moments ratios;
  for (std::size_t i = 0; i < 20; ++i) {  // a twentieth more than the reference has
    const auto seen = [&](double depth, std::size_t number) { return traced(scene_of(depth, 0, 0.6), ray_of(false, 1, 0, 0), number, one_wavelength(550)).mean(); };
    ratios.add(seen(0.525, 2 * i) / seen(0.5, 2 * i + 1));
  }
  EXPECT_GT(ratios.mean() - 1, 3 * ratios.standard_error());
}

}  // namespace arcus::render
