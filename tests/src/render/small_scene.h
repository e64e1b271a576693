#pragma once
// A block of haze over land, seen obliquely: a scene without files that renders in a moment.

#include <memory>
#include <vector>

#include "phase/species/species.h"
#include "src/scene/scene.h"
#include "src/scene/settings.h"
#include "tests/src/simple_surfaces.h"

namespace arcus::render {

inline SceneSettings small_settings() {
  SceneSettings settings;
  settings.camera.width_px = 37;
  settings.camera.height_px = 21;
  settings.camera.position_m = Vec3(0, -3, 0.5);
  settings.render.samples_per_pixel = 5;
  settings.film.channels = {"rgb", "xyz", "variance"};
  return settings;
}

inline Scene small_scene(const SceneSettings& settings) {
  media::Component block;
  block.box = media::Box{Vec3(-1, -1, 0.1), Vec3(1, 1, 1)};
  block.extinction_scale = 1.5f;
  block.species = std::make_shared<phase::Species>(phase::PhaseFunction(phase::HenyeyGreenstein(0.7)), -1.0);
  std::vector<media::Component> components{block};
  const Curve irradiance = sun_irradiance(settings.sun, "");
  return Scene{.medium = std::make_unique<media::Medium>(std::move(components)),
               .sun = Sun(settings.sun, irradiance),
               .sky = Sky({.type = "constant", .radiance = 0.1}, irradiance),
               .surfaces = matte_plane(0, 0.4),
               .camera = make_camera(settings.camera)};
}

}  // namespace arcus::render
