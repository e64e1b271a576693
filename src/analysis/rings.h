#pragma once
// Rings of equal width around a point of the sky, or a sector of them: which ring a direction lies
// in.

#include <optional>

#include "phase/base/vec3.h"

namespace arcus::render {

/// Position angle in [0, 360) of a direction about a centre (unit vectors): 0 points from the
/// centre to the zenith and 90 to the right, as seen by who faces the centre; about the zenith or
/// nadir it is the compass azimuth.
class PositionAngle {
 public:
  explicit PositionAngle(const Vec3& centre);
  double operator()(const Vec3& direction) const;

 private:
  Vec3 up_, right_;
};

class Rings {
 public:
  /// Rings of width bin_deg from from_deg to to_deg around a unit vector, between two position
  /// angles counted through increasing ones (equal modulo 360: all around).
  /// Throws bad_input for a range that does not ascend and for more than a million rings.
  Rings(const Vec3& centre, double from_deg, double to_deg, double bin_deg, double sector_from_deg,
        double sector_to_deg);

  std::size_t count() const { return count_; }
  bool is_sector() const { return sector_width_deg_ > 0; }
  double middle_deg(std::size_t ring) const {
    return from_deg_ + (static_cast<double>(ring) + 0.5) * bin_deg_;
  }
  /// The ring that a direction (unit vector) lies in; nothing outside.
  std::optional<std::size_t> ring_of(const Vec3& direction) const;

 private:
  Vec3 centre_;
  PositionAngle position_angle_;
  double from_deg_, to_deg_, bin_deg_, sector_from_deg_, sector_width_deg_;
  std::size_t count_ = 0;
};

}  // namespace arcus::render
