#include "src/integrator/whitted.h"

#include "src/integrator/direct_light.h"

namespace arcus::render {
namespace {

constexpr float least_weight = 1e-4f;

}  // namespace

struct Whitted::Branch {
  media::Ray ray;
  PathLight light;
  Departure departure;
  long long depth = 0;
};

Spectrum Whitted::radiance(const media::Ray& camera_ray, const Wavelengths& wavelengths, const FirstNumbers&, Random& random, Work& work) const {
  Spectrum total;
  follow(Branch{camera_ray, {}, {}, 0}, wavelengths, random, work, total);
  return total;
}

void Whitted::follow(const Branch& branch, const Wavelengths& wavelengths, Random& random, Work& work, Spectrum& total) const {
  const SunLight sunlight = scene_.sun.light(wavelengths);
  const auto hit = scene_.surfaces.nearest_hit(branch.ray, branch.departure);
  if (!hit) {
    total += branch.light.contribution(background(scene_, branch.ray.direction, wavelengths, sunlight));
    return;
  }
  if (branch.depth == max_depth_) return;
  ++work.surface_hits;
  PathLight light = branch.light;
  dim(light, *hit, wavelengths);
  if (const Matte* matte = hit->material->matte()) {
    total += light.contribution(direct_light(scene_, *hit, *matte, wavelengths, sunlight, random, [&](const Vec3& to_sun) {
      ++work.sun_rays;
      return !scene_.surfaces.is_blocked({hit->position_m, to_sun}, hit->departure(false));
    }));
    return;
  }
  if (hit->material->is_dispersive()) light.leave_first_alone();
  const Turns turns = hit->material->turns(branch.ray.direction, hit->normal, hit->from_inside, wavelengths, light.polarised);
  for (const bool crosses : {false, true}) {
    const Turn& turn = crosses ? turns.transmitted : turns.reflected;
    Branch next{{hit->position_m, turn.direction}, light, hit->departure(crosses), branch.depth + 1};
    next.light.weight *= turn.share;
    next.light.polarised = turn.polarised;
    if (next.light.contribution(Spectrum::filled(1)).max() >= least_weight) follow(next, wavelengths, random, work, total);
  }
}

}  // namespace arcus::render
