// VolumePath in air: where a path meets it, the planet under it, and the sky's table behind it.

#include <cmath>

#include "media/air/air_walk.h"
#include "media/tracking/transmittance.h"
#include "src/integrator/volume_path_state.h"

namespace arcus::render {
namespace {

/// Dry air in the visible range (phase/optics/air.h says how little it changes over it).
const phase::PhaseFunction by_air{phase::Rayleigh()};

}  // namespace

bool VolumePath::split_in_air(Path& path, const std::optional<Hit>& hit, double u, Sample& sample) const {
  const AirEnd end = hit ? AirEnd{never, never} : air_end(path.ray);
  media::Ray stretch = path.ray;
  stretch.farthest_m = std::min(stretch.farthest_m, end.nearest_m());
  const Spectrum whole = sample.air->optical_depth(scene_.air->columns(stretch));
  if (!(whole[0] > 0 && whole.max() < most_forced_depth)) return false;

  Path straight = path;
  straight.weight *= media::transmittance(whole);
  if (leave_air(straight, end, hit, sample)) follow(straight, sample);
  // The collision's density at each wavelength is relative to that wavelength's own share of rays that collide.
  Spectrum share;
  for (int j = 0; j < wavelength_count; ++j) share[j] = -std::expm1(-whole[j]);
  const auto collision = media::air_collision_at(*scene_.air, stretch, *sample.air, -std::log1p(-u * static_cast<double>(share[0])));
  if (!collision || path.bounces++ == max_bounces_) return true;
  path.weight *= share[0];
  path.density *= Spectrum::filled(share[0]) / share;
  if (!hit) path.seen_weight = share[0];
  if (scatter_in_air(path, *collision, sample)) follow(path, sample);
  return true;
}

VolumePath::AirEnd VolumePath::air_end(const media::Ray& ray) const {
  AirEnd end{scene_.air->distance_to_sea_level_m(ray), never};
  if (scene_.sky_table) {
    const auto inside = media::clip(ray, scene_.air_region_m);
    end.exit_m = inside ? inside->end : 0;
  }
  return end;
}

bool VolumePath::leave_air(Path& path, const AirEnd& end, const std::optional<Hit>& hit, Sample& sample) const {
  if (end.ground_m < never && end.ground_m <= end.exit_m) return meet_ground(path, end.ground_m, sample);
  if (!hit) {
    sample.total += escaped(path, end.exit_m, sample);
    return false;
  }
  return pass(path, *hit, sample);
}

void VolumePath::dim_by_air(Path& path, double distance_m, const Sample& sample) const {
  media::Ray way = path.ray;
  way.farthest_m = distance_m;
  const Spectrum depth = sample.air->optical_depth(scene_.air->columns(way));
  const Spectrum ratio = media::transmittance_over_first(depth);
  path.weight *= ratio;
  path.density *= ratio;
  // What rounding may take beyond what was drawn.
  if (path.air_depth_left >= 0) path.air_depth_left = std::max(0.0, path.air_depth_left - static_cast<double>(depth[0]));
}

bool VolumePath::scatter_in_air(Path& path, const media::AirCollision& collision, Sample& sample) const {
  ++sample.work.scatterings;
  const media::AirOptics& optics = *sample.air;
  const Vec3 position = path.ray.at(collision.distance_m);
  const Spectrum through = media::transmittance_over_first(collision.optical_depth);
  // By gas or by a mode of haze, as the first wavelength meets them.
  const auto meets = [&](const Spectrum& extinction_per_m, const Spectrum& scattering_per_m) {
    path.weight *= through * scattering_per_m / extinction_per_m[0];
    path.density *= through * extinction_per_m / extinction_per_m[0];
  };
  const Spectrum gas = optics.gas_depth(collision.density);
  double left = optics.haze_modes == 0 ? 0 : sample.random.uniform_double() * optics.first_depth(collision.density) - static_cast<double>(gas[0]);
  if (optics.haze_modes == 0 || left < 0) {
    meets(gas, optics.molecular_scattering(collision.density));
    return turn(path, position, by_air, sample);
  }
  int mode = 0;
  const auto extinction_of = [&](int m) { return optics.mode_ratio[static_cast<std::size_t>(m)] * static_cast<float>(collision.density.haze_depth_550); };
  while (mode + 1 < optics.haze_modes && left >= static_cast<double>(extinction_of(mode)[0])) left -= static_cast<double>(extinction_of(mode++)[0]);
  meets(extinction_of(mode), extinction_of(mode) * scene_.haze->albedo(mode, sample.wavelengths));
  return turn(path, position, scene_.haze->phase_function(mode), sample);
}

}  // namespace arcus::render
