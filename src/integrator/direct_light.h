#pragma once
// Light that a matte surface gets from sun and sky without detours, as the simple integrators count it.

#include "src/integrator/smooth_surface.h"
#include "src/scene/scene.h"

namespace arcus::render {

/// Radiance towards the ray's origin [W m-2 sr-1 nm-1]: sunlight from one place of the disc, drawn anew each time, and the sky as bright as it is
/// straight over the surface, from everywhere; a picture of the sky, from a bright place of it and a direction of the surface's own, both drawn. `is_lit`: whether light from outside arrives along a direction.
template <class IsLit>
Spectrum direct_light(const Scene& scene, const Hit& hit, const Matte& matte, const Wavelengths& wavelengths, const SunLight& sunlight, Random& random,
                      IsLit is_lit) {
  const Spectrum albedo = matte.albedo_at(hit.position_m).at(wavelengths);
  Spectrum light;
  if (const Sky& sky = scene.sky; sky.is_image()) {
    const auto add = [&](const Vec3& to_sky) {
      const double cosine = dot(hit.normal, to_sky);
      if (cosine > 0 && is_lit(to_sky))
        light += albedo * sky.radiance(to_sky, wavelengths) * static_cast<float>(cosine / (pi * (sky.density_per_sr(to_sky) + Matte::density_per_sr(hit.normal, to_sky))));
    };
    if (sky.is_asked())
      if (const auto to_sky = sky.draw(random.uniform_double(), random.uniform_double())) add(*to_sky);
    add(Matte::draw(hit.normal, random.uniform_double(), random.uniform_double()));
  } else {
    light = albedo * sky.radiance(hit.normal, wavelengths);
  }
  if (!scene.sun.is_on()) return light;
  const Vec3 to_sun = scene.sun.draw(random.uniform_double(), random.uniform_double());
  const double cosine = dot(hit.normal, to_sun);
  if (cosine > 0 && is_lit(to_sun))
    light += albedo * scene.sun.radiance(to_sun, sunlight) * static_cast<float>(cosine / (pi * scene.sun.density_per_sr(to_sun)));
  return light;
}

/// What is seen where nothing stands in the way.
inline Spectrum background(const Scene& scene, const Vec3& direction, const Wavelengths& wavelengths, const SunLight& sunlight) {
  return scene.sky.radiance(direction, wavelengths) + scene.sun.radiance(direction, sunlight);
}

}  // namespace arcus::render
