#pragma once
// Which rays of a large sphere are left to geometry and which are summed as partial waves. Near
// grazing incidence (the edge) geometry fails; the window is 1 there and falls smoothly to 0, so
// slowly that a ray of light, which is as wide as its Fresnel zone, does not feel it.

#include "phase/particle/drop_rays.h"

namespace arcus::phase {

/// From this order on powers of waves and rays are added, not amplitudes: too weak for their
/// fringes to show.
inline constexpr int first_weak_order = 4;

/// Share of the partial waves at one angle of incidence; rays get the rest.
struct EdgeWindow {
  double centre_rad = 0, width_rad = 1;  ///< the share is erfc((centre - incidence) / width) / 2
  bool bow_inside = false;               ///< the bow's rays lie where the share is 1
  bool everything = false;  ///< no rays at all: the sphere is too small to tell them apart

  struct Share {
    double value, slope, curvature;  ///< by the angle of incidence
  };
  Share at(double incidence_rad) const;
  double value_at(double incidence_rad) const;
  /// Below this incidence the share is less than 1e-5.
  double begin_rad() const;
  /// Above this distance from the axis, in radii, the share is 1 within 1e-5.
  double whole_from_sine = 1;
};

/// The window for an order of rays in a sphere of this size.
EdgeWindow edge_window(const RaysOfOrder& rays, double n, double size_parameter);

}  // namespace arcus::phase
