#pragma once
// A homogeneous plane-parallel layer over black under the sun, seen by single rays: what the reference in
// tests/published/slab_*.csv describes.

#include <limits>
#include <memory>
#include <vector>

#include "phase/species/species.h"
#include "src/integrator/volume_path.h"

namespace arcus::render {

struct Slab {
  double asymmetry = 0, albedo = 1, optical_depth = 1, sun_zenith_deg = 60;
};

/// The layer is 1 m thick, between z = 0 and 1, and a thousand kilometres wide; the sun stands in the north.
inline Scene slab_scene(const Slab& slab, double sky_radiance = 0, double sun_scale = 1) {
  media::Component layer;
  layer.name = "layer";
  layer.box = media::Box{Vec3(-5e5, -5e5, 0), Vec3(5e5, 5e5, 1)};
  layer.extinction_scale = static_cast<float>(slab.optical_depth);
  layer.albedo_scale = static_cast<float>(slab.albedo);
  layer.species = std::make_shared<phase::Species>(
      phase::PhaseFunction(phase::HenyeyGreenstein(slab.asymmetry)), 0.0);
  std::vector<media::Component> components{layer};
  const SunSettings sun{.azimuth_deg = 0, .elevation_deg = 90 - slab.sun_zenith_deg, .spectrum = "equal_energy",
                        .irradiance_scale = sun_scale};
  return Scene{.medium = std::make_unique<media::Medium>(std::move(components)),
               .sun = Sun(sun, sun_irradiance(sun, "")),
               .sky = Sky({.type = "constant", .radiance = sky_radiance}, Curve({550}, {1}, "")),
               .surfaces = Surfaces(),
               .camera = nullptr};
}

/// A ray into the layer. view_cosine > 0: from above, looking down; < 0: from below, looking up. The camera looks
/// toward azimuth_deg from the sun's.
inline media::Ray slab_ray(double view_cosine, double azimuth_deg) {
  const double elevation_deg = -degrees(std::asin(view_cosine));
  const Vec3 direction = direction_of(azimuth_deg, elevation_deg);
  return {Vec3(0, 0, view_cosine > 0 ? 1 : 0), direction};
}

}  // namespace arcus::render
