#include "src/integrator/photon_map.h"

#include <cmath>

#include "media/medium/scatterer.h"
#include "media/tracking/collision_walk.h"
#include "media/tracking/transmittance.h"

namespace arcus::render {
namespace {

/// Turns before roulette may end a path.
constexpr long long certain_bounces = 4;

std::vector<PhotonPass> sent_here(const PhotonSending& sending) {
  PhotonsSentHere source(sending);
  return *gather_passes(sending, source);
}

}  // namespace

/// What of the sunlight a path still has to find.
enum class Sunlight {
  all,         ///< all that arrives along its ray; the disc itself where it is seen through mirrors and clear bodies alone
  beyond_one,  ///< what matte surfaces or media send on: the rest was asked for, or looked up, where the path comes from
  none         ///< it was looked up
};

struct PhotonMap::Path : PathLight {
  media::Ray ray;
  Departure departure;
  Sunlight wants = Sunlight::all;
  bool sees_disc = true;  ///< where it wants all: the disc was not asked for where the path comes from
  long long bounces = 0;
};

struct PhotonMap::Sample {
  const Wavelengths& wavelengths;
  const PhotonPass& maps;
  Random& random;
  Work& work;
  SunLight sunlight;
  SpectralQuery query;
  Spectrum total;

  void add(const Path& path, const Spectrum& light) { total += path.contribution(light); }
};

PhotonMap::PhotonMap(const Scene& scene, const RenderSettings& settings) : PhotonMap(scene, PhotonSending(scene, settings)) {}

PhotonMap::PhotonMap(const Scene& scene, const PhotonSending& sending) : PhotonMap(scene, sending, sent_here(sending)) {}

PhotonMap::PhotonMap(const Scene& scene, const PhotonSending& sending, std::vector<PhotonPass> passes)
    : scene_(scene),
      max_bounces_(sending.settings().max_bounces),
      final_gather_(sending.settings().final_gather),
      has_sky_(!scene.sky.is_dark()),
      region_(sending.tracer().region()),
      passes_(std::move(passes)) {}

Spectrum PhotonMap::radiance(const media::Ray& camera_ray, const Wavelengths& wavelengths, const FirstNumbers& first, Random& random, Work& work) const {
  const auto number = std::min(static_cast<std::size_t>(first.choice * static_cast<double>(passes_.size())), passes_.size() - 1);
  Sample sample{wavelengths, passes_[number], random, work, scene_.sun.light(wavelengths), SpectralQuery(wavelengths), {}};
  Path path;
  path.ray = camera_ray;
  while (pass(path, sample)) {
    if (path.bounces <= certain_bounces) continue;
    const float left = (path.weight / path.density.mean()).mean();
    if (left >= 1) continue;
    if (!(random.uniform() < left)) break;
    path.weight *= 1 / left;
  }
  return sample.total;
}

/// Follows a path along its ray to what it meets there. False where it ends.
bool PhotonMap::pass(Path& path, Sample& sample) const {
  const auto hit = scene_.surfaces.nearest_hit(path.ray, path.departure);
  if (!scene_.medium->is_empty() && !(hit && hit->from_inside && hit->material->body())) {
    media::Ray ray = path.ray;
    if (hit) ray.farthest_m = hit->distance_m;
    media::CollisionWalk walk(*scene_.medium, ray, sample.wavelengths, sample.random);
    media::Collision collision;
    while (walk.next(collision)) {
      ++sample.work.tentative_collisions;
      if (sample.random.uniform() * collision.majorant_per_m < collision.extinction_per_m[0])
        return path.bounces++ < max_bounces_ && scatter(path, collision, sample);
      const Spectrum null = Spectrum::filled(collision.majorant_per_m) - collision.extinction_per_m;
      path.weight *= null / null[0];
      path.density *= null / null[0];
    }
  }
  if (!hit) {
    Spectrum light = scene_.sky.radiance(path.ray.direction, sample.wavelengths);
    if (path.wants == Sunlight::all && path.sees_disc) light += scene_.sun.radiance(path.ray.direction, sample.sunlight);
    sample.add(path, light);
    return false;
  }
  return path.bounces++ < max_bounces_ && meet(path, *hit, sample);
}

bool PhotonMap::meet(Path& path, const Hit& hit, Sample& sample) const {
  ++sample.work.surface_hits;
  dim(path, hit, sample.wavelengths);
  const Matte* matte = hit.material->matte();
  if (!matte) {
    path.sees_disc = true;
    return turn_at_smooth(path, path.ray, path.departure, hit, sample.wavelengths, sample.random);
  }
  const Spectrum albedo = matte->albedo_at(hit.position_m).at(sample.wavelengths);
  const Departure departure = hit.departure(false);
  const Spectrum per_irradiance = albedo * sample.sunlight.irradiance_w_per_m2_nm * static_cast<float>(1 / pi);
  const Flat* flat = scene_.surfaces.flat(hit.piece);
  const bool is_mapped = region_.contains(hit.position_m);
  if (path.wants == Sunlight::beyond_one && is_mapped) {
    const Gathered all = sample.maps.on_surfaces.irradiance(hit.position_m, hit.normal, sample.maps.neighbours, sample.query, flat);
    // From a corner the blur would be seen: there it is looked up another bounce away.
    if (hit.distance_m < all.radius_m) {
      path.wants = Sunlight::all;
    } else {
      sample.add(path, per_irradiance * all.value);
      path.wants = Sunlight::none;
    }
  } else if (path.wants == Sunlight::beyond_one) {
    path.wants = Sunlight::all;
  }
  if (path.wants == Sunlight::all) {
    const Vec3 to_sun = scene_.sun.draw(sample.random.uniform_double(), sample.random.uniform_double());
    const double cosine = dot(hit.normal, to_sun);
    ++sample.work.sun_rays;
    if (cosine > 0 && !scene_.surfaces.is_blocked({hit.position_m, to_sun}, departure))
      sample.add(path, albedo * scene_.sun.radiance(to_sun, sample.sunlight) *
                           media::ratio_transmittance(*scene_.medium, {hit.position_m, to_sun}, sample.wavelengths, sample.random) *
                           static_cast<float>(cosine / (pi * scene_.sun.density_per_sr(to_sun))));
    path.sees_disc = false;
    if (is_mapped) {
      const auto look_up = [&](const PhotonStore& photons) {
        sample.add(path, per_irradiance * photons.irradiance(hit.position_m, hit.normal, sample.maps.neighbours, sample.query, flat).value);
      };
      look_up(sample.maps.caustic_on_surfaces);
      if (!final_gather_) look_up(sample.maps.on_surfaces);
      path.wants = final_gather_ ? Sunlight::beyond_one : Sunlight::none;
    }
  }
  if (path.wants == Sunlight::none && !has_sky_) return false;
  path.weight *= albedo;
  path.polarised.depolarise();
  path.departure = departure;
  path.ray = media::Ray{hit.position_m, Matte::draw(hit.normal, sample.random.uniform_double(), sample.random.uniform_double())};
  return true;
}

bool PhotonMap::scatter(Path& path, const media::Collision& collision, Sample& sample) const {
  ++sample.work.scatterings;
  const Wavelengths& wavelengths = sample.wavelengths;
  const media::Scatterer scatterer = scene_.medium->scatterer(collision, wavelengths, sample.random.uniform());
  const phase::PhaseFunction& function = scatterer.phase;
  const Spectrum& extinction = collision.component_extinction_per_m;
  path.weight *= scatterer.albedo * extinction / extinction[0];
  path.density *= extinction / extinction[0];
  const Vec3 incoming = path.ray.direction;
  const auto look_up = [&](const PhotonStore& photons) {
    const Gathered found = photons.scattered(collision.position_m, incoming, function, wavelengths, sample.maps.neighbours, sample.query, scene_.medium->bounds_m());
    sample.add(path, sample.sunlight.irradiance_w_per_m2_nm * found.value);
  };
  if (path.wants == Sunlight::beyond_one) {
    look_up(sample.maps.in_media);
    path.wants = Sunlight::none;
  } else if (path.wants == Sunlight::all) {
    const Sun& sun = scene_.sun;
    const Vec3 to_sun = sun.draw(sample.random.uniform_double(), sample.random.uniform_double());
    const media::Ray ray{collision.position_m, to_sun};
    ++sample.work.sun_rays;
    if (!scene_.surfaces.is_blocked(ray)) {
      // Where the disc is in the table, only the way to it is drawn.
      const Spectrum scattered =
          function.includes_sun_disc()
              ? function.sunlit_value(incoming, sun.to_centre(), wavelengths) * sample.sunlight.irradiance_w_per_m2_nm
              : function.value(incoming, to_sun, wavelengths) * sun.radiance(to_sun, sample.sunlight) * static_cast<float>(1 / sun.density_per_sr(to_sun));
      sample.add(path, scattered * media::ratio_transmittance(*scene_.medium, ray, wavelengths, sample.random));
    }
    path.sees_disc = false;
    look_up(sample.maps.caustic_in_media);
    if (!final_gather_) look_up(sample.maps.in_media);
    path.wants = final_gather_ ? Sunlight::beyond_one : Sunlight::none;
  }
  if (path.wants == Sunlight::none && !has_sky_) return false;
  const phase::Draw draw = function.draw(incoming, wavelengths, sample.random);
  path.weight *= draw.value_per_sr / draw.density_per_sr[0];
  path.density *= draw.density_per_sr / draw.density_per_sr[0];
  path.ray = media::Ray{collision.position_m, draw.outgoing};
  path.departure = {};
  path.polarised.depolarise();
  return true;
}

}  // namespace arcus::render
