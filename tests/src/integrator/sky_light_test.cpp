// Skies that are pictures, asked for their light: against closed forms, and against paths that find them by chance.

#include <gtest/gtest.h>

#include "media/medium/scatterer.h"
#include "media/tracking/collision_walk.h"
#include "src/integrator/path_tracer.h"
#include "src/integrator/volume_path.h"
#include "src/integrator/whitted.h"
#include "tests/src/integrator/slab.h"
#include "tests/src/simple_surfaces.h"
#include "tests/src/sky_pictures.h"
#include "tests/statistics/seed.h"
#include "tests/statistics/students_t.h"

namespace arcus::render {
namespace {

using statistics::mean_is;
using statistics::Moments;

Moments traced(const Integrator& integrator, const media::Ray& ray, int count) {
  Moments moments;
  Work work;
  for (int i = 0; i < count; ++i) {
    Random random(statistics::test_seed(), 0, static_cast<std::uint32_t>(i));
    const Wavelengths wavelengths = draw_wavelengths(random.uniform_double());
    moments.add(integrator.radiance(ray, wavelengths, {0.5, 0.5, 0.5, random.uniform_double(), random.uniform_double()}, random, work).mean());
  }
  return moments;
}

/// Without asking sun or sky: paths must get there by chance.
Moments traced_by_chance(const Scene& scene, const media::Ray& ray, int count) {
  Moments moments;
  for (int i = 0; i < count; ++i) {
    Random random(statistics::test_seed(1), 0, static_cast<std::uint32_t>(i));
    const Wavelengths wavelengths = draw_wavelengths(random.uniform_double());
    media::Ray path = ray;
    Departure departure;
    double weight = 1;
    for (;;) {
      media::CollisionWalk walk(*scene.medium, path, wavelengths, random);
      media::Collision collision;
      bool collided = false;
      const auto hit = scene.surfaces.nearest_hit(path, departure);
      while (!collided && walk.next(collision) && !(hit && collision.distance_m > hit->distance_m))
        collided = random.uniform() * collision.majorant_per_m < collision.extinction_per_m[0];
      if (collided) {
        const auto scatterer = scene.medium->scatterer(collision, wavelengths, random.uniform());
        path = {collision.position_m, scatterer.phase.draw(path.direction, wavelengths, random).outgoing};
        departure = {};
        continue;
      }
      if (!hit) break;
      weight *= hit->material->matte()->albedo_at(hit->position_m).at(550);
      departure = hit->departure(false);
      path = {hit->position_m, Matte::draw(hit->normal, random.uniform_double(), random.uniform_double())};
    }
    moments.add(weight * (scene.sky.radiance(path.direction, wavelengths).mean() + scene.sun.radiance(path.direction, scene.sun.light(wavelengths)).mean()));
  }
  return moments;
}

const SunSettings no_sun{.spectrum = "equal_energy", .irradiance_scale = 0};

Scene plate_under(const Raster& sky, double albedo) {
  return Scene{.medium = std::make_unique<media::Medium>(std::vector<media::Component>{}),
               .sun = Sun(no_sun, sun_irradiance(no_sun, "")),
               .sky = sky_of(sky),
               .surfaces = matte_plane(0, albedo),
               .camera = nullptr};
}
const media::Ray obliquely_down{Vec3(0, 0, 2), normalize(Vec3(0.3, 0.4, -1))};

/// A "sun" of six pixels at elevations of 53.4 to 56.3 degrees in a black sky, about 4.2 degrees wide.
Raster small_patch(double radiance) {
  return sky_raster(128, [&](int column, int row) { return (row == 24 || row == 25) && column >= 130 && column < 133 ? radiance : 0; });
}

}  // namespace

TEST(SkyLight, MattePlateUnderASmoothSkyHasItsClosedForm) {
  // L = a + b cos(zenith angle): irradiance pi (a + 2 b / 3).
  const double a = 0.5, b = 2, albedo = 0.6;
  const Raster sky = sky_raster(256, [&](int, int row) { return a + b * std::max(0.0, std::cos(pi * (row + 0.5) / 256)); });
  const double expected = albedo * (a + 2 * b / 3);
  EXPECT_NEAR(irradiance_of(sky) * albedo / pi, expected, 1e-4 * expected);
  const Scene scene = plate_under(sky, albedo);
  for (const bool by_volume_path : {false, true}) {
    std::unique_ptr<const Integrator> integrator;
    if (by_volume_path) integrator = std::make_unique<VolumePath>(scene, 10);
    else integrator = std::make_unique<PathTracer>(scene, 10);
    const Moments found = traced(*integrator, obliquely_down, 100000);
    EXPECT_TRUE(mean_is(found, expected, {.comparisons = 3, .tolerance = 1e-4 * expected}));
    EXPECT_FALSE(mean_is(found, 1.01 * expected));
    EXPECT_LT(found.variance(), 0.2 * expected * expected);
  }
  EXPECT_TRUE(mean_is(traced(Whitted(scene, 10), obliquely_down, 100000), expected, {.comparisons = 3, .tolerance = 1e-4 * expected}));
}

TEST(SkyLight, SmallPatchOnAPlateHasItsClosedFormAndLittleNoise) {
  const Raster sky = small_patch(1000);
  const Scene scene = plate_under(sky, 0.6);
  const double expected = irradiance_of(sky) * 0.6 / pi;
  const Moments chance = traced_by_chance(scene, obliquely_down, 200000);
  EXPECT_TRUE(mean_is(chance, expected, {.comparisons = 3}));
  for (const bool by_volume_path : {false, true}) {
    std::unique_ptr<const Integrator> integrator;
    if (by_volume_path) integrator = std::make_unique<VolumePath>(scene, 10);
    else integrator = std::make_unique<PathTracer>(scene, 10);
    const Moments found = traced(*integrator, obliquely_down, 20000);
    EXPECT_TRUE(mean_is(found, expected, {.comparisons = 3}));
    EXPECT_FALSE(mean_is(found, 1.005 * expected));
    EXPECT_LT(1000 * found.variance(), chance.variance());
    RecordProperty(by_volume_path ? "chance_over_asked_volume_path" : "chance_over_asked_path", std::to_string(chance.variance() / found.variance()));
  }
}

TEST(SkyLight, SmallPatchInAThinLayerHasItsClosedForm) {
  // One scattering from above: L = sum over the patch of radiance p mu0/(mu + mu0) (1 - exp(-tau (1/mu + 1/mu0))) over solid angle.
  const double tau = 0.1, mu = 0.6;
  for (const double g : {0.0, 0.85}) {
    Scene scene = slab_scene({.asymmetry = g, .optical_depth = tau}, 0, 0);
    const Raster sky = small_patch(1000);
    scene.sky = sky_of(sky);
    const media::Ray ray = slab_ray(mu, 40);
    const phase::PhaseFunction function{phase::HenyeyGreenstein(g)};
    double expected = 0;
    constexpr int parts = 20;
    for (int row = 24; row < 26; ++row)
      for (int column = 130; column < 133; ++column)
        for (int i = 0; i < parts; ++i)
          for (int j = 0; j < parts; ++j) {
            const double zenith = pi * (row + (i + 0.5) / parts) / 128, mu0 = std::cos(zenith);
            const Vec3 to_sky = direction_of(360.0 * (column + (j + 0.5) / parts) / 256 - 180, 90 - degrees(zenith));
            const double solid_angle = std::sin(zenith) * pi / 128 / parts * 2 * pi / 256 / parts;
            const double value = static_cast<double>(function.value(ray.direction, to_sky, {{550, 550, 550, 550}})[0]);
            expected += 1000 * solid_angle * value * mu0 / (mu + mu0) * -std::expm1(-tau * (1 / mu + 1 / mu0));
          }
    const Moments found = traced(VolumePath(scene, 1), ray, 40000);
    EXPECT_TRUE(mean_is(found, expected, {.comparisons = 2, .tolerance = 1e-4 * expected})) << g;
    EXPECT_FALSE(mean_is(found, 1.05 * expected)) << g;
    if (g > 0) continue;  // by chance no path in a hundred thousand turns back so far
    const Moments chance = traced_by_chance(scene, ray, 400000);
    EXPECT_LT(100 * found.variance(), chance.variance());
    RecordProperty("chance_over_asked", std::to_string(chance.variance() / found.variance()));
  }
}

/// All ways at once: peaked scattering, a plate, a sun that is asked, too, and paths that set out for it.
TEST(SkyLight, IsFoundEquallyByAskingAndByChance) {
  for (const double g : {0.0, 0.95})
    for (const double sun_scale : {0.0, 1.0}) {
      media::Component ball;
      ball.box = media::Box{Vec3(-10, -10, -10), Vec3(10, 10, 10)};
      ball.extinction_scale = g == 0 ? 0.05f : 0.2f;
      ball.species = std::make_shared<phase::Species>(phase::PhaseFunction(phase::HenyeyGreenstein(g)), 0.0);
      const SunSettings sun{.azimuth_deg = 0, .elevation_deg = 70, .angular_radius_deg = 10, .spectrum = "equal_energy", .irradiance_scale = sun_scale};
      // A wide bright place in the east, a gradient elsewhere.
      const Raster sky = sky_raster(32, [](int column, int row) { return std::abs(column - 48) + std::abs(row - 10) < 6 ? 20 : 0.2 + 0.02 * column; });
      const Scene scene{.medium = std::make_unique<media::Medium>(std::vector<media::Component>{ball}),
                        .sun = Sun(sun, sun_irradiance(sun, "")),
                        .sky = sky_of(sky),
                        .surfaces = matte_plane(-20, 0.5),
                        .camera = nullptr};
      const media::Ray ray{Vec3(0, 0, -15), normalize(Vec3(0.5, 0.2, 1))};
      const Moments asked = traced(VolumePath(scene, 1000000), ray, 40000), chance = traced_by_chance(scene, ray, 200000);
      EXPECT_TRUE(statistics::means_agree(asked, chance, {.comparisons = 4})) << g << ' ' << sun_scale;
      EXPECT_LT(chance.standard_error(), 0.01 * chance.mean());
      EXPECT_LT(asked.standard_error(), 0.02 * asked.mean());
      RecordProperty("chance_over_asked_g" + std::to_string(g) + "_sun" + std::to_string(sun_scale), std::to_string(chance.variance() / asked.variance()));
    }
}

/// From a plate with a ball on it, that blocks some of the sky: the path tracer of surfaces.
TEST(SkyLight, PathTracerAgreesWithChanceAmongSurfaces) {
  SurfaceParts parts;
  parts.planes.push_back({0, 0});
  parts.materials.push_back(Material(Matte(0.6)));
  parts.add(one_sphere(Vec3(0, 0, 1), 1), Material(Matte(0.8)));
  const Raster sky = sky_raster(32, [](int column, int row) { return std::abs(column - 48) + std::abs(row - 10) < 6 ? 20 : 0.2 + 0.02 * column; });
  Scene scene = plate_under(sky, 0.6);
  scene.surfaces = Surfaces(std::move(parts));
  const media::Ray ray{Vec3(-1.2, 0.3, 2), Vec3(0, 0, -1)};
  EXPECT_TRUE(statistics::means_agree(traced(PathTracer(scene, 1000), ray, 40000), traced_by_chance(scene, ray, 200000)));
}

}  // namespace arcus::render
