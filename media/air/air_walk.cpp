#include "media/air/air_walk.h"

#include <algorithm>
#include <cmath>

#include "phase/optics/air.h"

namespace arcus::media {

AirOptics::AirOptics(const Wavelengths& wavelengths, const Haze* haze) {
  for (int j = 0; j < wavelength_count; ++j) {
    scattering_m2[j] = phase::air_scattering_cross_section_m2(wavelengths[j]);
    ozone_m2[j] = phase::ozone_absorption_cross_section_m2(wavelengths[j]);
  }
  if (!haze) return;
  haze_modes = haze->mode_count();
  for (int mode = 0; mode < haze_modes; ++mode) haze_ratio += mode_ratio[static_cast<std::size_t>(mode)] = haze->extinction_ratio(mode, wavelengths);
}

Spectrum AirOptics::optical_depth(const AirColumns& columns) const {
  return gas_depth(columns) + haze_ratio * static_cast<float>(columns.haze_depth_550);
}

Spectrum AirOptics::gas_depth(const AirColumns& columns) const {
  Spectrum depth;
  for (int j = 0; j < wavelength_count; ++j) depth[j] = static_cast<float>(columns.molecules_per_m2 * scattering_m2[j] + columns.ozone_per_m2 * ozone_m2[j]);
  return depth;
}

Spectrum AirOptics::molecular_scattering(const AirColumns& columns) const {
  Spectrum depth;
  for (int j = 0; j < wavelength_count; ++j) depth[j] = static_cast<float>(columns.molecules_per_m2 * scattering_m2[j]);
  return depth;
}

AirOptics AirOptics::with_first(int j) const {
  AirOptics result = *this;
  std::swap(result.scattering_m2[0], result.scattering_m2[j]);
  std::swap(result.ozone_m2[0], result.ozone_m2[j]);
  for (Spectrum& ratio : result.mode_ratio) std::swap(ratio[0], ratio[j]);
  std::swap(result.haze_ratio[0], result.haze_ratio[j]);
  return result;
}

Spectrum transmittance(const Spectrum& optical_depth) {
  Spectrum result;
  for (int j = 0; j < wavelength_count; ++j) result[j] = std::exp(-optical_depth[j]);
  return result;
}

Spectrum transmittance_over_first(const Spectrum& optical_depth) {
  Spectrum result;
  for (int j = 0; j < wavelength_count; ++j) result[j] = std::exp(optical_depth[0] - optical_depth[j]);
  return result;
}

std::optional<AirCollision> air_collision_at(const Atmosphere& air, const Ray& ray, const AirOptics& optics, double depth) {
  const Ray stretch = air.clipped(ray);
  if (!(stretch.nearest_m < stretch.farthest_m)) return std::nullopt;
  if (!(optics.first_depth(air.columns(stretch)) > depth)) return std::nullopt;

  // Newton's method, held between bounds: the depth grows evenly, and its slope is known. Columns are summed from the lower bound on.
  Ray part = stretch;
  AirColumns passed;  // up to the lower bound
  double low = stretch.nearest_m, high = stretch.farthest_m, at = low;
  AirColumns until;
  constexpr int most_steps = 60;
  for (int step = 0; step < most_steps; ++step) {
    const double missing = depth - optics.first_depth(until);
    const double slope = optics.first_depth(air.density(air.height_m(ray.at(at))));
    (missing > 0 ? low : high) = at;
    if (missing > 0) passed = until;
    if (std::fabs(missing) < 1e-9 * depth || high - low < 1e-6) break;
    const double next = slope > 0 ? at + missing / slope : low;
    at = next > low && next < high ? next : 0.5 * (low + high);
    part.nearest_m = low;
    part.farthest_m = at;
    until = passed;
    until += air.columns(part);
  }
  const AirColumns here = air.density(air.height_m(ray.at(at)));
  return AirCollision{at, optics.optical_depth(until), here};
}

}  // namespace arcus::media
