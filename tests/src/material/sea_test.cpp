#include "src/material/sea.h"

#include <gtest/gtest.h>

#include <cmath>

#include "phase/base/error.h"
#include "phase/optics/fresnel.h"
#include "src/integrator/make_integrator.h"
#include "src/integrator/path_tracer.h"
#include "src/integrator/volume_path.h"
#include "tests/statistics/moments.h"
#include "tests/statistics/seed.h"
#include "tests/statistics/students_t.h"

namespace arcus::render {
namespace {

using statistics::Moments;

const Wavelengths green{{550, 550, 550, 550}};
const Vec3 up(0, 0, 1);

ClearBody water(double n = 1.34) { return ClearBody(phase::RefractiveIndex::constant({.n = n}), 1, 1); }
/// Waves alone: no light from below, no foam.
Sea waves(const SlopeVariance& slopes, double n = 1.34) { return Sea(water(n), slopes, 270, 0, 0); }
Sea whole_sea(double wind) { return Sea(water(), cox_munk_slopes(wind, false), 250, 0.06, foam_cover(wind)); }

Vec3 towards(double zenith_deg, double azimuth_deg) { return direction_of(azimuth_deg, 90 - zenith_deg); }
double fresnel(double zenith_deg, double n = 1.34) { return phase::fresnel_reflectance(std::cos(radians(zenith_deg)), n).unpolarised(); }

/// Share of the light from a direction that is reflected: by reciprocity, of what is seen from there under an even sky.
Moments albedo(const Sea& sea, const Vec3& back, int count) {
  const SeaView view(sea, up, back, green);
  Random random(statistics::test_seed(), 0, 0);
  Moments moments;
  for (int i = 0; i < count; ++i) {
    const Vec3 away = view.draw(random);
    moments.add(away.z > 0 ? view.value_per_sr(away)[0] * away.z / view.density_per_sr(away) : 0);
  }
  return moments;
}

/// Cox and Munk's density of slopes for a wind from the west: along x and across it.
double cox_munk(double wind, double slope_x, double slope_y) {
  const double along = 0.00316 * wind, across = 0.003 + 0.00192 * wind;
  return std::exp(-0.5 * (slope_x * slope_x / along + slope_y * slope_y / across)) / (2 * pi * std::sqrt(along * across));
}

Scene scene_of(const Sea& sea, const SunSettings& sun, double sky_radiance, std::vector<media::Component> media = {}) {
  SurfaceParts parts;
  parts.planes.push_back({0, 0});
  parts.materials.push_back(Material(sea));
  return Scene{.medium = std::make_unique<media::Medium>(std::move(media)),
               .sun = Sun(sun, sun_irradiance(sun, "")),
               .sky = Sky({.type = "constant", .radiance = sky_radiance}, Curve({550}, {1}, "")),
               .surfaces = Surfaces(std::move(parts)),
               .camera = nullptr};
}

SunSettings sun_at(double elevation_deg, double radius_deg = 0.2666) {
  return {.azimuth_deg = 200, .elevation_deg = elevation_deg, .angular_radius_deg = radius_deg, .spectrum = "equal_energy"};
}

media::Ray looking(double down_deg, double azimuth_deg) { return {Vec3(0, 0, 10), direction_of(azimuth_deg, -down_deg)}; }

Moments traced(const Integrator& integrator, const media::Ray& ray, int count) {
  Moments moments;
  Work work;
  for (int i = 0; i < count; ++i) {
    Random random(statistics::test_seed(), 0, static_cast<std::uint32_t>(i));
    moments.add(integrator.radiance(ray, green, {0.5, 0.5, 0.5, random.uniform_double(), random.uniform_double()}, random, work)[0]);
  }
  return moments;
}

/// The same light by directions drawn evenly over the hemisphere, the sun met by chance.
Moments by_chance(const Scene& scene, const Sea& sea, const media::Ray& ray, int count) {
  const SeaView view(sea, up, -ray.direction, green);
  const SunLight light = scene.sun.light(green);
  Moments moments;
  Random random(statistics::test_seed(), 1, 0);
  for (int i = 0; i < count; ++i) {
    const Vec3 away = Matte::draw(up, random.uniform_double(), random.uniform_double());
    moments.add((view.value_per_sr(away) * (scene.sky.radiance(away, green) + scene.sun.radiance(away, light)))[0] * pi);
  }
  return moments;
}

}  // namespace

TEST(Sea, HasTheSlopesOfCoxAndMunkAndTheFoamOfMonahan) {
  const SlopeVariance wind = cox_munk_slopes(10, false), even = cox_munk_slopes(10, true);
  EXPECT_NEAR(wind.along, 0.0316, 1e-12);
  EXPECT_NEAR(wind.across, 0.0222, 1e-12);
  EXPECT_NEAR(even.along + even.across, 0.0542, 1e-12);
  EXPECT_NEAR(std::sqrt(even.along + even.across), std::tan(radians(13.1)), 0.001);
  EXPECT_NEAR(foam_cover(5), 0.00085, 2e-5);
  EXPECT_NEAR(foam_cover(15), 0.0407, 5e-4);
}

TEST(Sea, ReflectsAsMuchOneWayAsTheOther) {
  Random random(statistics::test_seed(), 2, 0);
  for (const double wind : {0.5, 5.0, 15.0}) {
    const Sea sea = whole_sea(wind);
    for (int i = 0; i < 100; ++i) {
      const Vec3 a = Matte::draw(up, random.uniform_double(), random.uniform_double());
      const Vec3 b = Matte::draw(up, random.uniform_double(), random.uniform_double());
      const double there = SeaView(sea, up, a, green).value_per_sr(b)[0], back = SeaView(sea, up, b, green).value_per_sr(a)[0];
      EXPECT_NEAR(there, back, 1e-5 * back + 1e-12);
    }
  }
}

TEST(Sea, CalmIsFresnelsMirror) {
  const Sea sea = waves({1e-6, 1e-6});
  for (const double zenith : {0.0, 30.0, 60.0, 75.0, 85.0}) {
    const Moments found = albedo(sea, towards(zenith, 30), 20000);
    EXPECT_NEAR(found.mean() / fresnel(zenith), 1, 0.004) << zenith;
  }
}

TEST(Sea, OnlyLightFromBelowIsWhatTheSmoothSurfaceLetsThroughTwice) {
  // Waves hardly matter to it; with all that the water can send back, R = 1 would give exactly 1 - Fresnel. For R: R (1 - F)(1 - Fmean) / (n2 (1 - R
  // Finside)).
  const double n = 1.34, down = 0.0667, inner = 1 - (1 - down) / (n * n), r = 0.3;
  const Sea clear = waves({1e-6, 1e-6}), milky(water(), {1e-6, 1e-6}, 270, r, 0);
  for (const double zenith : {0.0, 60.0}) {
    const double more = albedo(milky, towards(zenith, 0), 400000).mean() - albedo(clear, towards(zenith, 0), 400000).mean();
    const double expected = r * (1 - fresnel(zenith)) * (1 - down) / (n * n * (1 - r * inner));
    EXPECT_NEAR(more / expected, 1, 0.02) << zenith;
  }
}

TEST(Sea, NeverReflectsMoreThanItGets) {
  for (const double wind : {0.0, 5.0, 15.0, 30.0}) {
    const Sea sea(water(), cox_munk_slopes(wind, false), 250, 0.5, foam_cover(wind));
    for (const double zenith : {0.0, 40.0, 70.0, 80.0, 85.0, 89.0, 89.9})
      for (const double azimuth : {250.0, 340.0}) {
        const Moments found = albedo(sea, towards(zenith, azimuth), 20000);
        EXPECT_LT(found.mean() - 4 * found.standard_error(), 1) << wind << " " << zenith;
      }
  }
}

TEST(Sea, AlbedoFollowsJinAndOthers) {
  // Z. Jin, Y. Qiao, Y. Wang, Y. Fang and W. Yi, "A new parameterization of spectral and broadband ocean surface albedo", Optics Express 19, 26429
  // (2011), equations 1 and 4: fits to ray tracing with reflections between waves, for the same slopes.
  const auto jin = [](double cosine, double wind) {
    const double m = cosine, s = std::sqrt(0.003 + 0.00512 * wind);
    const double f = (0.0152 - 1.7873 * m + 6.8972 * m * m - 8.5778 * m * m * m + 4.071 * s - 7.6446 * m * s) *
                     std::exp(0.1643 - 7.8409 * m - 3.5639 * m * m - 2.3588 * s + 10.0538 * m * s);
    return phase::fresnel_reflectance(m, 1.34).unpolarised() - f;
  };
  for (const double wind : {3.0, 10.0})
    for (const double zenith : {0.0, 30.0, 50.0, 60.0, 70.0, 75.0}) {
      const double found = albedo(waves(cox_munk_slopes(wind, true)), towards(zenith, 0), 40000).mean();
      const double theirs = jin(std::cos(radians(zenith)), wind);
      // Beyond 60 degrees light that waves reflect into one another is missed (docs/sea.md).
      EXPECT_LT(found, 1.02 * theirs) << wind << " " << zenith;
      EXPECT_GT(found, (zenith < 60 ? 0.97 : zenith < 70 ? 0.9 : 0.77) * theirs) << wind << " " << zenith;
    }
}

TEST(Sea, ReflectsOnceWhatARandomWalkOverItsWavesDoes) {
  // tests/published/sea_walk.py, 1 % of statistical error: the light that leaves after one reflection.
  struct Case {
    double wind, zenith, once;
  };
  for (const Case& c : {Case{3, 70, 0.1268}, {3, 80, 0.2482}, {3, 85, 0.3512}, {10, 70, 0.0999}, {10, 80, 0.1826}, {10, 85, 0.2509}}) {
    const double found = albedo(waves(cox_munk_slopes(c.wind, true)), towards(c.zenith, 0), 100000).mean();
    EXPECT_NEAR(found / c.once, 1, 0.025) << c.wind << " " << c.zenith;
  }
}

TEST(Sea, UnderAnEvenSkyIsDarkerWithMoreWind) {
  // Their equation 5 for a clear sky's diffuse light; 0.0667 of even light are reflected by a smooth surface of n = 1.34.
  double before = 0.0667;
  for (const double wind : {3.0, 7.0, 12.0}) {
    const Sea sea = waves(cox_munk_slopes(wind, true));
    Moments moments;
    Random random(statistics::test_seed(), 4, 0);
    for (int i = 0; i < 200000; ++i) {
      const SeaView view(sea, up, Matte::draw(up, random.uniform_double(), random.uniform_double()), green);
      const Vec3 away = view.draw(random);
      moments.add(away.z > 0 ? view.value_per_sr(away)[0] * away.z / view.density_per_sr(away) : 0);
    }
    const double width = std::sqrt(0.003 + 0.00512 * wind), jin = -0.1482 - 0.012 * width + 0.1608 * 1.34 - 0.0244 * 1.34 * width;
    EXPECT_GT(moments.mean(), 0.87 * jin) << wind << ": some of it is lost between waves";
    EXPECT_LT(moments.mean(), jin) << wind;
    EXPECT_LT(moments.mean(), before);
    before = moments.mean();
  }
}

TEST(Sea, DrawsAsItsDensitySays) {
  for (const double wind : {1.0, 8.0})
    for (const double zenith : {0.0, 50.0, 80.0, 88.0}) {
      const Sea sea = whole_sea(wind);
      const SeaView view(sea, up, towards(zenith, 10), green);
      // Three regions of the sky: towards the mirror image, the upper half of it, and its west.
      const Vec3 mirrored = towards(zenith, 190);
      for (const int region : {0, 1, 2}) {
        const auto is_within = [&](const Vec3& v) {
          return v.z > 0 && (region == 0 ? dot(v, mirrored) > std::cos(radians(10)) : region == 1 ? v.z > std::cos(radians(0.8 * zenith + 5)) : v.x < 0);
        };
        Moments drawn, chance;
        Random random(statistics::test_seed(), 3, 0);
        for (int i = 0; i < 60000; ++i) {
          drawn.add(is_within(view.draw(random)) ? 1 : 0);
          const Vec3 away = Matte::draw(up, random.uniform_double(), random.uniform_double());
          chance.add(is_within(away) ? view.density_per_sr(away) * pi / away.z : 0);
        }
        EXPECT_TRUE(statistics::means_agree(drawn, chance, {.comparisons = 24}))
            << wind << " " << zenith << " " << region << ": " << drawn.mean() << " " << chance.mean();
      }
    }
}

TEST(Sea, GlittersAsCoxAndMunkSay) {
  // Radiance of the glitter per irradiance across the sun's rays: F P / (4 cos(view) cos4(tilt)), their equation 9, where no wave hides another.
  const double wind = 8;
  const Scene scene = scene_of(waves(cox_munk_slopes(wind, false)), sun_at(45), 0);
  const PathTracer path(scene, 3);
  const VolumePath volume(scene, 3);
  const Vec3 to_sun = scene.sun.to_centre();
  for (const auto& [down, azimuth] : {std::pair{45.0, 200.0}, {60.0, 200.0}, {45.0, 215.0}, {80.0, 90.0}, {35.0, 195.0}}) {
    const media::Ray ray = looking(down, azimuth);
    const Vec3 half = normalize(to_sun - ray.direction);
    const double facing = dot(half, to_sun);
    const double slopes = cox_munk(wind, half.x / half.z, half.y / half.z);
    const double expected = phase::fresnel_reflectance(facing, 1.34).unpolarised() * slopes / (4 * std::sin(radians(down)) * std::pow(half.z, 4));
    const Moments found = traced(path, ray, 3000), through = traced(volume, ray, 3000);
    // Waves hide a little; the sun's disc spreads it by less.
    EXPECT_NEAR(found.mean() / expected, 0.995, 0.01) << down << " " << azimuth;
    EXPECT_NEAR(through.mean() / expected, 0.995, 0.01) << down << " " << azimuth;
  }
}

TEST(Sea, AskingTheSunMeansTheSameAsChance) {
  // A wide sun, so that chance finds it too: balanced wrongly, either way of finding it would count twice or not at all.
  for (const double wind : {0.3, 3.0, 12.0}) {
    const Sea sea = whole_sea(wind);
    const Scene scene = scene_of(sea, sun_at(25, 4), 0.3);
    for (const auto& [down, azimuth] : {std::pair{25.0, 200.0}, {50.0, 190.0}, {5.0, 200.0}}) {
      const media::Ray ray = looking(down, azimuth);
      const Moments expected = by_chance(scene, sea, ray, 400000);
      EXPECT_TRUE(statistics::means_agree(traced(PathTracer(scene, 3), ray, 20000), expected, {.comparisons = 18})) << wind << " " << down;
      EXPECT_TRUE(statistics::means_agree(traced(VolumePath(scene, 3), ray, 20000), expected, {.comparisons = 18})) << wind << " " << down;
    }
  }
}

TEST(Sea, SeenByOtherIntegratorsIsRefused) {
  const Scene scene = scene_of(whole_sea(5), sun_at(30), 0.1);
  for (const char* name : {"whitted", "ray_cast", "photon_map"}) {
    RenderSettings settings;
    settings.integrator = name;
    EXPECT_THROW(make_integrator(scene, settings, nullptr), Error) << name;
  }
}

}  // namespace arcus::render
