#include "src/analysis/rings.h"

#include <algorithm>
#include <cmath>

#include "phase/base/error.h"
#include "phase/base/units.h"
#include "phase/settings/number_text.h"

namespace arcus::render {
namespace {

double modulo_360(double angle_deg) {
  const double rest = std::fmod(angle_deg, 360);
  return rest < 0 ? rest + 360 : rest;
}

}  // namespace

PositionAngle::PositionAngle(const Vec3& centre) : up_(0, 1, 0), right_(1, 0, 0) {
  if (std::hypot(centre.x, centre.y) < 1e-9) return;
  right_ = normalize(cross(centre, Vec3(0, 0, 1)));
  up_ = cross(right_, centre);
}

double PositionAngle::operator()(const Vec3& direction) const {
  return modulo_360(degrees(std::atan2(dot(direction, right_), dot(direction, up_))));
}

Rings::Rings(const Vec3& centre, double from_deg, double to_deg, double bin_deg,
             double sector_from_deg, double sector_to_deg)
    : centre_(centre),
      position_angle_(centre),
      from_deg_(from_deg),
      to_deg_(to_deg),
      bin_deg_(bin_deg),
      sector_from_deg_(modulo_360(sector_from_deg)),
      sector_width_deg_(modulo_360(sector_to_deg - sector_from_deg)) {
  if (!(from_deg < to_deg) || !(bin_deg > 0) || !std::isfinite(to_deg - from_deg))
    throw bad_input("profile",
                    "angles from " + number_text(from_deg) + " to " + number_text(to_deg) +
                        " in bins of " + number_text(bin_deg) + " degrees",
                    "an ascending range and a positive width expected");
  const double count = std::ceil((to_deg - from_deg) / bin_deg - 1e-9);
  if (count > 1e6)
    throw bad_input("profile", "bins of " + number_text(bin_deg) + " degrees",
                    "at most a million bins expected");
  count_ = static_cast<std::size_t>(count);
}

std::optional<std::size_t> Rings::ring_of(const Vec3& direction) const {
  const double angle_deg = degrees(angle_between_rad(direction, centre_));
  // The end belongs to the last ring, so that a profile up to 180 degrees is complete.
  if (angle_deg < from_deg_ || angle_deg > to_deg_) return std::nullopt;
  if (is_sector() && modulo_360(position_angle_(direction) - sector_from_deg_) > sector_width_deg_)
    return std::nullopt;
  return std::min(static_cast<std::size_t>((angle_deg - from_deg_) / bin_deg_), count_ - 1);
}

}  // namespace arcus::render
