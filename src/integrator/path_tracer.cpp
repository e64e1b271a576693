#include "src/integrator/path_tracer.h"

#include <vector>

#include "src/integrator/smooth_surface.h"

namespace arcus::render {
namespace {

/// Turns before roulette may end a path.
constexpr long long certain_bounces = 4;
/// A branch that is a smaller share of its path is left to chance. A rainbow's light is 0.04 of what meets a drop: drawn at random, 24 of
/// 25 paths would never see it.
constexpr float smallest_share = 0.01f;

/// A path at a smooth surface goes both ways: so many branches may wait for their turn.
struct Branch {
  PathLight light;
  media::Ray ray;
  Departure departure;
  float share = 1;      ///< of the path, of which it was split off
  float sun_share = 1;  ///< of a direct hit of the sun; the rest was found by asking it
  float sky_share = 1;  ///< of the sky's light, likewise
  long long bounce = 0;
};

/// All branches of one path.
class Tree {
 public:
  Tree(const Scene& scene, long long max_bounces, const Wavelengths& wavelengths, Random& random, Work& work)
      : scene_(scene), max_bounces_(max_bounces), wavelengths_(wavelengths), sunlight_(scene.sun.light(wavelengths)), random_(random), work_(work) {}

  Spectrum radiance(const media::Ray& camera_ray) {
    Branch first;
    first.ray = camera_ray;
    waiting_.push_back(first);
    while (!waiting_.empty()) {
      Branch branch = waiting_.back();
      waiting_.pop_back();
      while (goes_on(branch)) {
      }
    }
    return total_;
  }

 private:
  /// One step of a branch; false where it ends or has been split.
  bool goes_on(Branch& b) {
    const auto hit = scene_.surfaces.nearest_hit(b.ray, b.departure);
    if (!hit) {
      total_ += b.light.contribution(scene_.sky.radiance(b.ray.direction, wavelengths_) * b.sky_share + scene_.sun.radiance(b.ray.direction, sunlight_) * b.sun_share);
      return false;
    }
    if (b.bounce++ == max_bounces_) return false;
    ++work_.surface_hits;
    dim(b.light, *hit, wavelengths_);
    if (b.bounce > certain_bounces) {
      const float left = (b.light.weight / b.light.density.mean()).mean() / b.share;
      if (left < 1) {
        if (!(random_.uniform() < left)) return false;
        b.light.weight *= 1 / left;
      }
    }
    if (const Matte* matte = hit->material->matte()) {
      leave_matte(b, *hit, *matte);
      return true;
    }
    if (const Sea* sea = hit->material->sea()) return leave_sea(b, *hit, SeaView(*sea, hit->normal, -b.ray.direction, wavelengths_));
    split(b, *hit);
    return false;
  }

  void leave_matte(Branch& b, const Hit& hit, const Matte& matte) {
    const Sun& sun = scene_.sun;
    if (sun.is_on()) {
      const Vec3 to_sun = sun.draw(random_.uniform_double(), random_.uniform_double());
      const double cosine = dot(hit.normal, to_sun);
      ++work_.sun_rays;
      if (cosine > 0 && !scene_.surfaces.is_blocked({hit.position_m, to_sun}, hit.departure(false))) {
        const double density = sun.density_per_sr(to_sun) + Matte::density_per_sr(hit.normal, to_sun);
        total_ += b.light.contribution(sun.radiance(to_sun, sunlight_) * matte.value_per_sr(hit.position_m, hit.normal, to_sun, wavelengths_)) *
                  static_cast<float>(cosine / density);
      }
    }
    const Sky& sky = scene_.sky;
    if (sky.is_asked()) {
      const auto to_sky = sky.draw(random_.uniform_double(), random_.uniform_double());
      const double cosine = to_sky ? dot(hit.normal, *to_sky) : 0;
      work_.sun_rays += cosine > 0;
      if (cosine > 0 && !scene_.surfaces.is_blocked({hit.position_m, *to_sky}, hit.departure(false)))
        total_ += b.light.contribution(sky.radiance(*to_sky, wavelengths_) * matte.value_per_sr(hit.position_m, hit.normal, *to_sky, wavelengths_)) *
                  static_cast<float>(cosine / (sky.density_per_sr(*to_sky) + Matte::density_per_sr(hit.normal, *to_sky)));
    }
    const Vec3 away = Matte::draw(hit.normal, random_.uniform_double(), random_.uniform_double());
    // The cosine and the factor pi cancel between value and density.
    b.light.weight *= matte.albedo_at(hit.position_m).at(wavelengths_);
    b.light.polarised.depolarise();
    const double found = Matte::density_per_sr(hit.normal, away);
    b.sun_share = static_cast<float>(found / (sun.density_per_sr(away) + found));
    b.sky_share = sky.is_asked() ? static_cast<float>(found / (sky.density_per_sr(away) + found)) : 1;
    b.departure = hit.departure(false);
    b.ray = media::Ray{hit.position_m, away};
  }

  /// False where the light goes into another wave.
  bool leave_sea(Branch& b, const Hit& hit, const SeaView& sea) {
    const Sun& sun = scene_.sun;
    b.light.polarised.depolarise();
    if (sun.is_on()) {
      const Vec3 to_sun = sun.draw(random_.uniform_double(), random_.uniform_double());
      const double cosine = dot(hit.normal, to_sun);
      ++work_.sun_rays;
      if (cosine > 0 && !scene_.surfaces.is_blocked({hit.position_m, to_sun}, hit.departure(false)))
        total_ += b.light.contribution(sun.radiance(to_sun, sunlight_) * sea.value_per_sr(to_sun)) *
                  static_cast<float>(cosine / (sun.density_per_sr(to_sun) + sea.density_per_sr(to_sun)));
    }
    const Vec3 away = sea.draw(random_);
    const double cosine = dot(hit.normal, away);
    if (!(cosine > 0)) return false;
    const double found = sea.density_per_sr(away);
    b.light.weight *= sea.value_per_sr(away) * static_cast<float>(cosine / found);
    b.sky_share = 1;  // the sky was not asked
    b.sun_share = static_cast<float>(found / (sun.density_per_sr(away) + found));
    b.departure = hit.departure(false);
    b.ray = media::Ray{hit.position_m, away};
    return true;
  }

  void split(const Branch& b, const Hit& hit) {
    PathLight light = b.light;
    if (hit.material->is_dispersive()) light.leave_first_alone();
    const Turns turns = hit.material->turns(b.ray.direction, hit.normal, hit.from_inside, wavelengths_, light.polarised);
    add(b, hit, light, turns.reflected, false);
    add(b, hit, light, turns.transmitted, true);
  }

  void add(const Branch& from, const Hit& hit, const PathLight& light, const Turn& turn, bool crosses) {
    const float most = turn.share.max();
    if (!(most > 0)) return;
    float share = from.share * most, chance = 1;
    if (share < smallest_share) {
      chance = share / smallest_share;
      share = smallest_share;
      if (!(random_.uniform() < chance)) return;
    }
    Branch branch = from;
    branch.light = light;
    branch.light.weight *= turn.share * (1 / chance);
    branch.light.polarised = turn.polarised;
    branch.departure = hit.departure(crosses);
    branch.ray = media::Ray{hit.position_m, turn.direction};
    branch.share = share;
    branch.sun_share = branch.sky_share = 1;
    waiting_.push_back(branch);
  }

  const Scene& scene_;
  const long long max_bounces_;
  const Wavelengths& wavelengths_;
  const SunLight sunlight_;
  Random& random_;
  Work& work_;
  std::vector<Branch> waiting_;
  Spectrum total_;
};

}  // namespace

Spectrum PathTracer::radiance(const media::Ray& camera_ray, const Wavelengths& wavelengths, const FirstNumbers&, Random& random, Work& work) const {
  return Tree(scene_, max_bounces_, wavelengths, random, work).radiance(camera_ray);
}

}  // namespace arcus::render
