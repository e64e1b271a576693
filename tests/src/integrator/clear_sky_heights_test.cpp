// The clear sky seen from within the haze, from above it and from space: by the table and traced, by an integral of light that was scattered once that
// shares nothing with the renderer but cross sections and phase functions, and along one ray from one place to the next.

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <optional>

#include "media/air/air_walk.h"
#include "phase/base/frame.h"
#include "phase/base/units.h"
#include "phase/optics/air.h"
#include "phase/species/species_cache.h"
#include "src/scene/build_scene.h"
#include "tests/src/integrator/traced.h"

namespace arcus::render {
namespace {

constexpr double planet_m = 6371000;

SceneSettings hazy_sky(double height_m, double sun_elevation_deg, const std::string& method) {
  SceneSettings scene;
  scene.path = "test.toml";
  scene.camera.position_m = Vec3(0, 0, height_m);
  scene.sun = {.azimuth_deg = 0, .elevation_deg = sun_elevation_deg, .spectrum = "equal_energy"};
  scene.sky.type = "clear";
  scene.sky.method = method;
  scene.sky.haze = {.type = "continental", .optical_depth = 0.2};
  scene.sky.ground_albedo = 0.2;
  return scene;
}

Scene built(const SceneSettings& settings) { return build_scene(settings, {.cache_folder = phase::default_cache_folder()}); }

/// Of the sea's horizon.
double horizon_deg(double height_m) { return -degrees(std::acos(planet_m / (planet_m + height_m))); }

/// Elevation of a ray from a height that comes as low as another.
double limb_deg(double height_m, double lowest_m) { return -degrees(std::acos((planet_m + lowest_m) / (planet_m + height_m))); }

/// Where one looks from a height: up, level, past the edge of the planet, at its edge and down.
std::vector<double> elevations_deg(double height_m) {
  std::vector<double> result{60, 5, horizon_deg(height_m) - 1, 0.5 * (horizon_deg(height_m) - 90), -88};
  if (height_m > 2000) result.insert(result.end(), {horizon_deg(height_m) + 0.3, 0.5 * horizon_deg(height_m)});
  for (const double lowest_m : {8000.0, 25000.0})
    if (height_m > 1.5 * lowest_m) result.push_back(limb_deg(height_m, lowest_m));
  return result;
}

/// Air without the planet's ground, and a sun so small that drawn directions never meet it.
Scene traced_air(double sun_elevation_deg, double haze_depth) {
  SceneSettings settings = hazy_sky(2, sun_elevation_deg, "traced");
  settings.sun.angular_radius_deg = 0.001;
  settings.sky.haze.optical_depth = haze_depth;
  settings.sky.ground_albedo = 0;
  return built(settings);
}

double height_of(const Vec3& place_m) {
  const long double x = place_m.x, y = place_m.y, z = static_cast<long double>(place_m.z) + planet_m;
  return static_cast<double>(std::sqrt(x * x + y * y + z * z) - planet_m);
}

/// Where a ray meets the sphere of a height above the planet: both distances; nothing where it passes.
std::optional<std::pair<double, double>> sphere(const media::Ray& ray, double height_m) {
  const long double x = ray.origin_m.x, y = ray.origin_m.y, z = static_cast<long double>(ray.origin_m.z) + planet_m, r = planet_m + height_m;
  const long double along = x * ray.direction.x + y * ray.direction.y + z * ray.direction.z, rest = along * along - (x * x + y * y + z * z - r * r);
  if (rest < 0) return std::nullopt;
  return std::pair{static_cast<double>(-along - std::sqrt(rest)), static_cast<double>(-along + std::sqrt(rest))};
}

/// Light scattered once, by a sum over even steps along the view and, from each, along the way to the sun. Densities, heights, phase function of molecules: as the
/// documentation says, written anew.
class ScatteredOnce {
 public:
  ScatteredOnce(double haze_depth, double nm) : haze_depth_(haze_depth), haze_("continental", {.cache_folder = phase::default_cache_folder()}), wavelengths_(one_wavelength(nm)) {
    for (int mode = 0; mode < haze_.mode_count(); ++mode) haze_ratio_ += static_cast<double>(haze_.extinction_ratio(mode, wavelengths_)[0]);
    scattering_m2_ = phase::air_scattering_cross_section_m2(nm);
    ozone_m2_ = phase::ozone_absorption_cross_section_m2(nm);
  }

  double radiance(const media::Ray& ray, const Sun& sun, int steps) const {
    const auto top = sphere(ray, 120000), ground = sphere(ray, 0);
    if (!top || top->second < 0) return 0;
    const double begin = std::max(0.0, top->first), end = ground && ground->first > 0 ? ground->first : top->second, step = (end - begin) / steps;
    const Vec3 to_sun = sun.to_centre();
    // Rayleigh's phase function with the depolarisation 0.0279 (Chandrasekhar, as Bodhaine and others have it).
    const double cosine = dot(ray.direction, to_sun), gamma = 0.0279 / (2 - 0.0279);
    const double by_molecules = 3 / (16 * pi * (1 + 2 * gamma)) * (1 + 3 * gamma + (1 - gamma) * cosine * cosine);
    double by_haze = 0;
    for (int mode = 0; mode < haze_.mode_count(); ++mode)
      by_haze += static_cast<double>(haze_.extinction_ratio(mode, wavelengths_)[0] * haze_.albedo(mode, wavelengths_)[0] *
                                     haze_.phase_function(mode).value(ray.direction, to_sun, wavelengths_)[0]);
    double depth = 0, sum = 0;
    for (int i = 0; i < steps; ++i) {
      const Vec3 place = ray.at(begin + (i + 0.5) * step);
      const Densities here = densities(height_of(place));
      depth += 0.5 * step * extinction(here);
      if (const auto behind = sphere({place, to_sun}, 0); !behind || behind->second < 0)
        sum += step * (here.molecules * scattering_m2_ * by_molecules + here.haze * by_haze) * std::exp(-depth - depth_to({place, to_sun}, steps / 2));
      depth += 0.5 * step * extinction(here);
    }
    return sum * static_cast<double>(sun.irradiance_w_per_m2_nm(wavelengths_)[0]);
  }

 private:
  struct Densities {
    double molecules, ozone, haze;
  };
  Densities densities(double h) const {
    const double ozone_peak = 300 * 2.6868e20 / 15000;
    const double ozone = h < 10000 || h > 40000 ? 0 : h < 25000 ? (h - 10000) / 15000 : (40000 - h) / 15000;
    return {phase::air_molecules_per_m3_at_sea_level * std::exp(-h / 8434.5), ozone_peak * ozone, haze_depth_ / 1200 * std::exp(-h / 1200)};
  }
  double extinction(const Densities& d) const { return d.molecules * scattering_m2_ + d.ozone * ozone_m2_ + d.haze * haze_ratio_; }
  double depth_to(const media::Ray& ray, int steps) const {
    const double end = sphere(ray, 120000)->second, step = end / steps;
    double depth = 0;
    for (int i = 0; i < steps; ++i) depth += step * extinction(densities(height_of(ray.at((i + 0.5) * step))));
    return depth;
  }

  double haze_depth_, haze_ratio_ = 0, scattering_m2_, ozone_m2_;
  media::Haze haze_;
  Wavelengths wavelengths_;
};

/// What air scatters into a ray on its first `length_m`, with all that was scattered before: places and directions drawn here.
Moments scattered_between(const Scene& scene, const media::Ray& ray, double length_m, double nm, int samples, std::size_t number) {
  const VolumePath integrator(scene, 1000000);
  const Wavelengths wavelengths = one_wavelength(nm);
  const media::AirOptics optics(wavelengths, scene.haze.get());
  const double irradiance = static_cast<double>(scene.sun.irradiance_w_per_m2_nm(wavelengths)[0]);
  const Vec3 to_sun = scene.sun.to_centre();
  const auto depth_of = [&](const media::Ray& way) { return static_cast<double>(optics.optical_depth(scene.air->columns(way))[0]); };
  std::vector<double> means(64);
  samples = static_cast<int>(samples * statistics::test_effort());
  tbb::parallel_for(std::size_t{0}, means.size(), [&](std::size_t batch) {
    double sum = 0;
    for (int i = 0; i < samples; ++i) {
      Random random(statistics::test_seed(1), number * means.size() + batch, static_cast<std::uint32_t>(i));
      const double at_m = length_m * (i + random.uniform_double()) / samples;
      const Vec3 place = ray.at(at_m);
      const media::AirColumns here = scene.air->density(height_of(place));
      // One of what scatters there, all with the same chance.
      const int kinds = 1 + scene.haze->mode_count(), kind = std::min(kinds - 1, static_cast<int>(kinds * random.uniform_double()));
      const double scattering = kind == 0 ? here.molecules_per_m2 * optics.scattering_m2[0]
                                          : here.haze_depth_550 * static_cast<double>(scene.haze->extinction_ratio(kind - 1, wavelengths)[0] * scene.haze->albedo(kind - 1, wavelengths)[0]);
      const phase::PhaseFunction function = kind == 0 ? phase::PhaseFunction(phase::Rayleigh()) : scene.haze->phase_function(kind - 1);
      const phase::Draw draw = function.draw(ray.direction, wavelengths, random);
      const FirstNumbers first{0.5, 0.5, 0.5, random.uniform_double(), random.uniform_double()};
      double light = static_cast<double>(integrator.radiance({place, draw.outgoing}, wavelengths, first, random)[0] * draw.value_per_sr[0] / draw.density_per_sr[0]);
      const media::Ray sunwards{place, to_sun};
      if (std::isinf(scene.air->distance_to_sea_level_m(sunwards)))
        light += static_cast<double>(function.value(ray.direction, to_sun, wavelengths)[0]) * irradiance * std::exp(-depth_of(sunwards));
      media::Ray way = ray;
      way.farthest_m = at_m;
      sum += kinds * scattering * std::exp(-depth_of(way)) * light * length_m;
    }
    means[batch] = sum / samples;
  });
  Moments moments;
  for (const double mean : means) moments.add(mean);
  return moments;
}

}  // namespace

TEST(ClearSkyHeights, LightScatteredOnceIsThatOfAPlainSum) {
  constexpr double haze_depth = 0.05;
  struct View {
    double height_m, elevation_deg;
  };
  std::vector<View> views;
  for (const double height_m : {2.0, 900.0, 12000.0, 400000.0, 1000000.0})
    for (const double elevation_deg : elevations_deg(height_m)) views.push_back({height_m, elevation_deg});
  Moments deviations;
  std::size_t number = 0;
  double worst = 0;
  int blacks = 0;
  for (const double sun_deg : {40.0, 6.0}) {
    const Scene scene = traced_air(sun_deg, haze_depth);
    for (const double nm : {450.0, 650.0}) {
      const ScatteredOnce plain(haze_depth, nm);
      std::vector<double> expected(views.size());
      const auto ray_of = [&](const View& view) { return media::Ray{{0, 0, view.height_m}, direction_of(75, view.elevation_deg)}; };
      tbb::parallel_for(std::size_t{0}, views.size(), [&](std::size_t i) { expected[i] = plain.radiance(ray_of(views[i]), scene.sun, 2000); });
      for (std::size_t i = 0; i < views.size(); ++i) {
        const Moments found = traced(scene, ray_of(views[i]), ++number, one_wavelength(nm), 120, 1);
        if (expected[i] == 0) {  // up from space
          EXPECT_EQ(found.mean(), 0);
          ++blacks;
          continue;
        }
        EXPECT_NEAR(found.mean(), expected[i], 0.005 * expected[i] + 3.5 * found.standard_error())
            << views[i].height_m << " m, elevation " << views[i].elevation_deg << ", sun " << sun_deg << ", " << nm << " nm: " << found.mean() << " +- " << found.standard_error() << ", plain sum " << expected[i];
        EXPECT_LT(found.standard_error(), 0.02 * expected[i]);
        deviations.add((found.mean() - expected[i]) / found.standard_error());
        worst = std::max(worst, std::fabs(found.mean() / expected[i] - 1));
      }
    }
  }
  EXPECT_GT(blacks, 0);
  EXPECT_NEAR(deviations.mean(), 0, 0.5) << "in standard errors";
  std::cout << deviations.count() << " radiances within " << 100 * worst << " %, in the mean " << deviations.mean() << " standard errors off\n";
}

TEST(ClearSkyHeights, WhatArrivesIsWhatArrivesFartherOnAndWhatTheAirAdds) {
  struct Part {
    double height_m, elevation_deg, length_m;
  };
  const Scene scene = traced_air(12, 0.3);
  std::size_t number = 0;
  constexpr int samples = 600;
  Moments deviations;
  // Out of the haze, within it, along it, down into it, through the edge of the planet seen from space.
  for (const Part& part : {Part{2, 8, 12000}, Part{300, 1, 8000}, Part{5000, -10, 25000}, Part{12000, -40, 15000}, Part{400000, limb_deg(400000, 12000), 2230000}})
    for (const double nm : {450.0, 620.0}) {
      const media::Ray here{{0, 0, part.height_m}, direction_of(60, part.elevation_deg)}, there{here.at(part.length_m), here.direction};
      ASSERT_GT(height_of(there.origin_m), 0);
      media::Ray between = here;
      between.farthest_m = part.length_m;
      const double through = std::exp(-static_cast<double>(media::AirOptics(one_wavelength(nm), scene.haze.get()).optical_depth(scene.air->columns(between))[0]));
      const Moments seen = traced(scene, here, ++number, one_wavelength(nm), samples), beyond = traced(scene, there, ++number, one_wavelength(nm), samples / 2),
                    added = scattered_between(scene, here, part.length_m, nm, samples, ++number);
      const double composed = through * beyond.mean() + added.mean();
      const double error = std::sqrt(seen.variance_of_mean() + through * through * beyond.variance_of_mean() + added.variance_of_mean());
      std::cout << part.height_m << " m, " << part.elevation_deg << ", " << nm << " nm: seen " << seen.mean() << ", composed " << composed << " +- " << error << ", beyond " << through * beyond.mean() << std::endl;
      EXPECT_NEAR(seen.mean(), composed, 3.5 * error) << part.height_m << " m, elevation " << part.elevation_deg << ", " << nm << " nm";
      EXPECT_LT(error, 0.03 * composed);
      EXPECT_GT(added.mean(), 0.1 * composed);
      deviations.add((seen.mean() - composed) / error);
    }
  EXPECT_NEAR(deviations.mean(), 0, 1) << "in standard errors";
}

TEST(ClearSkyHeights, VacuumChangesNothing) {
  const Scene scene = traced_air(30, 0.2);
  const double top_m = scene.air->settings().top_m;
  int number = 0;
  for (const double lowest_m : {-3000000.0, -50000.0, 5000.0, 30000.0, 90000.0}) {
    // The same line from 1,000, 400 and 200 km, and from a metre above the air.
    const media::Ray far_away{{0, 0, 1000000}, direction_of(200, limb_deg(1000000, lowest_m))};
    const double reference = traced(scene, far_away, 1, one_wavelength(500), 30).mean();
    ASSERT_GT(reference, 0);
    for (const double height_m : {400000.0, 200000.0, top_m + 1, top_m - 0.5}) {
      media::Ray nearer = far_away;
      nearer.origin_m = far_away.at(sphere(far_away, height_m)->first);
      // With the same random numbers it is the same, sample by sample, but for a few that rounding sends elsewhere.
      EXPECT_NEAR(traced(scene, nearer, 1, one_wavelength(500), 30).mean() / reference, 1, 2e-3) << lowest_m << ' ' << height_m;
      ++number;
    }
  }
  EXPECT_EQ(number, 20);
}

TEST(ClearSkyHeights, TracedAndTabulatedAgree) {
  std::size_t number = 0;
  Moments errors;
  double worst = 0;
  for (const double height_m : {2.0, 500.0, 3000.0, 19500.0})
    for (const double sun_deg : {50.0, 10.0}) {
      const Scene tabulated = built(hazy_sky(height_m, sun_deg, "table")), all_traced = built(hazy_sky(height_m, sun_deg, "traced"));
      ASSERT_TRUE(tabulated.sky_table && !all_traced.sky_table);
      for (const double elevation_deg : elevations_deg(height_m)) {
        const Wavelengths wavelengths = one_wavelength(number % 2 == 0 ? 450 : 620);
        const double azimuth_deg = number % 4 < 2 ? 40 : 170;
        const media::Ray ray{{0, 0, height_m}, direction_of(azimuth_deg, elevation_deg)};
        const Moments expected = traced(all_traced, ray, ++number, wavelengths, 80);
        const double found = static_cast<double>((tabulated.sky_table->radiance(ray.origin_m, ray.direction, wavelengths) * tabulated.sun.irradiance_w_per_m2_nm(wavelengths))[0]);
        EXPECT_NEAR(found, expected.mean(), 0.03 * expected.mean() + 3 * expected.standard_error())
            << height_m << " m, sun " << sun_deg << ", elevation " << elevation_deg << ", azimuth " << azimuth_deg << ", " << wavelengths[0] << " nm: table " << found << ", traced " << expected.mean() << " +- "
            << expected.standard_error();
        EXPECT_LT(expected.standard_error(), 0.06 * expected.mean());
        errors.add(found / expected.mean() - 1);
        worst = std::max(worst, std::fabs(found / expected.mean() - 1));
      }
    }
  EXPECT_NEAR(errors.mean(), 0, 0.01);
  std::cout << errors.count() << " radiances: table over traced - 1: mean " << errors.mean() << ", at most " << worst << "\n";
}

/// From a man's height, a hundred metres away: the haze in between glows near the sun.
TEST(ClearSkyHeights, GroundNearByIsSeenThroughWhatLiesBetween) {
  const Scene tabulated = built(hazy_sky(2, 10, "table")), all_traced = built(hazy_sky(2, 10, "traced"));
  const media::Ray ray{{0, 0, 2}, direction_of(30, -1.05)};
  const Wavelengths wavelengths = one_wavelength(450);
  const Moments expected = traced(all_traced, ray, 1, wavelengths, 1200);
  const double found = static_cast<double>((tabulated.sky_table->radiance(ray.origin_m, ray.direction, wavelengths) * tabulated.sun.irradiance_w_per_m2_nm(wavelengths))[0]);
  EXPECT_LT(expected.standard_error(), 0.01 * expected.mean());
  EXPECT_NEAR(found, expected.mean(), 0.03 * expected.mean() + 3 * expected.standard_error());
  std::cout << "table over traced - 1: " << found / expected.mean() - 1 << " +- " << expected.standard_error() / expected.mean() << "\n";
}

TEST(ClearSkyHeights, FromSpaceAllAirIsTraced) {
  for (const double height_m : {25000.0, 400000.0}) {
    const SceneSettings settings = hazy_sky(height_m, 30, "table");
    std::string said;
    const Scene scene = build_scene(settings, {.cache_folder = phase::default_cache_folder(), .log = [&](std::string_view text) { said += text; }}), other = built(hazy_sky(height_m, 30, "traced"));
    EXPECT_NE(said.find("all air is traced"), std::string::npos) << said;
    EXPECT_FALSE(scene.sky_table);
    for (const double elevation_deg : elevations_deg(height_m)) {
      const media::Ray ray{{0, 0, height_m}, direction_of(30, elevation_deg)};
      EXPECT_EQ(traced(scene, ray, 1, one_wavelength(500), 5).mean(), traced(other, ray, 1, one_wavelength(500), 5).mean());
    }
  }
}

}  // namespace arcus::render
