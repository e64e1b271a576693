#include "src/integrator/path_tracer.h"

#include "src/integrator/smooth_surface.h"

namespace arcus::render {
namespace {

/// Turns before roulette may end a path.
constexpr long long certain_bounces = 4;

}  // namespace

Spectrum PathTracer::radiance(const media::Ray& camera_ray, const Wavelengths& wavelengths, const FirstNumbers&, Random& random,
                              Work& work) const {
  const Sun& sun = scene_.sun;
  const SunLight sunlight = sun.light(wavelengths);
  Spectrum total;
  PathLight light;
  media::Ray ray = camera_ray;
  Departure departure;
  float sun_share = 1;  // of a direct hit of the sun; the rest was found by asking it
  for (long long bounce = 0;; ++bounce) {
    const auto hit = scene_.surfaces.nearest_hit(ray, departure);
    if (!hit) {
      total += light.contribution(scene_.sky.radiance(ray.direction, wavelengths) + sun.radiance(ray.direction, sunlight) * sun_share);
      return total;
    }
    if (bounce == max_bounces_) return total;
    ++work.surface_hits;
    dim(light, *hit, wavelengths);
    if (bounce >= certain_bounces) {
      const float left = (light.weight / light.density.mean()).mean();
      if (left < 1) {
        if (!(random.uniform() < left)) return total;
        light.weight *= 1 / left;
      }
    }
    if (const Matte* matte = hit->material->matte()) {
      if (sun.is_on()) {
        const Vec3 to_sun = sun.draw(random.uniform_double(), random.uniform_double());
        const double cosine = dot(hit->normal, to_sun);
        ++work.sun_rays;
        if (cosine > 0 && !scene_.surfaces.is_blocked({hit->position_m, to_sun}, hit->departure(false))) {
          const double density = sun.density_per_sr(to_sun) + Matte::density_per_sr(hit->normal, to_sun);
          total += light.contribution(sun.radiance(to_sun, sunlight) * matte->value_per_sr(hit->position_m, hit->normal, to_sun, wavelengths)) *
                   static_cast<float>(cosine / density);
        }
      }
      const Vec3 away = Matte::draw(hit->normal, random.uniform_double(), random.uniform_double());
      // The cosine and the factor pi cancel between value and density.
      light.weight *= matte->albedo_at(hit->position_m).at(wavelengths);
      light.polarised.depolarise();
      const double found = Matte::density_per_sr(hit->normal, away);
      sun_share = static_cast<float>(found / (sun.density_per_sr(away) + found));
      departure = hit->departure(false);
      ray = media::Ray{hit->position_m, away};
    } else {
      if (!turn_at_smooth(light, ray, departure, *hit, wavelengths, random)) return total;
      sun_share = 1;
    }
  }
}

}  // namespace arcus::render
