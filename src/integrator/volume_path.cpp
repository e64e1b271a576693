#include "src/integrator/volume_path.h"

#include <cmath>

#include "media/medium/scatterer.h"
#include "media/tracking/collision_walk.h"
#include "media/tracking/transmittance.h"
#include "src/integrator/volume_path_state.h"

namespace arcus::render {
namespace {

// Light that has been scattered straight on by peaked phase functions arrives from around the sun. Paths that go there by
// chance alone are rare and bright, so some set out on purpose for where the phase function, seen from the sun, is bright. All
// ways count by the balance heuristic for several samples (Veach and Guibas 1995). (Buras and Mayer, "Efficient unbiased variance
// reduction techniques for Monte Carlo simulations of radiative transfer in cloudy atmospheres", JQSRT 112, 434, 2011.) The figures
// of this and of what follows are those that served best in docs/performance.md.

/// Share of the turns at which a second path sets out for the sun beside the first, which takes nothing from paths that go
/// elsewhere; fewer where the path goes to the sun already.
constexpr float paths_to_sun = 0.2f;
/// Such a path that goes to the sun already does so again at this share of its turns: without, the few that come very near to
/// the sun would be far too bright.
constexpr float again_to_sun = 0.3f;

/// Rays to the sun expected to bring less than this are left to chance, at least one in fifty being sent. The first of a path
/// brings all that is seen of thin media, and is rarely spared.
constexpr float enough_for_first_sun_ray = 0.01f, enough_for_sun_ray = 0.1f, least_sun_rays = 0.02f;
/// The coarse optical depth overlooks holes: this share of it is believed.
constexpr float believed_depth = 0.7f;

/// Where surfaces send them: about as wide as the glow around the sun in cloud and rain.
const phase::PhaseFunction glow{phase::HenyeyGreenstein(0.95)};

/// How bright it may be in a direction, in units of the mean over all: half of the light is taken to be where the paths to
/// the sun go. Nowhere less than 1, or roulette would make noise of what comes from everywhere.
float promise(float share_to_sun, double to_sun_density_per_sr) {
  return share_to_sun == 0 ? 1 : std::max(1.f, static_cast<float>(0.5 * 4 * pi * to_sun_density_per_sr));
}

/// Where a clear body is there is no medium.
bool is_within_body(const std::optional<Hit>& hit) { return hit && hit->from_inside && hit->material->body(); }

}  // namespace

VolumePath::VolumePath(const Scene& scene, long long max_bounces)
    : VolumePath(scene, max_bounces, SunReach(*scene.medium, scene.sun.to_centre())) {}

VolumePath::VolumePath(const Scene& scene, long long max_bounces, SunReach sun_reach)
    : scene_(scene), max_bounces_(max_bounces), sun_reach_(std::move(sun_reach)) {}

Spectrum VolumePath::radiance(const media::Ray& camera_ray, const Wavelengths& wavelengths, const FirstNumbers& first,
                              Random& random, Work& work) const {
  Sample sample{wavelengths, random, work, scene_.sun.light(wavelengths), {}, {}};
  if (scene_.air) {
    sample.air.emplace(wavelengths, scene_.haze.get());
    sample.most_air_per_m = sample.air->first_depth(scene_.air->density(0));
  }
  Path path;
  path.ray = camera_ray;
  const auto hit = scene_.surfaces.nearest_hit(path.ray);
  if (hit) path.ray.farthest_m = hit->distance_m;
  if (is_within_body(hit)) {
    if (pass(path, *hit, sample)) follow(path, sample);
    return sample.total;
  }

  // Thin media: most camera rays would meet nothing. The ray is split in two, the share that meets no tentative
  // collision and the rest, whose first one is placed by an evenly spread number; their weights add up to 1.
  const double depth = media::majorant_depth(*scene_.medium, path.ray, most_forced_depth);
  if (depth > 0 && depth < most_forced_depth) {
    Path straight = path;
    straight.weight *= static_cast<float>(std::exp(-depth));
    if (advance(straight, nullptr, hit, sample)) follow(straight, sample);
    const auto scattered = static_cast<float>(-std::expm1(-depth));
    path.weight *= scattered;
    // Before the sky a medium is what is looked at, thin as it may be.
    if (!hit) path.seen_weight = scattered;
    auto walk = media::CollisionWalk::forced(*scene_.medium, path.ray, wavelengths, random, depth, first.collision);
    if (advance(path, &walk, hit, sample)) follow(path, sample);
    return sample.total;
  }
  if (depth == 0 && scene_.air && split_in_air(path, hit, first.collision, sample)) return sample.total;
  media::CollisionWalk walk(*scene_.medium, path.ray, wavelengths, random);
  if (advance(path, &walk, hit, sample)) follow(path, sample);
  return sample.total;
}

void VolumePath::follow(Path& path, Sample& sample) const {
  bool goes_on = true;
  while (goes_on && path.survives_roulette(sample.random)) {
    if (path.expectation() > split_above) {
      const int parts = path.splits();
      path.weight *= 1 / static_cast<float>(parts);
      for (int i = 1; i < parts; ++i) {
        Path part = path;
        follow(part, sample);
      }
    }
    const auto hit = scene_.surfaces.nearest_hit(path.ray, path.departure);
    if (hit) path.ray.farthest_m = hit->distance_m;
    if (is_within_body(hit)) {
      goes_on = pass(path, *hit, sample);
      continue;
    }
    media::CollisionWalk walk(*scene_.medium, path.ray, sample.wavelengths, sample.random);
    goes_on = advance(path, &walk, hit, sample);
  }
}

bool VolumePath::advance(Path& path, media::CollisionWalk* walk, const std::optional<Hit>& hit, Sample& sample) const {
  std::optional<media::AirCollision> in_air;
  AirEnd end{never, never};
  double air_m = never;  // where air, planet or the sky's table end the stretch
  // What is not needed is not asked for. Air is nowhere denser than at sea level, so up to here it is certainly not met: within clouds paths seldom get so
  // far. And whatever lies above z = 0, as the ray's origin does, lies before the planet and before the end of the region.
  double safe_m = never;
  if (scene_.air) {
    if (path.air_depth_left < 0) path.air_depth_left = -std::log1p(-sample.random.uniform_double());
    safe_m = path.ray.origin_m.z < 0 ? 0 : path.air_depth_left / sample.most_air_per_m;
  }
  const auto meet_air = [&] {
    if (!hit) end = air_end(path.ray);
    media::Ray stretch = path.ray;
    stretch.farthest_m = std::min(stretch.farthest_m, end.nearest_m());
    in_air = media::air_collision_at(*scene_.air, stretch, *sample.air, path.air_depth_left);
    air_m = in_air ? in_air->distance_m : end.nearest_m();
    safe_m = never;
  };
  media::Collision collision;
  while (walk && walk->next(collision)) {
    if (safe_m < never && (collision.distance_m > safe_m || collision.position_m.z < 0)) meet_air();
    if (collision.distance_m >= air_m) break;
    ++sample.work.tentative_collisions;
    if (sample.random.uniform() * collision.majorant_per_m < collision.extinction_per_m[0]) {
      if (path.bounces++ == max_bounces_) return false;
      if (scene_.air) dim_by_air(path, collision.distance_m, sample);
      return scatter(path, collision, sample);
    }
    path.pass_null_collision(collision);
  }
  if (safe_m < never) meet_air();
  if (in_air) {
    path.air_depth_left = -1;
    return path.bounces++ != max_bounces_ && scatter_in_air(path, *in_air, sample);
  }
  if (scene_.air) dim_by_air(path, std::min(path.ray.farthest_m, end.nearest_m()), sample);
  return leave_air(path, end, hit, sample);
}

bool VolumePath::pass(Path& path, const Hit& hit, Sample& sample) const {
  if (path.bounces++ == max_bounces_) return false;
  return meet(path, hit, sample);
}

Spectrum VolumePath::escaped(const Path& path, double distance_m, const Sample& sample) const {
  Spectrum light = scene_.sky.radiance(path.ray.direction, sample.wavelengths) * path.sky_share, sun;
  if (path.sun_share > 0) sun = scene_.sun.radiance(path.ray.direction, sample.sunlight) * path.sun_share;
  if (scene_.sky_table) {
    const media::Ray on{path.ray.at(distance_m), path.ray.direction};
    light += scene_.sky_table->radiance(on.origin_m, on.direction, sample.wavelengths) * sample.sunlight.irradiance_w_per_m2_nm;
    if (sun.max() > 0 && scene_.air->distance_to_sea_level_m(on) == never) sun *= media::transmittance(sample.air->optical_depth(scene_.air->columns(on)));
    else sun = {};
  }
  light += sun;
  return path.contribution(light);
}

bool VolumePath::scatter(Path& path, const media::Collision& collision, Sample& sample) const {
  const Wavelengths& wavelengths = sample.wavelengths;
  ++sample.work.scatterings;
  const media::Scatterer scatterer = scene_.medium->scatterer(collision, wavelengths, sample.random.uniform());
  const phase::PhaseFunction& function = scatterer.phase;
  const Spectrum& extinction = collision.component_extinction_per_m;
  path.weight *= scatterer.albedo * extinction / extinction[0];
  path.density *= extinction / extinction[0];
  return turn(path, collision.position_m, function, sample);
}

bool VolumePath::turn(Path& path, const Vec3& position_m, const phase::PhaseFunction& function, Sample& sample) const {
  const Wavelengths& wavelengths = sample.wavelengths;
  Random& random = sample.random;
  const Vec3 incoming = path.ray.direction;
  const Sun& sun = scene_.sun;

  // Where the path goes to the sun already, its own turns look there.
  const float to_sun_share = sun.is_on() && function.is_peaked() ? paths_to_sun / path.promise : 0;
  const float again_share = to_sun_share > 0 && path.promise > 1 ? again_to_sun : 0;
  // Expected number of paths that leave in a direction, a steradian, and what of them was meant for the sun; `own`: density of
  // the function's own draws.
  struct Density {
    Spectrum all, to_sun;
  };
  const auto density = [&](const Vec3& outgoing, const Spectrum& own) -> Density {
    if (to_sun_share == 0) return {own, {}};
    const Spectrum to_sun = function.value(sun.to_centre(), outgoing, wavelengths);
    return {own * (1 - again_share) + to_sun * (to_sun_share + again_share), to_sun};
  };

  // 0 for rays to sun or sky that are not sent; what the others stand for.
  const auto ray_weight = [&](const Spectrum& value, float transmittance) -> float {
    const float mean_or_more = 4 * static_cast<float>(pi) * value.max();
    const float expected = path.weight.mean() / (path.density.mean() * path.seen_weight) * mean_or_more * transmittance;
    const float enough = path.bounces > 1 ? enough_for_sun_ray : enough_for_first_sun_ray;
    const float probability = std::clamp(expected / enough, least_sun_rays, 1.f);
    return probability == 1 ? 1 : random.uniform() < probability ? 1 / probability : 0;
  };
  const auto sun_ray_weight = [&](const Spectrum& value) { return ray_weight(value, std::exp(-believed_depth * sun_reach_.optical_depth(position_m))); };
  if (sun.is_on()) {
    const Vec3 to_sun = sun.draw(random.uniform_double(), random.uniform_double());
    if (function.includes_sun_disc()) {
      // The disc is in the table; only the way to it is drawn.
      const Spectrum value = function.sunlit_value(incoming, sun.to_centre(), wavelengths);
      if (const float weight = sun_ray_weight(value); weight > 0)
        sample.total += path.contribution(value * sample.sunlight.irradiance_w_per_m2_nm *
                                          sun_transmittance(position_m, {}, to_sun, sample)) * weight;
    } else {
      const Spectrum value = function.value(incoming, to_sun, wavelengths);
      const double asked = path.density.mean() * sun.density_per_sr(to_sun);
      const double found = (path.density * density(to_sun, value).all).mean();
      if (const float weight = sun_ray_weight(value); weight > 0)
        sample.total += path.contribution(value * sun.radiance(to_sun, sample.sunlight) *
                                          sun_transmittance(position_m, {}, to_sun, sample)) *
                        static_cast<float>(weight * path.density.mean() / (asked + found));
    }
  }

  const Sky& sky = scene_.sky;
  const bool asks_sky = sky.is_asked() && !function.parts_wavelengths();  // oriented crystals know their value for sunlight alone
  if (const auto drawn = asks_sky ? sky.draw(random.uniform_double(), random.uniform_double()) : std::nullopt) {
    const Vec3& to_sky = *drawn;
    const Spectrum value = function.value(incoming, to_sky, wavelengths);
    const double asked = path.density.mean() * sky.density_per_sr(to_sky), found = (path.density * density(to_sky, value).all).mean();
    // In units of the sky's mean: it is as much brighter there as it is likelier drawn, and what paths find themselves is not asked for.
    if (const float weight = ray_weight(value * static_cast<float>(asked / (asked + found)), 1); weight > 0)
      sample.total += path.contribution(value * sky.radiance(to_sky, wavelengths) * sun_transmittance(position_m, {}, to_sky, sample)) *
                      static_cast<float>(weight * path.density.mean() / (asked + found));
  }

  if (function.parts_wavelengths() && !path.is_alone()) {
    part(path, position_m, function, sample);
    return false;
  }
  const auto leave = [&](Path& leaving, const Vec3& outgoing, const Spectrum& value, const Spectrum& own) {
    const Density densities = density(outgoing, own);
    if (function.includes_sun_disc()) {
      leaving.sun_share = 0;
    } else {
      const double asked = leaving.density.mean() * sun.density_per_sr(outgoing);
      const double found = (leaving.density * densities.all).mean();
      leaving.sun_share = static_cast<float>(found / (asked + found));
    }
    if (asks_sky) {
      const double found = (leaving.density * densities.all).mean();
      leaving.sky_share = static_cast<float>(found / (leaving.density.mean() * sky.density_per_sr(outgoing) + found));
    } else {
      leaving.sky_share = 1;
    }
    leaving.weight *= value / densities.all[0];
    leaving.density *= densities.all / densities.all[0];
    // Of all wavelengths alike: it decides the next share, which must not depend on which of them leads.
    leaving.promise = promise(to_sun_share, densities.to_sun.mean());
    leaving.leave(position_m, outgoing);
  };
  if (to_sun_share > 0 && random.uniform() < to_sun_share) {
    Path second = path;
    const Vec3 outgoing = function.draw(sun.to_centre(), wavelengths, random).outgoing;
    const Spectrum value = function.value(incoming, outgoing, wavelengths);
    leave(second, outgoing, value, value);
    follow(second, sample);
  }
  if (again_share > 0 && random.uniform() < again_share) {
    const Vec3 outgoing = function.draw(sun.to_centre(), wavelengths, random).outgoing;
    const Spectrum value = function.value(incoming, outgoing, wavelengths);
    leave(path, outgoing, value, value);
    return true;
  }
  const phase::Draw draw = function.draw(incoming, wavelengths, random);
  leave(path, draw.outgoing, draw.value_per_sr, draw.density_per_sr);
  return true;
}

void VolumePath::part(const Path& path, const Vec3& position_m, const phase::PhaseFunction& function, Sample& sample) const {
  const Spectrum share = path.weight / (path.density.mean() * wavelength_count);
  for (int j = 0; j < wavelength_count; ++j) {
    if (!(share[j] > 0)) continue;
    // The wavelength changes places with the hero, and back in what it brings.
    Wavelengths wavelengths = sample.wavelengths;
    std::swap(wavelengths.nm[0], wavelengths.nm[static_cast<std::size_t>(j)]);
    Sample alone{wavelengths, sample.random, sample.work, sample.sunlight.with_first(j), {}, {}};
    if (sample.air) {
      alone.air = sample.air->with_first(j);
      alone.most_air_per_m = alone.air->first_depth(scene_.air->density(0));
    }
    Path one = path;
    const phase::Draw draw = function.draw(path.ray.direction, wavelengths, sample.random);
    one.density = {1, 0, 0, 0};
    one.weight = draw.value_per_sr * share[j];
    one.sun_share = 0;
    one.sky_share = 1;
    one.promise = 1;
    one.leave(position_m, draw.outgoing);
    follow(one, alone);
    std::swap(alone.total[0], alone.total[j]);
    sample.total += alone.total;
  }
}

bool VolumePath::meet(Path& path, const Hit& hit, Sample& sample) const {
  ++sample.work.surface_hits;
  dim(path, hit, sample.wavelengths);
  if (const Matte* matte = hit.material->matte()) return reflect(path, hit, MatteLobe{*matte, hit.position_m, hit.normal, sample.wavelengths}, sample);
  if (const Sea* sea = hit.material->sea()) {
    if (!reflect(path, hit, SeaView(*sea, hit.normal, -path.ray.direction, sample.wavelengths), sample)) return false;
    // Where the camera sees a sea it is what is looked at, dark as it is.
    if (path.bounces == 1) path.seen_weight = std::min(path.seen_weight, path.weight.mean() / path.density.mean());
    return true;
  }
  // Nothing was asked for light that arrives this way, so a direct hit of the sun counts in full, and the sky.
  path.sun_share = path.sky_share = 1;
  path.promise = 1;
  return turn_at_smooth(path, path.ray, path.departure, hit, sample.wavelengths, sample.random);
}

bool VolumePath::meet_ground(Path& path, double distance_m, Sample& sample) const {
  if (!scene_.ground || path.bounces++ == max_bounces_) return false;
  ++sample.work.surface_hits;
  const Vec3 position = path.ray.at(distance_m);
  Vec3 up = position;
  up.z += scene_.air->settings().planet_radius_m;
  const Hit hit{distance_m, position, up.normalized(), &*scene_.ground, false, {}};
  return reflect(path, hit, MatteLobe{*scene_.ground->matte(), hit.position_m, hit.normal, sample.wavelengths}, sample);
}

template <class Lobe>
bool VolumePath::reflect(Path& path, const Hit& hit, const Lobe& lobe, Sample& sample) const {
  const Wavelengths& wavelengths = sample.wavelengths;
  Random& random = sample.random;
  const Sun& sun = scene_.sun;
  const float to_sun_share = sun.is_on() && !scene_.medium->is_empty() ? paths_to_sun : 0;
  const auto to_sun_density = [&](const Vec3& away) {
    return to_sun_share > 0 ? glow.value(sun.to_centre(), away, wavelengths)[0] : 0;
  };
  const auto density = [&](const Vec3& away) {
    return lobe.density_per_sr(away) + to_sun_share * to_sun_density(away);
  };
  const Departure departure = hit.departure(false);
  path.polarised.depolarise();
  if (sun.is_on()) {
    const Vec3 to_sun = sun.draw(random.uniform_double(), random.uniform_double());
    const double cosine = dot(hit.normal, to_sun);
    if (cosine > 0)
      sample.total += path.contribution(sun.radiance(to_sun, sample.sunlight) * lobe.value_per_sr(to_sun) *
                                        sun_transmittance(hit.position_m, departure, to_sun, sample)) *
                      static_cast<float>(cosine / (sun.density_per_sr(to_sun) + density(to_sun)));
  }
  const Sky& sky = scene_.sky;
  if (const auto drawn = sky.is_asked() ? sky.draw(random.uniform_double(), random.uniform_double()) : std::nullopt) {
    const Vec3& to_sky = *drawn;
    const double cosine = dot(hit.normal, to_sky);
    if (cosine > 0)
      sample.total += path.contribution(sky.radiance(to_sky, wavelengths) * lobe.value_per_sr(to_sky) *
                                        sun_transmittance(hit.position_m, departure, to_sky, sample)) *
                      static_cast<float>(cosine / (sky.density_per_sr(to_sky) + density(to_sky)));
  }
  const auto leave = [&](Path& leaving, const Vec3& away) {
    const double cosine = dot(hit.normal, away), found = density(away);
    if (!(cosine > 0)) return false;
    leaving.sun_share = static_cast<float>(found / (sun.density_per_sr(away) + found));
    leaving.sky_share = sky.is_asked() ? static_cast<float>(found / (sky.density_per_sr(away) + found)) : 1;
    leaving.weight *= lobe.value_per_sr(away) * static_cast<float>(cosine / found);
    leaving.promise = promise(to_sun_share, to_sun_density(away));
    leaving.ray = media::Ray{hit.position_m, away};
    leaving.departure = departure;
    return true;
  };
  if (to_sun_share > 0 && random.uniform() < to_sun_share) {
    Path second = path;
    if (leave(second, glow.draw(sun.to_centre(), wavelengths, random).outgoing)) follow(second, sample);
  }
  return leave(path, lobe.draw(random));
}

Spectrum VolumePath::sun_transmittance(const Vec3& position_m, const Departure& departure, const Vec3& to_sun, Sample& sample) const {
  ++sample.work.sun_rays;
  const media::Ray ray{position_m, to_sun};
  if (scene_.surfaces.is_blocked(ray, departure)) return {};
  if (scene_.air) {
    if (scene_.air->distance_to_sea_level_m(ray) < never) return {};  // the planet stands before the sun
    const Spectrum through_air = media::transmittance(sample.air->optical_depth(scene_.air->columns(ray)));
    return through_air * media::ratio_transmittance(*scene_.medium, ray, sample.wavelengths, sample.random);
  }
  return media::ratio_transmittance(*scene_.medium, ray, sample.wavelengths, sample.random);
}

}  // namespace arcus::render
