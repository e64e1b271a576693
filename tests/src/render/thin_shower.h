#pragma once
// Pictures of thin clouds of drops of one size, and what the table of the same drops makes of them: one scattering, no more.

#include <array>
#include <memory>
#include <vector>

#include "phase/species/make_species.h"
#include "src/render/picture.h"

namespace arcus::render {

/// Drops of about one size under the sun, seen by a camera that looks at the antisolar point.
struct Shower {
  double size_um;
  std::shared_ptr<const phase::Species> species;
  SceneSettings settings;
};

/// A gamma distribution, with the sun's disc in its table.
inline std::shared_ptr<const phase::Species> species_of(double size_um, double variance) {
  phase::Recipe recipe = phase::default_recipe("mie");
  recipe.size_um = {size_um};
  recipe.distribution.variance = variance;
  return phase::make_species(recipe, {.sun_angular_radius_rad = radians(0.2666)});
}

inline Shower shower(double size_um, std::shared_ptr<const phase::Species> species, double fov_deg, double azimuth_deg, double sun_elevation_deg) {
  SceneSettings settings;
  settings.camera.type = "fisheye";
  settings.camera.fov_deg = fov_deg;
  settings.camera.width_px = settings.camera.height_px = 520;
  settings.camera.azimuth_deg = azimuth_deg + 180;
  settings.camera.elevation_deg = -sun_elevation_deg;
  settings.sun.azimuth_deg = azimuth_deg;
  settings.sun.elevation_deg = sun_elevation_deg;
  settings.render.samples_per_pixel = 12;
  settings.film.channels = {"rgb", "variance"};
  return {size_um, species, settings};
}

/// Thin rain all around the camera, in a block turned by `turned_deg` so that rays cross it straight or obliquely.
inline Image rendered(const Shower& shower, double turned_deg) {
  media::Component rain;
  rain.box = media::Box{Vec3(-1, -1, -1), Vec3(1, 1, 1)};
  rain.world_from_index = media::Affine::rotation_deg(Vec3(turned_deg, 0, turned_deg)) * media::Affine::scaling(Vec3(100));
  rain.extinction_scale = 2e-4f;
  rain.size_um = shower.size_um;
  rain.species = shower.species;
  std::vector<media::Component> components{rain};
  const Curve irradiance = sun_irradiance(shower.settings.sun, "");
  const Scene scene{.medium = std::make_unique<media::Medium>(std::move(components)),
                    .sun = Sun(shower.settings.sun, irradiance),
                    .sky = Sky({}, irradiance),
                    .surfaces = Surfaces(),
                    .camera = make_camera(shower.settings.camera)};
  return render_picture(shower.settings, scene, {}, {}).image;
}

/// What a thin cloud of the species shows by the angle from the antisolar point: R, G, B, per unit of its own scale.
inline std::array<std::vector<double>, 3> expected(const Shower& shower, const std::vector<double>& angle_deg) {
  const Curve irradiance = sun_irradiance(shower.settings.sun, "");
  const ToRgb to_rgb = to_rgb_from_white(xyz_of([&](double nm) { return irradiance(nm); }));
  const phase::PhaseFunction function = shower.species->phase_function(shower.size_um, 0.5f);
  std::array<std::vector<double>, 3> result;
  for (const double angle : angle_deg) {
    const Vec3 outgoing(std::sin(radians(180 - angle)), 0, std::cos(radians(180 - angle)));
    std::vector<double> nm, value;
    for (double first = 380; first <= 780; first += 5) {
      const float w = static_cast<float>(first);
      const Wavelengths one{{w, w, w, w}};
      nm.push_back(first);
      value.push_back(function.sunlit_value(Vec3(0, 0, 1), outgoing, one)[0] * irradiance(first) *
                      shower.species->extinction_ratio(shower.size_um, one)[0] * shower.species->albedo(shower.size_um, one)[0]);
    }
    const Curve spectrum(nm, value, "spectrum");
    const Rgb rgb = to_rgb(xyz_of([&](double w) { return spectrum(w); }));
    result[0].push_back(rgb.r);
    result[1].push_back(rgb.g);
    result[2].push_back(rgb.b);
  }
  return result;
}

}  // namespace arcus::render
