#pragma once
// How deep in the medium places lie, as the sun sees them: coarse, made once a scene, to decide where asking the sun is worth
// a ray. It steers probabilities and never enters a result.

#include <vector>

#include "media/medium/medium.h"
#include "media/space/box.h"
#include "phase/base/vec3.h"

namespace arcus::render {

class SunReach {
 public:
  /// Takes about a tenth of a second on two cores, whatever the medium. to_sun: unit vector.
  SunReach(const media::Medium& medium, const Vec3& to_sun);

  /// Optical depth at 550 nm from a point to where the medium ends towards the sun, roughly; 0 outside the medium's bounds.
  float optical_depth(const Vec3& position_m) const;

 private:
  static constexpr int cells = 40;         // along each edge of the bounds
  static constexpr int nodes = cells + 1;
  static std::size_t node(int x, int y, int z) { return (static_cast<std::size_t>(x) * nodes + static_cast<std::size_t>(y)) * nodes + static_cast<std::size_t>(z); }

  media::Box bounds_m_;
  Vec3 cells_per_m_{0, 0, 0};
  std::vector<float> depth_;  // [x][y][z] at the nodes
};

}  // namespace arcus::render
