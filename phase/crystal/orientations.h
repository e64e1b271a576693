#pragma once
// How falling crystals lie in the air. W. Tape, Atmospheric Halos (1994), chapters 1 and 4: flat
// crystals keep their c axis vertical, long ones horizontal, and wobble.

#include <string>
#include <variant>

#include "phase/base/random.h"
#include "phase/base/vec3.h"
#include "phase/settings/keys.h"

namespace arcus::phase {

/// A crystal's axes in the world (z up): a right-handed rotation. c is the crystal's z axis, x the
/// normal of its prism face 3 (crystal_habit.h).
struct Orientation {
  Vec3 x{1, 0, 0}, y{0, 1, 0}, c{0, 0, 1};

  Vec3 to_world(const Vec3& v) const { return x * v.x + y * v.y + c * v.z; }
  Vec3 to_crystal(const Vec3& v) const { return {dot(x, v), dot(y, v), dot(c, v)}; }
};

struct OrientationSettings {
  std::string type = "random";      ///< random | plate | column | parry | lowitz
  double tilt_deg = 1;              ///< standard deviation (gaussian) or largest value (uniform)
  std::string spread = "gaussian";  ///< gaussian | uniform: how all angles of tilt and roll vary
  double roll_deg =
      1;  ///< parry: of the roll about c; lowitz: about the diagonal, 180 or more: all
};
void list_keys(Keys&, OrientationSettings&);

/// A distribution of orientations. None prefers an azimuth: the crystals as a whole look the same
/// from all sides.
///
/// - random: all rotations alike.
/// - plate: the c axis is tilted from the vertical by |t|, t drawn from the spread; any roll about
/// c.
/// - column: the c axis is t above the horizon; any roll about c.
/// - parry: as column, but face 3 lies on top, rolled by r.
/// - lowitz: a diagonal through two opposite side edges of the base is t above the horizon, and the
/// crystal is rolled
///   about it by r from where c is as near the vertical as it can be.
class Orientations {
 public:
  /// Throws bad_input: unknown words, widths that are negative or not finite.
  explicit Orientations(const OrientationSettings& settings);

  Orientation draw(Random& random) const;
  /// True where the mean over the orientations depends on no direction.
  bool isotropic() const { return kind_ == Kind::random; }

  enum class Kind { random, plate, column, parry, lowitz };
  Kind kind() const { return kind_; }
  bool gaussian() const { return gaussian_; }
  double tilt_rad() const { return tilt_rad_; }
  double roll_rad() const { return roll_rad_; }

 private:
  double angle_rad(double width_rad, Random& random) const;

  Kind kind_;
  bool gaussian_;
  double tilt_rad_, roll_rad_;
};

}  // namespace arcus::phase
