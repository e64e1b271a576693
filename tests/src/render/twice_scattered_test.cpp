// Light that level plates scatter twice: the parhelia of parhelia, 44 degrees from a low sun. Slow: makes a map of the sky, and many rays.
//
// A level plate keeps the height of the light or turns it upside down, but for the light of the arcs about the zenith, which another plate can
// bring back. So twice scattered light stands at the sun's height where two azimuths add up. Two parhelia, each as bright as one over the
// square root of what is beyond its edge, make a step at twice the azimuth: their convolution is finite there and the same beyond.
//
// What is expected: azimuths drawn by the tracer of single rays (no map, no integrator), all pairs of them added up, times what a plane layer
// of this depth makes of two scatterings, in closed form.

#include <gtest/gtest.h>

#include <iomanip>
#include <iostream>

#include "phase/crystal/crystal_population.h"
#include "tests/src/render/wedge_light.h"
#include "tests/statistics/students_t.h"

namespace arcus::render {
namespace {

constexpr double sun_deg = 20, aspect_ratio = 0.5;
constexpr double thickness_m = 100, extinction_per_m = 1.2e-3;
const phase::OrientationSettings level_plates{.type = "plate", .tilt_deg = 0};

/// A wide level layer over the camera.
Scene layer(const SunSettings& sun, const phase::Recipe& recipe) {
  media::Component ice;
  ice.box = media::Box{Vec3(-1, -1, -1), Vec3(1, 1, 1)};
  ice.world_from_index = media::Affine::translation(Vec3(0, 0, 1000)) * media::Affine::scaling(Vec3(2e5, 2e5, thickness_m / 2));
  ice.extinction_scale = static_cast<float>(extinction_per_m);
  ice.size_um = 500;
  ice.species = ice_species(recipe, sun);
  std::vector<media::Component> components{ice};
  return Scene{.medium = std::make_unique<media::Medium>(std::move(components)),
               .sun = Sun(sun, sun_irradiance(sun, "")),
               .sky = Sky({}, Curve({550}, {1}, "")),
               .surfaces = Surfaces(),
               .camera = nullptr};
}

/// Light that was scattered twice, by what a path of two scatterings sees more than the same path with one; and its standard error.
struct Twice {
  Brightness light, error;
};
Twice scattered_twice(const Scene& scene, const Strip& strip, int samples) {
  const VolumePath once(scene, 1), twice(scene, 2);
  const Wavelengths wavelengths{{550, 450, 650, 550}};
  const int place_of[colours] = {1, 0, 2};
  Twice result;
  for (int c = 0; c < colours; ++c) {
    result.light[c].resize(static_cast<std::size_t>(strip.pixels()));
    result.error[c].resize(static_cast<std::size_t>(strip.pixels()));
  }
  tbb::parallel_for(0, strip.pixels(), [&](int pixel) {
    statistics::Moments moments[colours];
    for (int i = 0; i < samples; ++i) {
      const auto p = static_cast<std::uint64_t>(pixel);
      const auto s = static_cast<std::uint32_t>(i);
      const FirstNumbers first = first_numbers(statistics::test_seed(), p, s);
      const media::Ray ray{Vec3(0, 0, 0), strip.direction(strip.from + (pixel + first.pixel_x) * strip.step, (2 * first.pixel_y - 1) * strip.half_width)};
      Random random(statistics::test_seed(), p, s), same(statistics::test_seed(), p, s);
      const Spectrum more = twice.radiance(ray, wavelengths, first, random) - once.radiance(ray, wavelengths, first, same);
      for (int c = 0; c < colours; ++c) moments[c].add(more[place_of[c]]);
    }
    for (int c = 0; c < colours; ++c) {
      result.light[c][static_cast<std::size_t>(pixel)] = moments[c].mean();
      result.error[c][static_cast<std::size_t>(pixel)] = moments[c].standard_error();
    }
  });
  return result;
}

/// What a layer makes of two scatterings: a is its depth along the first and the last part of the way, b between them; over exp(-a).
double both_downward(double a, double b) {
  const double c = a - b;
  return a * b * (std::fabs(c) < 1e-4 ? 0.5 : (std::expm1(c) - c) / (c * c));
}
double upward_between(double a, double b) {
  const double c = a + b;
  return a * b * (c + std::expm1(-c)) / (c * c);
}

/// The same light over pixels of the strip, in units of the sun's irradiance.
struct Expected {
  std::vector<double> light;
  double depth;          ///< of the layer, slantwise towards the sun
  double share_of_arcs;  ///< of the light in the strip: by way of the arcs about the zenith
};
Expected expected_twice(const Strip& strip, double nm, const SunSettings& sun, double n_added = 0) {
  const phase::CrystalPopulation plates({.habit = {.aspect_ratio = aspect_ratio}, .orientation = level_plates}, 500);
  const double n = ice_index(nm) + n_added;
  const phase::CrystalShape& shape = plates.shapes().front();
  struct Drawn {
    Vec3 direction;
    bool is_straight;
  };
  const auto draw = [&](const Vec3& light, Random& random) -> Drawn {
    const auto exit = plates.draw(light, n, 0, random);
    return {exit->direction, squared_length(exit->direction - light) < 1e-9};
  };
  // Slant depth of the layer at a height; what goes straight on counts as not stopped.
  const auto slant_depth = [&](double height_deg) {
    Random random(5, 0, 0);
    const Vec3 light = -direction_of(0, height_deg);
    constexpr int draws = 400'000;
    int stopped = 0;
    double shadow = 0;
    for (int i = 0; i < draws; ++i) stopped += !draw(light, random).is_straight;
    for (int i = 0; i < draws; ++i) shadow += shape.projected_area(plates.draw_any(random).orientation.to_crystal(light));
    return extinction_per_m * thickness_m * shadow / draws / plates.mean_projected_area_um2() * stopped / draws / std::sin(radians(height_deg));
  };
  const double arc_deg = degrees(std::asin(std::sqrt(n * n - std::pow(std::cos(radians(sun_deg)), 2))));
  const double a = slant_depth(sun_deg), b = slant_depth(arc_deg);
  const double down = both_downward(a, a), up = upward_between(a, a), arc_down = both_downward(a, b), arc_up = upward_between(a, b);

  const phase::DiscProfile disc(radians(sun.angular_radius_deg));
  const Frame to_sun = frame_around(direction_of(0, sun.elevation_deg));
  const double edge = std::pow(std::sin(radians(sun.angular_radius_deg) / 2), 2);
  constexpr int tasks = 32, groups = 600, rays = 64;
  struct Part {
    std::vector<double> light;
    double weight = 0, by_arcs = 0, all = 0;
  };
  std::vector<Part> parts(tasks);
  tbb::parallel_for(0, tasks, [&](int task) {
    Part& part = parts[static_cast<std::size_t>(task)];
    part.light.resize(static_cast<std::size_t>(strip.pixels()));
    Random random(7, static_cast<std::uint64_t>(task), 0);
    const auto add = [&](double azimuth_deg, double weight) {
      // Both sides of the sun are the same.
      const double pixel = std::floor((std::fabs(std::remainder(azimuth_deg, 360)) - strip.from) / strip.step);
      if (pixel < 0 || pixel >= strip.pixels()) return 0.0;
      part.light[static_cast<std::size_t>(pixel)] += 0.5 * weight;
      return weight;
    };
    for (int group = 0; group < groups; ++group) {
      const double s = random.uniform_double();
      const Vec3 beam = -direction_at(to_sun, edge * s, 2 * pi * random.uniform_double());
      const double sun_weight = disc.relative_radiance(std::sqrt(s), nm), offset = azimuth_deg_of(-beam);
      part.weight += sun_weight;
      std::vector<double> downward, upward;
      for (int i = 0; i < rays; ++i) {
        Drawn out = draw(beam, random);
        while (out.is_straight) out = draw(beam, random);
        const double turn = azimuth_deg_of(-out.direction) - offset;
        if (std::fabs(out.direction.z - beam.z) < 1e-6) {
          downward.push_back(turn);
        } else if (std::fabs(out.direction.z + beam.z) < 1e-6) {
          upward.push_back(turn);
        } else {
          Drawn back = draw(out.direction, random);
          while (back.is_straight) back = draw(out.direction, random);
          if (std::fabs(back.direction.z - beam.z) < 1e-6)
            part.by_arcs += add(azimuth_deg_of(-back.direction), sun_weight * (out.direction.z < 0 ? arc_down : arc_up) / rays);
        }
      }
      const double pair = sun_weight / (rays * (rays - 1.0));
      for (const auto& [turns, weight] : {std::pair{&downward, down}, {&upward, up}})
        for (std::size_t i = 0; i < turns->size(); ++i)
          for (std::size_t j = 0; j < turns->size(); ++j)
            if (i != j) part.all += add(offset + (*turns)[i] + (*turns)[j], weight * pair);
    }
  });
  Expected sum{std::vector<double>(static_cast<std::size_t>(strip.pixels())), a, 0};
  double weight = 0, by_arcs = 0, all = 0;
  for (const Part& part : parts) {
    weight += part.weight;
    by_arcs += part.by_arcs;
    all += part.all;
    for (std::size_t i = 0; i < sum.light.size(); ++i) sum.light[i] += part.light[i];
  }
  const double pixel_sr = radians(strip.step) * (std::sin(radians(sun_deg + strip.half_width)) - std::sin(radians(sun_deg - strip.half_width)));
  for (double& light : sum.light) light *= std::exp(-a) / (weight * pixel_sr);
  sum.share_of_arcs = by_arcs / (by_arcs + all);
  return sum;
}

double mean_between(const Strip& strip, const std::vector<double>& curve, double from, double to) {
  double sum = 0;
  int count = 0;
  for (int i = 0; i < strip.pixels(); ++i)
    if (strip.middle(i) > from && strip.middle(i) < to) sum += curve[static_cast<std::size_t>(i)], ++count;
  return sum / count;
}

}  // namespace

TEST(TwiceScattered, ParheliaHaveParhelia) {
  const SunSettings sun = ice_sun(sun_deg);
  const Scene scene = layer(sun, ice_recipe(aspect_ratio, level_plates, 3));
  const Strip strip = level_strip(sun_deg, 44.5, 56.5, 0.4, 0.1);
  const Twice seen = scattered_twice(scene, strip, 30'000);
  for (int c = 0; c < colours; ++c) {
    const double nm = colour_nm[c];
    const auto twice_deg = [&](double n) { return 2 * least_turn_deg(n, 60, sun_deg); };
    const auto search = [&](const std::vector<double>& curve) { return steepest_rise(strip, curve, 46.5, 52.5, 1.2); };
    const Expected expected = expected_twice(strip, nm, sun);
    const Edge found = search(seen.light[c]), due = search(expected.light);
    const auto beyond = [&](const std::vector<double>& curve) { return mean_between(strip, curve, 51, 56); };
    const auto before = [&](const std::vector<double>& curve) { return mean_between(strip, curve, 44.7, 47.3); };
    const double ratio = beyond(seen.light[c]) / beyond(expected.light), ratio_before = before(seen.light[c]) / before(expected.light);
    const double error = beyond(seen.error[c]) / beyond(seen.light[c]) / std::sqrt(50.0);  // of the mean of 50 pixels
    std::cout << std::fixed << std::setprecision(0) << nm << " nm: rises at " << std::setprecision(2) << found.at << " expected " << due.at << " (twice the least turn: "
              << twice_deg(ice_index(nm)) << "), from " << std::setprecision(4) << before(seen.light[c]) << " to " << beyond(seen.light[c]) << " expected " << before(expected.light)
              << " to " << beyond(expected.light) << "; ratios " << ratio_before << " and " << ratio << " +- " << error << "; slant depth " << expected.depth
              << ", of it brought back by the arcs' faces " << expected.share_of_arcs << '\n';
    EXPECT_NEAR(found.at, due.at, 0.15);
    EXPECT_NEAR(found.at, twice_deg(ice_index(nm)), 0.25);
    EXPECT_GT(std::fabs(found.at - twice_deg(ice_index(nm) - 0.01)), 0.45);
    EXPECT_GT(found.high, 2 * found.low);
    EXPECT_LT(error, 0.015);
    // 1 %: what the map's cells and their smoothing move out of the strip.
    EXPECT_NEAR(ratio, 1, 4 * error + 0.01);
    EXPECT_NEAR(ratio_before, 1, 0.12);
  }
}

}  // namespace arcus::render
