#include "src/integrator/volume_path.h"

#include <gtest/gtest.h>

#include "media/medium/scatterer.h"
#include "media/tracking/collision_walk.h"
#include "phase/species/make_species.h"
#include "tests/src/integrator/slab.h"
#include "tests/statistics/seed.h"
#include "tests/statistics/students_t.h"
#include "tests/src/simple_surfaces.h"

namespace arcus::render {
namespace {

using statistics::mean_is;
using statistics::Moments;

/// Samples of the radiance along one ray, each the mean over its four wavelengths.
Moments traced(const Scene& scene, const media::Ray& ray, int count, long long max_bounces = 1000000) {
  const VolumePath integrator(scene, max_bounces);
  Moments moments;
  for (int i = 0; i < count; ++i) {
    const auto sample = static_cast<std::uint32_t>(i);
    Random random(statistics::test_seed(), 0, sample);
    const Wavelengths wavelengths = draw_wavelengths(random.uniform_double());
    const FirstNumbers first{0.5, 0.5, 0.5, random.uniform_double(), random.uniform_double()};
    moments.add(integrator.radiance(ray, wavelengths, first, random).mean());
  }
  return moments;
}

/// The same without ever asking the sun: paths must hit its disc by chance.
Moments traced_by_chance(const Scene& scene, const media::Ray& ray, int count) {
  Moments moments;
  for (int i = 0; i < count; ++i) {
    Random random(statistics::test_seed(1), 0, static_cast<std::uint32_t>(i));
    const Wavelengths wavelengths = draw_wavelengths(random.uniform_double());
    media::Ray path = ray;
    double weight = 1;
    for (;;) {
      media::CollisionWalk walk(*scene.medium, path, wavelengths, random);
      media::Collision collision;
      bool collided = false;
      while (!collided && walk.next(collision))
        collided = random.uniform() * collision.majorant_per_m < collision.extinction_per_m[0];
      if (collided) {
        const auto scatterer = scene.medium->scatterer(collision, wavelengths, random.uniform());
        path = {collision.position_m, scatterer.phase.draw(path.direction, wavelengths, random).outgoing};
        continue;
      }
      const auto hit = scene.surfaces.nearest_hit(path);
      if (!hit) break;
      weight *= hit->material->matte()->albedo_at(hit->position_m).at(550);
      path = {hit->position_m, Matte::draw(hit->normal, random.uniform_double(), random.uniform_double())};
      path.nearest_m = 1e-9;
    }
    moments.add(weight * scene.sun.radiance(path.direction, scene.sun.light(wavelengths)).mean());
  }
  return moments;
}

}  // namespace

TEST(VolumePath, FurnaceWithoutAbsorptionShowsNothing) {
  for (const double g : {0.0, 0.85, -0.4}) {
    const Scene scene = slab_scene({.asymmetry = g, .optical_depth = 5}, 1.0, 0.0);
    for (const double view : {1.0, 0.3, -0.7}) {
      const Moments found = traced(scene, slab_ray(view, 40), 2000);
      EXPECT_NEAR(found.mean(), 1, 1e-5);  // every single path brings exactly the sky
      EXPECT_LT(found.variance(), 1e-8);
    }
  }
}

TEST(VolumePath, SingleScatteringHasItsClosedForm) {
  // L = E p μ0/(μ + μ0) (1 − exp(−τ (1/μ + 1/μ0))) from above.
  const double tau = 0.7, mu = 0.6, mu0 = 0.5;
  const Scene scene = slab_scene({.optical_depth = tau});
  const double expected = mu0 / (mu + mu0) * (1 - std::exp(-tau * (1 / mu + 1 / mu0))) / (4 * pi);
  const Moments found = traced(scene, slab_ray(mu, 77), 300000, 1);
  EXPECT_TRUE(mean_is(found, expected));
  EXPECT_FALSE(mean_is(found, expected * 1.02));
}

TEST(VolumePath, NoBouncesShowOnlyWhatIsSeenDirectly) {
  const Scene scene = slab_scene({.optical_depth = 1.2}, 3.0);
  EXPECT_TRUE(mean_is(traced(scene, slab_ray(1, 0), 200000, 0), 3 * std::exp(-1.2), {.tolerance = 1e-5}));
}

TEST(VolumePath, SunSeenThroughTheLayerIsDimmedByIt) {
  const double tau = 1, zenith_deg = 60;
  const Scene scene = slab_scene({.albedo = 0, .optical_depth = tau, .sun_zenith_deg = zenith_deg});
  const Scene clear = slab_scene({.albedo = 0, .optical_depth = 0, .sun_zenith_deg = zenith_deg});
  const media::Ray ray{Vec3(0, 0, 0), scene.sun.to_centre()};
  const double bare = traced(clear, ray, 20000, 0).mean();
  EXPECT_NEAR(traced(scene, ray, 100000, 0).mean() / bare, std::exp(-2 * tau), 0.01 * std::exp(-2 * tau) + 0.004);
}

TEST(VolumePath, WideSunIsFoundEquallyByAskingAndByChance) {
  media::Component ball;
  ball.box = media::Box{Vec3(-10, -10, -10), Vec3(10, 10, 10)};
  ball.extinction_scale = 0.2f;
  ball.species = std::make_shared<phase::Species>(phase::PhaseFunction(phase::HenyeyGreenstein(0.95)), 0.0);
  const std::vector<media::Component> components{ball};
  for (const double radius_deg : {10.0, 60.0}) {
    const SunSettings sun{.azimuth_deg = 0, .elevation_deg = 70, .angular_radius_deg = radius_deg,
                          .spectrum = "equal_energy"};
    const Scene scene{.medium = std::make_unique<media::Medium>(components),
                      .sun = Sun(sun, sun_irradiance(sun, "")),
                      .sky = Sky({}, Curve({550}, {1}, "")),
                      .surfaces = matte_plane(-20, 0.5),
                      .camera = nullptr};
    const media::Ray ray{Vec3(0, 0, -15), normalize(Vec3(0.1, 0.2, 1))};
    const Moments asked = traced(scene, ray, 40000), chance = traced_by_chance(scene, ray, 300000);
    EXPECT_TRUE(statistics::means_agree(asked, chance, {.comparisons = 2})) << "radius " << radius_deg;
    EXPECT_LT(chance.standard_error(), 0.03 * chance.mean());
  }
}

/// Rings of droplets are far apart at different wavelengths: whichever leads a path, each must get its own mean.
TEST(VolumePath, LeadingWavelengthsDoNotBiasTheOthers) {
  const phase::Recipe recipe = phase::recipe_from_text(
      "type = 'mie'\nsize_um = 6\nradii = 1500\ndistribution = { variance = 0.05 }\n"
      "wavelength_nm = { min = 440, max = 680, nodes = 4 }", "test");
  media::Component layer;
  layer.box = media::Box{Vec3(-5e5, -5e5, 0), Vec3(5e5, 5e5, 1)};
  layer.extinction_scale = 4;
  layer.size_um = 6;
  layer.species = phase::make_species(recipe, {.sun_angular_radius_rad = radians(0.2666)});
  std::vector<media::Component> components{layer};
  Scene scene = slab_scene({.optical_depth = 4});
  scene.medium = std::make_unique<media::Medium>(std::move(components));
  const VolumePath integrator(scene, 1000);
  const media::Ray ray = slab_ray(-0.65, 0);  // from below, some degrees beside the sun
  constexpr float nm[] = {450, 520, 590, 660};
  constexpr int count = 16000;
  for (int colour = 0; colour < wavelength_count; ++colour) {
    Moments alone, among;
    for (int i = 0; i < count; ++i) {
      const auto sample = static_cast<std::uint32_t>(i);
      Random random(statistics::test_seed(), static_cast<std::uint64_t>(colour), sample);
      const FirstNumbers first{0.5, 0.5, 0.5, 0, random.uniform_double()};
      Wavelengths same, mixed;
      const int leader = i % wavelength_count;
      for (int j = 0; j < wavelength_count; ++j) {
        same.nm[static_cast<std::size_t>(j)] = nm[colour];
        mixed.nm[static_cast<std::size_t>(j)] = nm[(leader + j) % wavelength_count];
      }
      alone.add(integrator.radiance(ray, same, first, random)[0]);
      among.add(integrator.radiance(ray, mixed, first, random)[(colour - leader + wavelength_count) % wavelength_count]);
    }
    EXPECT_TRUE(statistics::means_agree(alone, among, {.comparisons = wavelength_count})) << nm[colour] << " nm";
    EXPECT_LT(alone.standard_error(), 0.04 * alone.mean());
  }
}

TEST(VolumePath, SunBehindThePlanetSendsNothing) {
  const auto scattered_once = [](double sun_elevation_deg) {
    // A lid keeps out what the sun still reaches higher up.
    SurfaceParts parts;
    parts.planes.push_back({500, 0});
    parts.materials.push_back(Material(Matte(0)));
    const SunSettings sun{.azimuth_deg = 0, .elevation_deg = sun_elevation_deg};
    const Scene scene{.medium = std::make_unique<media::Medium>(std::vector<media::Component>{}),
                      .sun = Sun(sun, sun_irradiance(sun, "")),
                      .sky = Sky({}, Curve({550}, {1}, "")),
                      .surfaces = Surfaces(std::move(parts)),
                      .air = media::Atmosphere({}),
                      .camera = nullptr};
    return traced(scene, {{0, 0, 1}, {0, 0, 1}}, 500, 1).mean();
  };
  EXPECT_EQ(scattered_once(-1), 0);
  EXPECT_EQ(scattered_once(20), 0) << "shade of the lid";
}

}  // namespace arcus::render
