// Light that crystals scatter goes with the shadow that they cast, and none is lost or made. Slow: pictures of the whole sky.

#include <gtest/gtest.h>

#include <fstream>
#include <iostream>

#include "tests/src/render/thin_ice.h"
#include "tests/statistics/students_t.h"

namespace arcus::render {
namespace {

using statistics::Moments;

/// Shadow of a hexagonal prism over its mean over all directions, in closed form: `sun` is the angle of the light above the horizon.
double relative_shadow(double aspect, const std::string& lying, double sun_deg) {
  if (lying == "random") return 1;
  // Corners at 1 from the axis. A convex polygon's width is its circumference over pi in the mean.
  const double base = 1.5 * std::sqrt(3.0), length = 2 * aspect, side = length * 6 / pi, mean = (2 * base + 6 * length) / 4;
  const double h = radians(sun_deg);
  if (lying == "plate") return (base * std::sin(h) + side * std::cos(h)) / mean;
  double sum = 0;
  constexpr int azimuths = 1000;
  for (int i = 0; i < azimuths; ++i) {
    const double along = std::cos(h) * std::cos(2 * pi * (i + 0.5) / azimuths);
    sum += base * std::fabs(along) + side * std::sqrt(1 - along * along);
  }
  return sum / azimuths / mean;
}

/// A wide sun, so that what it makes is no finer than degrees, and all light that meets a crystal counts, what passes through parallel
/// faces too.
std::shared_ptr<const phase::Species> all_light(double aspect, const std::string& lying, const SunSettings& sun) {
  phase::Recipe recipe = ice_recipe(aspect, {.type = lying, .tilt_deg = 0}, 1);
  recipe.forward_lobe = "scatter";
  recipe.wavelength_nm = {550};
  recipe.map_step_deg = 0.5;
  recipe.material = "";
  recipe.index = {.n = 1.311, .k = 0};
  return ice_species(recipe, sun);
}

constexpr double sun_radius_deg = 3;

/// Light scattered once towards a camera by the crystals within `reach_m` of it, from all directions.
constexpr double reach_m = 50;
double sky_integral(const ThinIce& ice) {
  const Scene scene = ice.scene();
  const VolumePath once(scene, 1), never(scene, 0);
  const Wavelengths wavelengths{{550, 550, 550, 550}};
  constexpr int rows = 180, columns = 360;
  const auto cell_sum = [&](int cell, int samples, std::uint64_t stream) {
    const int row = cell / columns, column = cell % columns;
    const double low = std::sin(radians(row - 90)), high = std::sin(radians(row - 89));
    double sum = 0;
    for (int i = 0; i < samples; ++i) {
      const auto pixel = static_cast<std::uint64_t>(cell);
      const auto sample = static_cast<std::uint32_t>(i);
      const FirstNumbers first = first_numbers(statistics::test_seed(stream), pixel, sample);
      media::Ray ray{Vec3(0, 0, 0), direction_of(column + first.pixel_x, degrees(std::asin(std::lerp(low, high, first.pixel_y))))};
      ray.farthest_m = reach_m;
      Random random(statistics::test_seed(stream), pixel, sample);
      sum += once.radiance(ray, wavelengths, first, random)[0];
      if (scene.sun.density_per_sr(ray.direction) > 0) {
        // Less the sun itself, by the same path.
        Random same(statistics::test_seed(stream), pixel, sample);
        sum -= never.radiance(ray, wavelengths, first, same)[0];
      }
    }
    return sum / samples * radians(1) * (high - low);
  };
  // First where the light is, then more rays there, without those that told.
  std::vector<double> light(rows * columns);
  tbb::parallel_for(0, rows * columns, [&](int cell) { light[static_cast<std::size_t>(cell)] = cell_sum(cell, 3, 0); });
  double sum = 0;
  for (const double l : light) sum += l;
  tbb::parallel_for(0, rows * columns, [&](int cell) {
    double& l = light[static_cast<std::size_t>(cell)];
    l = cell_sum(cell, 4 + static_cast<int>(600'000 * l / sum), 1);
  });
  sum = 0;
  for (const double l : light) sum += l;
  return sum;
}

/// Means of rays into a block of optical depth `depth` at 550 nm, in a sky of radiance 1 and without a sun, in all directions.
Moments furnace(const std::vector<std::shared_ptr<const phase::Species>>& species, const std::vector<float>& size_um, double depth, int batches) {
  std::vector<media::Component> components;
  for (std::size_t i = 0; i < species.size(); ++i) {
    media::Component cloud;
    cloud.box = media::Box{Vec3(-1, -1, -0.5), Vec3(1, 1, 0.5)};
    cloud.extinction_scale = static_cast<float>(depth / static_cast<double>(species.size()));
    cloud.size_um = size_um[i];
    cloud.species = species[i];
    components.push_back(cloud);
  }
  const SunSettings off = ice_sun(30, phase::mean_sun_radius_deg, 0);
  const Scene scene{.medium = std::make_unique<media::Medium>(std::move(components)),
                    .sun = Sun(off, sun_irradiance(off, "")),
                    .sky = Sky({.type = "constant", .radiance = 1}, Curve({550}, {1}, "")),
                    .surfaces = Surfaces(),
                    .camera = nullptr};
  const VolumePath integrator(scene, 1'000'000);
  std::vector<double> means(static_cast<std::size_t>(batches));
  constexpr int paths = 250;
  tbb::parallel_for(0, batches, [&](int batch) {
    double sum = 0;
    for (int i = 0; i < paths; ++i) {
      Random random(statistics::test_seed(), static_cast<std::uint64_t>(batch), static_cast<std::uint32_t>(i));
      const Vec3 direction = direction_in_cone(frame_around(Vec3(0, 0, 1)), 1, random.uniform_double(), random.uniform_double());
      // Through a point inside, from outside.
      const Vec3 target(random.uniform_double() - 0.5, random.uniform_double() - 0.5, random.uniform_double() - 0.5);
      const Wavelengths wavelengths = draw_wavelengths(random.uniform_double());
      const FirstNumbers first{0.5, 0.5, 0.5, random.uniform_double(), random.uniform_double()};
      sum += integrator.radiance({target - direction * 5, direction}, wavelengths, first, random).mean();
    }
    means[static_cast<std::size_t>(batch)] = sum / paths;
  });
  Moments moments;
  for (const double mean : means) moments.add(mean);
  return moments;
}

phase::Recipe ice_for_furnace(const std::string& material) {
  phase::Recipe recipe = ice_recipe(0.2, {.type = "plate", .tilt_deg = 2}, 1);
  recipe.material = material;
  recipe.wavelength_nm = {380, 480, 580, 680, 780};
  return recipe;
}

/// The index of a material without its absorption, as a file.
std::string without_absorption(const phase::RefractiveIndex& index, const std::string& name) {
  const std::string path = testing::TempDir() + "arcus_" + name + ".txt";
  std::ofstream file(path);
  for (const double nm : {300, 400, 500, 600, 700, 800, 900}) file << nm << ' ' << index.relative_to_air(nm).real() << " 0\n";
  return path;
}

void expect_invisible(const Moments& seen, const char* what) {
  std::cout << what << ": mean " << seen.mean() << " standard error " << seen.standard_error() << '\n';
  EXPECT_LT(seen.standard_error(), 0.005);
  // Rounding of floats over many scatterings.
  EXPECT_NEAR(seen.mean(), 1, 3 * seen.standard_error() + 1e-4);
}

}  // namespace

// All light that meets a crystal leaves it: the sky's integral is the shadow towards the sun. Crystals whose extinction did not depend on the
// direction would send as much wherever they lie and the sun stands.
TEST(IceEnergy, BrightnessGoesWithTheShadowTowardsTheSun) {
  double greatest = 0, least = 1e9;
  for (const auto& [lying, aspect] : {std::pair<std::string, double>{"plate", 0.1}, {"column", 3}, {"random", 0.1}})
    for (const double elevation : {10.0, 40.0, 80.0}) {
      if (lying == "random" && elevation != 40) continue;
      const SunSettings sun = ice_sun(elevation, sun_radius_deg);
      const ThinIce ice{sun, {all_light(aspect, lying, sun)}, 2e-6};
      const double found = sky_integral(ice) / (reach_m * ice.extinction_per_m), expected = relative_shadow(aspect, lying, elevation);
      std::cout << lying << ' ' << aspect << ", sun at " << elevation << ": found " << found << " expected " << expected << '\n';
      EXPECT_NEAR(found, expected, 0.02 * expected);
      greatest = std::max(greatest, expected);
      least = std::min(least, expected);
    }
  EXPECT_GT(greatest, 3 * least);
}

// The sun behind a layer of level plates is dimmed by their shadow. Extinction is linear between nodes of the sine of elevation; nodes that
// were not close together near the zenith, where the shadow of the sides goes as the cosine, made it 0.8 % too small at 80 degrees.
TEST(IceEnergy, TheSunIsDimmedByTheShadowTowardsIt) {
  for (const double elevation : {10.0, 50.0, 80.0}) {
    const SunSettings sun = ice_sun(elevation, sun_radius_deg);
    const ThinIce ice{sun, {all_light(0.1, "plate", sun)}, 0.02};
    const Scene scene = ice.scene();
    const VolumePath integrator(scene, 0);
    const Wavelengths wavelengths{{550, 550, 550, 550}};
    media::Ray ray{Vec3(0, 0, 0), scene.sun.to_centre()};
    ray.farthest_m = reach_m;
    Moments moments;
    Random random(statistics::test_seed(), 0, 0);
    const double alone = scene.sun.radiance(ray.direction, scene.sun.light(wavelengths))[0];
    for (int i = 0; i < 400'000; ++i)
      moments.add(integrator.radiance(ray, wavelengths, {0.5, 0.5, 0.5, random.uniform_double(), random.uniform_double()}, random)[0] / alone);
    const double expected = std::exp(-reach_m * ice.extinction_per_m * relative_shadow(0.1, "plate", elevation));
    std::cout << "sun at " << elevation << ": transmitted " << moments.mean() << " +- " << moments.standard_error() << " expected " << expected << '\n';
    EXPECT_TRUE(statistics::mean_is(moments, expected, {.comparisons = 3, .tolerance = 0.001}));
    EXPECT_GT(std::fabs(moments.mean() - std::exp(-reach_m * ice.extinction_per_m)), 0.02);
  }
}

TEST(IceEnergy, ACloudOfCrystalsThatAbsorbNothingIsInvisibleInAnEvenSky) {
  const auto plates = phase::make_species(ice_for_furnace(without_absorption(phase::RefractiveIndex::ice(), "ice")), {});
  expect_invisible(furnace({plates}, {500}, 3, 200), "plates");

  phase::Recipe rain = phase::default_recipe("rain");
  rain.material = without_absorption(phase::RefractiveIndex::water(), "water");
  rain.size_um = {500};
  rain.wavelength_nm = {380, 480, 580, 680, 780};
  rain.optics = "geometric";
  expect_invisible(furnace({plates, phase::make_species(rain, {})}, {500, 500}, 3, 200), "plates and rain");
}

TEST(IceEnergy, ACloudThatAbsorbsALittleIsSeenInAnEvenSky) {
  phase::Recipe recipe = ice_for_furnace("");
  recipe.index = {.n = 1.31, .k = 2e-6};
  const Moments seen = furnace({phase::make_species(recipe, {})}, {500}, 3, 200);
  std::cout << "dark plates: mean " << seen.mean() << " standard error " << seen.standard_error() << '\n';
  EXPECT_LT(seen.mean(), 1 - 3 * seen.standard_error() - 1e-4);
}

}  // namespace arcus::render
