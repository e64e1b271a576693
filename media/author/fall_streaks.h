#pragma once
// The way of crystals that fall out of a generating cell through wind that changes with height. J. S. Marshall, J. Meteorol. 10, 25 (1953).

#include <functional>
#include <vector>

#include "phase/base/vec3.h"

namespace arcus::media {

struct WindShear {
  double per_s = 0;              ///< how fast the wind relative to the cell grows with depth below it
  double azimuth_deg = 0;        ///< compass direction towards which it blows, just below
  double turn_deg = 0;           ///< by which it has turned clockwise at the full depth
};

class FallStreaks {
 public:
  /// fall_speed_m_per_s: at a depth below the cell, above 0. depth_m: the largest depth.
  FallStreaks(const WindShear& shear, double depth_m, const std::function<double(double)>& fall_speed_m_per_s);

  /// How far crystals are from below their cell, at a depth from 0 to the largest [m]: the integral of wind over fall speed. z is 0.
  Vec3 drift_m(double depth_m) const;
  /// How long ago they left it.
  double time_s(double depth_m) const;

 private:
  struct Node {
    Vec3 drift_m;
    double time_s = 0;
  };
  double step_m_;
  std::vector<Node> nodes_;  // even steps of depth
};

}  // namespace arcus::media
