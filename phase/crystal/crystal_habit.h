#pragma once
// Shapes that ice grows into: hexagonal prisms, regular or not, with or without pyramids on their
// ends. W. Tape, Atmospheric Halos (1994); W. Tape and J. Moilanen, Atmospheric Halos and the
// Search for Angle x (2006).
//
// Axes of a crystal: z is its c axis; the normal of prism face 3 is x. Numbers of faces: 1 the
// upper and 2 the lower basal face, 3 ... 8 the prism counterclockwise seen from above, 13 ... 18
// the upper pyramid above 3 ... 8, 23 ... 28 the lower pyramid below them.

#include <array>

#include "phase/crystal/crystal_shape.h"
#include "phase/settings/keys.h"

namespace arcus::phase {

/// Height of ice's unit cell over its width, c / a.
inline constexpr double ice_axial_ratio = 1.629;

/// A pyramid on one end of the prism, with the faces {h 0 -h l}.
struct PyramidSettings {
  double height =
      0;  ///< over that of the whole pyramid: 0 none ... 1 up to its tip; between: truncated
  long long h = 1,
            l = 1;  ///< Miller indices; 1, 1 are the faces usually seen, 28.0 deg from the c axis
};
void list_keys(Keys&, PyramidSettings&);

struct HabitSettings {
  /// Length of the prism between its pyramids over the diameter of the regular hexagon of its base
  /// (corner to corner); 0 only with pyramids on both ends (a bipyramid).
  double aspect_ratio = 1;
  /// Distances of the six prism faces 3 ... 8 from the axis over that of the regular hexagon, above
  /// 0. {1, t, 1, t, 1, t} is a truncated triangle for t between 1 and 2 and a triangle from 2 on.
  std::array<double, 6> side_distances = {1, 1, 1, 1, 1, 1};
  PyramidSettings upper, lower;
};
void list_keys(Keys&, HabitSettings&);

/// Angle between a face {h 0 -h l} and the c axis [rad]; 0 for the prism (l = 0).
double angle_from_c_axis_rad(long long h, long long l);

/// The crystal with its longest dimension [um]. Aspect ratios of 1e-5 ... 1e5. Throws bad_input
/// that names the key for values that make no crystal.
CrystalShape make_crystal(const HabitSettings& habit, double maximum_dimension_um);

}  // namespace arcus::phase
