// The bows of a rendered shower stand where the table of the same drops has them. Slow: makes a table and pictures.

#include <gtest/gtest.h>

#include "phase/species/make_species.h"
#include "src/analysis/peaks.h"
#include "src/analysis/profile.h"
#include "src/render/picture.h"

namespace arcus::render {
namespace {

constexpr double size_um = 250;

struct Shower {
  std::shared_ptr<const phase::Species> species;
  SceneSettings settings;
};

Shower shower(double azimuth_deg, double sun_elevation_deg) {
  static const std::shared_ptr<const phase::Species> species = [] {
    phase::Recipe recipe = phase::default_recipe("mie");
    recipe.size_um = {size_um};
    recipe.distribution.variance = 0.05;
    return phase::make_species(recipe, {.sun_angular_radius_rad = radians(0.2666)});
  }();
  SceneSettings settings;
  settings.camera.type = "fisheye";
  settings.camera.fov_deg = 130;
  settings.camera.width_px = settings.camera.height_px = 520;
  settings.camera.azimuth_deg = azimuth_deg + 180;
  settings.camera.elevation_deg = -sun_elevation_deg;
  settings.sun.azimuth_deg = azimuth_deg;
  settings.sun.elevation_deg = sun_elevation_deg;
  settings.render.samples_per_pixel = 12;
  settings.film.channels = {"rgb", "variance"};
  return {species, settings};
}

/// Thin rain all around the camera, in a block turned by `turned_deg` so that rays cross it straight or obliquely.
Image rendered(const Shower& shower, double turned_deg) {
  media::Component rain;
  rain.box = media::Box{Vec3(-1, -1, -1), Vec3(1, 1, 1)};
  rain.world_from_index = media::Affine::rotation_deg(Vec3(turned_deg, 0, turned_deg)) * media::Affine::scaling(Vec3(100));
  rain.extinction_scale = 2e-4f;
  rain.size_um = size_um;
  rain.species = shower.species;
  std::vector<media::Component> components{rain};
  const Curve irradiance = sun_irradiance(shower.settings.sun, "");
  const Scene scene{.medium = std::make_unique<media::Medium>(std::move(components)),
                    .sun = Sun(shower.settings.sun, irradiance),
                    .sky = Sky({}, irradiance),
                    .surfaces = Surfaces({}),
                    .camera = make_camera(shower.settings.camera)};
  return render_picture(shower.settings, scene, {}, {}).image;
}

/// What a thin cloud of the species shows by the angle from the antisolar point: R, G, B, per unit of its own scale.
std::array<std::vector<double>, 3> expected(const Shower& shower, const std::vector<double>& angle_deg) {
  const Curve irradiance = sun_irradiance(shower.settings.sun, "");
  const ToRgb to_rgb = to_rgb_from_white(xyz_of([&](double nm) { return irradiance(nm); }));
  const phase::PhaseFunction function = shower.species->phase_function(size_um, 0.5f);
  std::array<std::vector<double>, 3> result;
  for (const double angle : angle_deg) {
    const Vec3 outgoing(std::sin(radians(180 - angle)), 0, std::cos(radians(180 - angle)));
    std::vector<double> nm, value;
    for (double first = 380; first <= 780; first += 5) {
      const float w = static_cast<float>(first);
      const Wavelengths one{{w, w, w, w}};
      nm.push_back(first);
      value.push_back(function.sunlit_value(Vec3(0, 0, 1), outgoing, one)[0] * irradiance(first) *
                      shower.species->extinction_ratio(size_um, one)[0] * shower.species->albedo(size_um, one)[0]);
    }
    const Curve spectrum(nm, value, "spectrum");
    const Rgb rgb = to_rgb(xyz_of([&](double w) { return spectrum(w); }));
    result[0].push_back(rgb.r);
    result[1].push_back(rgb.g);
    result[2].push_back(rgb.b);
  }
  return result;
}

double highest(const std::vector<double>& x, std::span<const double> y, double low, double high) {
  double position = 0, height = -1;
  for (const Peak& peak : find_peaks(x, y, {}))
    if (peak.position > low && peak.position < high && peak.height > height) {
      position = peak.position;
      height = peak.height;
    }
  return position;
}

double mean_between(const Profile& profile, const std::vector<double>& values, double low, double high) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (profile.angle_deg[i] > low && profile.angle_deg[i] < high) {
      sum += values[i];
      ++count;
    }
  return sum / count;
}

}  // namespace

TEST(Rainbow, StandsWhereTheTableHasItAndTheBandBetweenIsDark) {
  for (const double turned_deg : {0.0, 35.0}) {
    const Shower rain = shower(180, 20);
    const Profile profile = measure_profile(rendered(rain, turned_deg), {.bin_deg = 0.1, .from_deg = 30, .to_deg = 62}, "picture");
    const auto table = expected(rain, profile.angle_deg);
    for (std::size_t c = 0; c < 3; ++c) {
      const char* name = c == 0 ? "R" : c == 1 ? "G" : "B";
      const std::vector<double>& mean = profile.channel(name)->mean;
      for (const auto& [low, high] : {std::pair{39.0, 43.5}, std::pair{49.0, 56.0}}) {
        const double found = highest(profile.angle_deg, mean, low, high);
        const double there = highest(profile.angle_deg, table[c], low, high);
        EXPECT_NEAR(found, there, 0.1) << name << " turned by " << turned_deg;
        std::cout << name << ": picture " << found << " table " << there << '\n';
      }
      const double dark = mean_between(profile, mean, 45, 48);
      EXPECT_LT(dark, 0.7 * mean_between(profile, mean, 32, 37)) << name;
      EXPECT_LT(dark, 0.7 * mean_between(profile, mean, 55, 60)) << name;
    }
  }
}

TEST(Rainbow, OneAzimuthHasTheSameProfileAsAnother) {
  const Shower rain = shower(40, 35);
  const Image picture = rendered(rain, 0);
  std::vector<Profile> sectors;
  for (const double from : {0.0, 120.0, 240.0})
    sectors.push_back(measure_profile(picture, {.bin_deg = 0.25, .from_deg = 39, .to_deg = 55, .sector_from_deg = from,
                                                .sector_to_deg = from + 60}, "picture"));
  for (std::size_t s = 1; s < sectors.size(); ++s) {
    EXPECT_NEAR(highest(sectors[0].angle_deg, sectors[0].channel("G")->mean, 39, 43.5),
                highest(sectors[s].angle_deg, sectors[s].channel("G")->mean, 39, 43.5), 0.1);
  }
}

}  // namespace arcus::render
