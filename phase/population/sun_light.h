#pragma once
// Light of the sun's or the moon's disc by the hundred: directions drawn with the brightness of its places.

#include <array>

#include "phase/base/vec3.h"
#include "phase/crystal/orientation_columns.h"
#include "phase/optics/sun_disc.h"

namespace arcus::phase {

class SunLight {
 public:
  /// The disc's centre lies above x, z is up. An angular radius of 0 makes all light parallel.
  SunLight(double elevation_deg, double angular_radius_deg, double wavelength_nm, DiscKind disc = DiscKind::limb_darkened);

  /// Directions in which the light travels.
  void draw(RandomColumns& random, VectorColumns& light) const;
  Vec3 centre() const { return centre_; }  ///< towards the sun

 private:
  static constexpr int nodes = 1024;
  Vec3 centre_, above_;
  float sin2_half_radius_ = 0;
  std::array<float, nodes + 2> square_;  ///< of the distance from the centre over the radius, by the share of light within
};

}  // namespace arcus::phase
