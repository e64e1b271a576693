#include "src/material/smooth_turns.h"

#include <algorithm>
#include <cmath>

namespace arcus::render {
namespace {

/// Unit vector across the plane of incidence; where light arrives straight on, any across it.
Vec3 across(const Vec3& incoming, const Vec3& normal, const PolarisedRay& light) {
  const Vec3 s = cross(incoming, normal);
  const double length2 = squared_length(s);
  if (length2 > 0) return s * (1 / std::sqrt(length2));
  return light.is_natural() ? frame_around(incoming).side : light.perpendicular;
}

/// Keeps the power apart from the kind of polarisation.
Turn with_power(const Vec3& direction, const phase::Stokes& light, const Vec3& perpendicular) {
  if (!(light.i > 0)) return {};
  return {direction, Spectrum::filled(static_cast<float>(light.i)), {light * (1 / light.i), perpendicular}};
}

}  // namespace

Vec3 refracted(const Vec3& incoming, const Vec3& normal, double relative_index) {
  const double cosine = std::min(1.0, -dot(incoming, normal));
  const double sin2 = squared_length(incoming + normal * cosine) / (relative_index * relative_index);
  return normalize((incoming + normal * cosine) * (1 / relative_index) - normal * std::sqrt(std::max(0.0, 1 - sin2)));
}

Turns fresnel_turns(const Vec3& incoming, const Vec3& normal, double relative_index, const PolarisedRay& light) {
  const double cosine = std::clamp(-dot(incoming, normal), 0.0, 1.0);
  const auto matrix = phase::interface_matrix(cosine, relative_index);
  const Vec3 perpendicular = across(incoming, normal, light);
  const phase::Stokes stokes = light.about(incoming, perpendicular);
  Turns turns;
  turns.reflected = with_power(mirrored(incoming, normal), matrix.reflected(stokes), perpendicular);
  if (!matrix.total()) turns.transmitted = with_power(refracted(incoming, normal, relative_index), matrix.transmitted(stokes), perpendicular);
  return turns;
}

Turns mirror_turns(const Vec3& incoming, const Vec3& normal, const Spectrum& reflectance, const PolarisedRay& light) {
  phase::InterfaceMatrix conductor;
  conductor.c = -1;
  const Vec3 perpendicular = across(incoming, normal, light);
  Turns turns;
  turns.reflected = with_power(mirrored(incoming, normal), conductor.reflected(light.about(incoming, perpendicular)), perpendicular);
  turns.reflected.share = reflectance;
  return turns;
}

Turns transparent_turns(const Vec3& incoming, const Vec3& normal, double relative_index, double reflectance, double transmittance) {
  const double cosine = std::clamp(-dot(incoming, normal), 0.0, 1.0);
  const bool is_total = 1 - cosine * cosine >= relative_index * relative_index;
  Turns turns;
  turns.reflected = {mirrored(incoming, normal), Spectrum::filled(static_cast<float>(is_total ? 1 : reflectance)), {}};
  if (!is_total)
    turns.transmitted = {refracted(incoming, normal, relative_index), Spectrum::filled(static_cast<float>(transmittance)), {}};
  return turns;
}

}  // namespace arcus::render
