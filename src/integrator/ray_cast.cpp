#include "src/integrator/ray_cast.h"

#include "src/integrator/direct_light.h"

namespace arcus::render {

Spectrum RayCast::radiance(const media::Ray& camera_ray, const Wavelengths& wavelengths, const FirstNumbers&, Random& random, Work& work) const {
  const SunLight sunlight = scene_.sun.light(wavelengths);
  const auto hit = scene_.surfaces.nearest_hit(camera_ray);
  if (!hit) return background(scene_, camera_ray.direction, wavelengths, sunlight);
  ++work.surface_hits;
  PathLight light;
  dim(light, *hit, wavelengths);
  if (const Matte* matte = hit->material->matte())
    return light.contribution(direct_light(scene_, *hit, *matte, wavelengths, sunlight, random, [](const Vec3&) { return true; }));
  if (hit->material->is_dispersive()) light.leave_first_alone();
  const Turns turns = hit->material->turns(camera_ray.direction, hit->normal, hit->from_inside, wavelengths, {});
  Spectrum seen;
  for (const Turn& turn : {turns.reflected, turns.transmitted})
    if (turn.is_there()) seen += turn.share * background(scene_, turn.direction, wavelengths, sunlight);
  return light.contribution(seen);
}

}  // namespace arcus::render
