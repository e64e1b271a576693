#include "src/integrator/photon_tracer.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "media/medium/scatterer.h"
#include "media/tracking/collision_walk.h"
#include "phase/base/error.h"
#include "phase/species/species.h"

namespace arcus::render {
namespace {

/// Streams of random numbers that pixels do not use.
constexpr std::uint64_t caustic_stream = 1ull << 62, all_stream = 2ull << 62;
/// How much farther than what is finite photons land on planes.
constexpr double region_over_bounds = 4;
/// Bounces before roulette may end a photon.
constexpr long long certain_bounces = 4;
constexpr std::uint32_t block_size = 4096;

std::uint64_t mixed(std::uint64_t h, std::uint64_t event) {
  // The finaliser of splitmix64 (S. Vigna's form of Stafford's mix 13).
  std::uint64_t z = h * 0x9e3779b97f4a7c15ull + event;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  return z ^ (z >> 31);
}

Ball around(const media::Box& box) { return {box.centre(), 0.5 * length(box.size())}; }

/// Photons in order of their numbers, whatever threads trace them.
LandedPhotons in_order(const PhotonNumbers& numbers, const std::atomic<int>* stop_request, const auto& trace) {
  const std::uint32_t sent = numbers.last - numbers.first, blocks = (sent + block_size - 1) / block_size;
  std::vector<LandedPhotons> parts(blocks);
  tbb::parallel_for(0u, blocks, [&](std::uint32_t block) {
    if (stop_request && stop_request->load() != 0) return;
    for (std::uint32_t i = block * block_size; i < std::min(sent, (block + 1) * block_size); ++i) trace(numbers.first + i, parts[block]);
  });
  LandedPhotons landed;
  for (const LandedPhotons& part : parts) landed.append(part);
  return landed;
}

}  // namespace

struct PhotonTracer::Flight : PathLight {
  Flight(std::uint64_t seed, std::uint64_t stream, std::uint32_t number, std::uint32_t count)
      : random(seed, stream, number), wavelengths(draw_wavelengths((number + random.uniform_double()) / count)) {}
  Random random;
  Wavelengths wavelengths;
  media::Ray ray{};
  Departure departure;
  double area_m2 = 0;  ///< that the photon stands for, across the light
  long long bounces = 0;
  bool is_bent = false, is_scattered = false;  ///< it has met smooth surfaces; matte ones or a medium
  std::uint64_t ancestry = 0;

  Photon landed_at(const Vec3& position_m) const {
    Photon photon;
    photon.position_m = position_m;
    photon.direction = ShortVec(ray.direction);
    photon.ancestry = ancestry;
    photon.wavelengths = wavelengths;
    photon.share = contribution(Spectrum::filled(static_cast<float>(area_m2)));
    return photon;
  }
  Photon landed_on(const Hit& hit) const {
    Photon photon = landed_at(hit.position_m);
    photon.normal = ShortVec(hit.normal);
    photon.piece = hit.piece;
    return photon;
  }
  bool turn(const Hit& hit) {
    if (!turn_at_smooth(*this, ray, departure, hit, wavelengths, random)) return false;
    const bool crossed = dot(ray.direction, hit.normal) < 0;
    ancestry = mixed(mixed(ancestry, (std::uint64_t{hit.piece.group} << 32) | hit.piece.piece), crossed ? 2 : 1);
    is_bent = true;
    ++bounces;
    return true;
  }
  bool survives_roulette() {
    if (bounces < certain_bounces) return true;
    const float left = (weight / density.mean()).mean();
    if (left >= 1) return true;
    if (!(random.uniform() < left)) return false;
    weight *= 1 / left;
    return true;
  }
};

PhotonTracer::PhotonTracer(const Scene& scene, long long max_bounces) : scene_(scene), max_bounces_(max_bounces) {
  if (!scene.sun.is_on())
    throw bad_input("render.integrator", "'photon_map' and a sun without light", "sun.irradiance_scale above 0 expected: photons come from the sun");
  if (scene.surfaces.has_sea())
    throw bad_input("render.integrator", "'photon_map' and a surface of type 'sea'", "'volume_path' or 'path' expected: photons know no waves");
  const media::Medium& medium = *scene.medium;
  for (int k = 0; k < medium.component_count(); ++k)
    if (medium.component(k).species && medium.component(k).species->is_oriented())
      throw bad_input("render.integrator", "'photon_map' and oriented crystals in '" + medium.component(k).name + "'",
                      "'volume_path' expected: such crystals can be asked for the sun's light alone");
  media::Box bounds = scene.surfaces.bounds_m();
  if (!medium.is_empty()) bounds.include(medium.bounds_m());
  if (bounds.is_empty())
    throw bad_input("render.integrator", "'photon_map' and planes alone", "a surface of finite size or a medium expected, around which photons can land");
  region_ = around(bounds);
  if (scene.surfaces.has_planes()) region_.radius_m *= region_over_bounds;
  add_targets();
}

void PhotonTracer::add_targets() {
  const auto add = [&](const Ball& ball, PieceId piece) {
    const double before = targets_.empty() ? 0 : targets_.back().areas_m2;
    targets_.push_back({ball, piece, before + pi * ball.radius_m * ball.radius_m});
  };
  const std::vector<PieceGroup>& groups = scene_.surfaces.groups();
  for (std::uint32_t g = 0; g < groups.size(); ++g) {
    const PieceGroup& group = groups[g];
    if (scene_.surfaces.materials()[group.material].matte()) continue;
    for (std::uint32_t i = 0; i < group.spheres.size(); ++i)
      add({group.centre_m + group.spheres[i].offset_m(), group.spheres[i].radius_m}, {g, i});
    for (std::uint32_t i = 0; i < group.flats.size(); ++i) {
      const Flat& flat = group.flats[i];
      const double u2 = squared_length(flat.edge_u_m), v2 = squared_length(flat.edge_v_m), both = 2 * std::fabs(dot(flat.edge_u_m, flat.edge_v_m));
      add({flat.centre_m, std::sqrt(u2 + v2 + both)}, {g, i});
    }
    if (group.triangle_count() > 0) add(around(bounds_of(group)), {g, PieceId::none});
  }
  for (const PieceId& plane : scene_.surfaces.smooth_planes()) add(region_, plane);
}

bool PhotonTracer::set_out(Flight& flight, const Ball& through) const {
  const Sun& sun = scene_.sun;
  const SunLight light = sun.light({{550, 550, 550, 550}});
  const float brightest = sun.most_radiance(light);
  Vec3 to_sun;
  do {
    to_sun = sun.draw(flight.random.uniform_double(), flight.random.uniform_double());
  } while (flight.random.uniform() * brightest > sun.radiance(to_sun, light)[0]);
  const double radius_m = through.radius_m * std::sqrt(flight.random.uniform_double()), turn = 2 * pi * flight.random.uniform_double();
  const Vec3 place_m = through.centre_m + frame_around(to_sun).to_world(radius_m * std::cos(turn), radius_m * std::sin(turn), 0);
  // Before all that is of finite size; what lies still nearer to the sun can be planes alone.
  const double away_m = dot(region_.centre_m - place_m, to_sun) + 1.01 * region_.radius_m;
  flight.ray = media::Ray{place_m + to_sun * std::max(away_m, 0.0), -to_sun};
  return !(scene_.surfaces.has_planes() && scene_.surfaces.is_blocked({flight.ray.origin_m, to_sun}));
}

bool PhotonTracer::meets_medium(Flight& flight, const std::optional<Hit>& hit, LandedPhotons& landed, bool stores, bool goes_on) const {
  if (scene_.medium->is_empty() || (hit && hit->from_inside && hit->material->body())) return false;
  media::Ray ray = flight.ray;
  if (hit) ray.farthest_m = hit->distance_m;
  media::CollisionWalk walk(*scene_.medium, ray, flight.wavelengths, flight.random);
  media::Collision collision;
  while (walk.next(collision)) {
    const Spectrum& extinction = collision.extinction_per_m;
    if (flight.random.uniform() * collision.majorant_per_m < extinction[0]) {
      if (stores) {
        // Photons collide as often as the extinction says; the walk's own value may be that of one voxel near, drawn. How likely another
        // wavelength had made it collide here enters beside how likely it came here.
        const Spectrum mean = scene_.medium->extinction_per_m(collision.position_m, flight.wavelengths);
        if (!(mean[0] > 0)) return false;
        Flight here = flight;
        here.density *= mean / mean[0];
        here.weight *= 1 / mean[0];
        landed.in_media.push_back(here.landed_at(collision.position_m));
      }
      if (!goes_on) return true;
      const media::Scatterer scatterer = scene_.medium->scatterer(collision, flight.wavelengths, flight.random.uniform());
      const Spectrum& component = collision.component_extinction_per_m;
      const phase::Draw draw = scatterer.phase.draw(flight.ray.direction, flight.wavelengths, flight.random);
      flight.weight *= scatterer.albedo * component / component[0] * draw.value_per_sr / draw.density_per_sr[0];
      flight.density *= component / component[0] * draw.density_per_sr / draw.density_per_sr[0];
      flight.ray = media::Ray{collision.position_m, draw.outgoing};
      flight.departure = {};
      flight.polarised.depolarise();
      flight.is_scattered = true;
      ++flight.bounces;
      return true;
    }
    const Spectrum null = Spectrum::filled(collision.majorant_per_m) - extinction;
    flight.weight *= null / null[0];
    flight.density *= null / null[0];
  }
  return false;
}

bool PhotonTracer::follow_caustic(Flight& flight, const Target& target, LandedPhotons& landed) const {
  const auto is_target = [&](const Hit& hit) {
    return hit.piece.group == target.piece.group && (target.piece.piece == PieceId::none || hit.piece.piece == target.piece.piece);
  };
  while (flight.bounces < max_bounces_) {
    const auto hit = scene_.surfaces.nearest_hit(flight.ray, flight.departure);
    if (!flight.is_bent && !(hit && is_target(*hit))) return false;
    if (meets_medium(flight, hit, landed, flight.is_bent, false) || !hit) return false;
    dim(flight, *hit, flight.wavelengths);
    if (hit->material->matte()) {
      landed.on_surfaces.push_back(flight.landed_on(*hit));
      return true;
    }
    if (!flight.survives_roulette() || !flight.turn(*hit)) return false;
  }
  return false;
}

void PhotonTracer::follow(Flight& flight, bool first, LandedPhotons& landed) const {
  while (flight.bounces < max_bounces_ && flight.survives_roulette()) {
    const bool stores = first || flight.is_scattered;
    const auto hit = scene_.surfaces.nearest_hit(flight.ray, flight.departure);
    if (meets_medium(flight, hit, landed, stores, true)) continue;
    if (!hit) return;
    dim(flight, *hit, flight.wavelengths);
    if (const Matte* matte = hit->material->matte()) {
      if (stores && region_.contains(hit->position_m)) landed.on_surfaces.push_back(flight.landed_on(*hit));
      // What is left of it decides whether it goes on, so that photons stay equally strong.
      const Spectrum albedo = matte->albedo_at(hit->position_m).at(flight.wavelengths);
      const float left = (flight.weight * albedo).sum() / flight.weight.sum();
      if (!(flight.random.uniform() < left)) return;
      flight.weight *= albedo * (1 / left);
      flight.polarised.depolarise();
      flight.departure = hit->departure(false);
      flight.ray = media::Ray{hit->position_m, Matte::draw(hit->normal, flight.random.uniform_double(), flight.random.uniform_double())};
      flight.is_scattered = true;
      ++flight.bounces;
    } else if (!flight.turn(*hit)) {
      return;
    }
  }
}

LandedPhotons PhotonTracer::caustic(const PhotonNumbers& numbers, std::uint64_t seed, std::uint32_t pass, const std::atomic<int>* stop_request) const {
  if (targets_.empty()) return {};
  const double area_m2 = targets_.back().areas_m2;
  return in_order(numbers, stop_request, [&](std::uint32_t i, LandedPhotons& landed) {
    Flight flight(seed, caustic_stream + pass, i, numbers.count);
    const double place_m2 = flight.random.uniform_double() * area_m2;
    const auto target = std::upper_bound(targets_.begin(), targets_.end() - 1, place_m2, [](double a, const Target& t) { return a < t.areas_m2; });
    flight.area_m2 = area_m2 / numbers.count;
    if (set_out(flight, target->around)) follow_caustic(flight, *target, landed);
  });
}

LandedPhotons PhotonTracer::all(const PhotonNumbers& numbers, std::uint64_t seed, std::uint32_t pass, bool first, const std::atomic<int>* stop_request) const {
  return in_order(numbers, stop_request, [&](std::uint32_t i, LandedPhotons& landed) {
    Flight flight(seed, all_stream + pass, i, numbers.count);
    flight.area_m2 = pi * region_.radius_m * region_.radius_m / numbers.count;
    if (set_out(flight, region_)) follow(flight, first, landed);
  });
}

}  // namespace arcus::render
