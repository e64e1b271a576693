#include "src/integrator/path_tracer.h"

#include <gtest/gtest.h>

#include "phase/population/tabulate.h"
#include "src/integrator/ray_cast.h"
#include "src/integrator/volume_path.h"
#include "src/integrator/whitted.h"
#include "tests/src/simple_surfaces.h"
#include "tests/statistics/cells.h"
#include "tests/statistics/chi_square.h"
#include "tests/statistics/seed.h"
#include "tests/statistics/students_t.h"

namespace arcus::render {
namespace {

using statistics::Moments;

Scene scene_of(SurfaceParts parts, const SunSettings& sun, double sky_radiance) {
  return Scene{.medium = std::make_unique<media::Medium>(std::vector<media::Component>{}),
               .sun = Sun(sun, sun_irradiance(sun, "")),
               .sky = Sky({.type = "constant", .radiance = sky_radiance}, Curve({550}, {1}, "")),
               .surfaces = Surfaces(std::move(parts)),
               .camera = nullptr};
}

/// A matte floor with a ball on it, lit by a wide sun from the south.
SurfaceParts ball_on_floor(const Material& ball) {
  SurfaceParts parts;
  parts.planes.push_back({0, 0});
  parts.materials.push_back(Material(Matte(0.6)));
  parts.add(one_sphere(Vec3(0, 0, 1), 1), ball);
  return parts;
}
const SunSettings wide_sun{.azimuth_deg = 200, .elevation_deg = 50, .angular_radius_deg = 8, .spectrum = "equal_energy"};

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

/// How often light turns within one sphere, and by what angle in all [degrees, 0 to 180]: one way, drawn.
double deflection_deg(const Surfaces& surfaces, double impact, double azimuth_rad, const Wavelengths& wavelengths, Random& random) {
  PathLight light;
  const Vec3 along(0, 0, -1);
  media::Ray ray{Vec3(impact * std::cos(azimuth_rad), impact * std::sin(azimuth_rad), 5), along};
  Departure departure;
  while (const auto hit = surfaces.nearest_hit(ray, departure)) {
    dim(light, *hit, wavelengths);
    turn_at_smooth(light, ray, departure, *hit, wavelengths, random);
  }
  return degrees(angle_between_rad(along, ray.direction));
}

}  // namespace

/// The whole distribution of what leaves a drop, against the table of geometric optics, which is computed from closed formulas.
TEST(SphereByPath, SendsLightWhereGeometricOpticsDoes) {
  SurfaceParts parts;
  parts.add(one_sphere(Vec3(0), 1), water());
  const Surfaces surfaces(std::move(parts));
  for (const double nm : {450.0, 550.0, 650.0}) {
    phase::Population population;
    population.size_um = {1000};
    population.wavelength_nm = {nm};
    population.index_at = [](double at) { return std::complex<double>(phase::RefractiveIndex::water().relative_to_air(at).real(), 0); };
    population.index = {population.index_at(nm)};
    const phase::ScatteringTable table = phase::tabulate_rays(population);
    // Per degree; what the table has between its nodes is linear in sin²(θ/2).
    const auto density = [&](double deg) {
      const auto& angles = table.scattering_angle_deg;
      const auto above = std::min<std::ptrdiff_t>(std::upper_bound(angles.begin(), angles.end(), deg) - angles.begin(), std::ssize(angles) - 1);
      const auto i = static_cast<std::size_t>(std::max<std::ptrdiff_t>(above, 1));
      const double a = phase::sin2_half_deg(angles[i - 1]), b = phase::sin2_half_deg(angles[i]);
      const double t = std::clamp((phase::sin2_half_deg(deg) - a) / (b - a), 0.0, 1.0);
      return (table.p11[i - 1] + t * (table.p11[i] - table.p11[i - 1])) * 2 * pi * std::sin(radians(deg)) * radians(1);
    };
    const statistics::IntervalCells cells(density, 0, 180, 150, table.scattering_angle_deg);
    statistics::Tally tally(cells), wrong(cells);
    const Wavelengths wavelengths{{static_cast<float>(nm), 500, 600, 700}};
    Random random(statistics::test_seed(), static_cast<std::uint64_t>(nm), 0);
    for (int i = 0; i < 200000; ++i) {
      const double deg = deflection_deg(surfaces, std::sqrt(random.uniform_double()), 2 * pi * random.uniform_double(), wavelengths, random);
      tally.add(deg);
      wrong.add(std::min(180.0, deg + 0.3));
    }
    EXPECT_TRUE(statistics::chi_square(tally, 3)) << nm;
    EXPECT_FALSE(statistics::chi_square(wrong)) << nm;
  }
}

TEST(SphereByPath, BowsAreWhereDescartesHasThem) {
  SurfaceParts parts;
  parts.add(one_sphere(Vec3(20, 30, 40), 5e-4), water());
  const Surfaces surfaces(std::move(parts));
  for (const double nm : {450.0, 550.0, 650.0})
    for (const int reflections : {1, 2}) {
      const double n = phase::RefractiveIndex::water().relative_to_air(nm).real(), k = reflections + 1;
      // cos i = √((n² − 1) / (k² − 1)): Descartes; D = 2 (i − r) + reflections (π − 2 r).
      const double i = std::acos(std::sqrt((n * n - 1) / (k * k - 1))), r = std::asin(std::sin(i) / n);
      const double expected_deg = degrees(2 * (i - r) + reflections * (pi - 2 * r));
      const Wavelengths wavelengths{{static_cast<float>(nm), 500, 600, 700}};
      double least_deg = 1e9;
      for (double impact = 0.7; impact < 0.99; impact += 2e-5) {
        media::Ray ray{Vec3(20 + impact * 5e-4, 30, 45), Vec3(0, 0, -1)};
        Departure departure;
        double turned_deg = 0;
        for (int meeting = 0; meeting < reflections + 2; ++meeting) {
          const auto hit = surfaces.nearest_hit(ray, departure);
          ASSERT_TRUE(hit);
          const bool crosses = meeting == 0 || meeting == reflections + 1;
          const Turns turns = hit->material->turns(ray.direction, hit->normal, hit->from_inside, wavelengths, {});
          const Vec3 next = crosses ? turns.transmitted.direction : turns.reflected.direction;
          turned_deg += degrees(angle_between_rad(ray.direction, next));
          departure = hit->departure(crosses);
          ray = {hit->position_m, next};
        }
        least_deg = std::min(least_deg, turned_deg);
      }
      EXPECT_NEAR(least_deg, expected_deg, 1e-4) << nm << " nm, " << reflections << " reflections";
    }
}

TEST(PathTracer, ClearBodiesAreInvisibleInAnEvenSky) {
  // Real water of this size would absorb.
  const Material dispersive(Dielectric{ClearBody(phase::RefractiveIndex::from_text("380 1.345 0\n780 1.329 0\n", "test"), SmoothSpectrum(1), 1)});
  for (const Material& material : {dielectric(1.33), dispersive, dielectric(1.0)}) {
    SurfaceParts parts;
    parts.add(one_sphere(Vec3(0), 1), material);
    parts.add(one_sphere(Vec3(2.5, 0, 0), 1), material);
    const Scene scene = scene_of(std::move(parts), {.irradiance_scale = 0}, 2);
    for (const double x : {0.0, 0.6, 0.99, 2.0}) {
      const media::Ray ray{Vec3(x, -5, 0.1), Vec3(0, 1, 0)};
      // A path's branches bring the sky together, but for the least of them, which are left to chance.
      EXPECT_TRUE(statistics::mean_is(traced(PathTracer(scene, 1000), ray, 20000), 2, {.tolerance = 1e-5}));
      // A path brings exactly the sky: its whole spectrum, or one wavelength for all four.
      EXPECT_TRUE(statistics::mean_is(traced(VolumePath(scene, 1000), ray, 200), 2, {.tolerance = 1e-5}));
      // The tree leaves out what brings less than a ten-thousandth.
      EXPECT_NEAR(traced(Whitted(scene, 60), ray, 20).mean(), 2, 0.004);
    }
  }
}

TEST(PathTracer, AgreesWithTheVolumePathWhereThereIsNoMedium) {
  for (const Material& ball : {Material(Matte(0.7)), Material(Mirror{SmoothSpectrum(0.8)}), water(), dielectric(1.5, 2e-8)}) {
    const Scene scene = scene_of(ball_on_floor(ball), wide_sun, 0.2);
    // The ball itself, and its shadow, with a caustic where it lets light through.
    for (const Vec3& target : {Vec3(0.3, 0, 1.3), Vec3(0.3, 0.8, 0)}) {
      const Vec3 eye(1, -6, 3);
      const media::Ray ray{eye, normalize(target - eye)};
      const Moments a = traced(PathTracer(scene, 50), ray, 40000), b = traced(VolumePath(scene, 50), ray, 40000);
      EXPECT_TRUE(statistics::means_agree(a, b, {.comparisons = 8})) << a.mean() << " and " << b.mean();
      EXPECT_LT(a.standard_error(), 0.03 * a.mean());
    }
  }
}

TEST(PathTracer, LightAddsUp) {
  // Twice the sun: twice the light, path by path; sun and sky together: the sum.
  const media::Ray ray{Vec3(1, -6, 3), normalize(Vec3(-0.7, 6.5, -2.6))};
  const auto with = [&](double sun, double sky) {
    SunSettings settings = wide_sun;
    settings.irradiance_scale = sun;
    return traced(PathTracer(scene_of(ball_on_floor(water()), settings, sky), 20), ray, 4000).mean();
  };
  EXPECT_NEAR(with(2, 0), 2 * with(1, 0), 1e-5 * with(2, 0));
  EXPECT_NEAR(with(1, 0.3), with(1, 0) + with(1e-9, 0.3), 0.1 * with(1, 0.3));
  EXPECT_NEAR(with(1, 0.6) - with(1, 0.3), with(1e-12, 0.3), 1e-3 * with(1, 0.3));
}

TEST(PathTracer, MatteWallHasItsClosedForm) {
  SurfaceParts parts;
  parts.planes.push_back({0, 0});
  parts.materials.push_back(Material(Matte(0.5)));
  const Scene scene = scene_of(std::move(parts), {.azimuth_deg = 0, .elevation_deg = 30, .spectrum = "equal_energy"}, 0.4);
  const media::Ray ray{Vec3(0, 0, 1), normalize(Vec3(0.2, 0, -1))};
  const double expected = 0.5 * (std::sin(radians(30)) / pi + 0.4);
  EXPECT_TRUE(statistics::mean_is(traced(PathTracer(scene, 5), ray, 20000), expected, {.tolerance = 1e-4}));
  EXPECT_TRUE(statistics::mean_is(traced(Whitted(scene, 5), ray, 20000), expected, {.tolerance = 1e-4}));
  EXPECT_TRUE(statistics::mean_is(traced(RayCast(scene), ray, 20000), expected, {.tolerance = 1e-4}));
}

}  // namespace arcus::render
