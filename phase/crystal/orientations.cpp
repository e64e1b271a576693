#include "phase/crystal/orientations.h"

#include <cmath>

#include "phase/base/error.h"
#include "phase/base/turn.h"
#include "phase/base/units.h"
#include "phase/settings/number_text.h"

namespace arcus::phase {
namespace {

using Angle = SineCosine;

Angle angle_of(double rad) {
  const double turns = rad * (0.5 / pi);
  return sine_and_cosine_of_turn(turns - std::floor(turns));
}

/// Uniform in [0, 1), 32 bits: one number of the stream where a double takes two.
double any(Random& random) { return random.bits() * 0x1p-32; }
Angle any_angle(Random& random) { return sine_and_cosine_of_turn(any(random)); }

/// `from` turned by the angle towards `to`, both unit and at right angles.
Vec3 between_axes(const Vec3& from, const Vec3& to, const Angle& angle) {
  return from * angle.cosine + to * angle.sine;
}

/// Turned about its own c axis.
Orientation rolled(const Orientation& o, const Angle& angle) {
  return {between_axes(o.x, o.y, angle), between_axes(o.y, -o.x, angle), o.c};
}

/// K. Shoemake, "Uniform Random Rotations", Graphics Gems III (1992): a unit quaternion uniform on
/// its sphere.
Orientation any_rotation(Random& random) {
  const double u = any(random), r = std::sqrt(1 - u), s = std::sqrt(u);
  const Angle a = any_angle(random), b = any_angle(random);
  const double x = r * a.sine, y = r * a.cosine, z = s * b.sine, w = s * b.cosine;
  return {{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
          {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
          {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)}};
}

}  // namespace

void list_keys(Keys& keys, OrientationSettings& orientation) {
  keys.choice("type", orientation.type, {"random", "plate", "column", "parry", "lowitz"},
              "how the crystals lie");
  if (keys.only_if(orientation.type != "random", "type is not random")) {
    keys.number("tilt_deg", orientation.tilt_deg, at_least(0),
                "of the axis that is vertical or horizontal: standard deviation, or largest value");
    keys.choice("spread", orientation.spread, {"gaussian", "uniform"}, "how the angles vary");
  }
  if (keys.only_if(orientation.type == "parry" || orientation.type == "lowitz",
                   "type = parry or lowitz"))
    keys.number("roll_deg", orientation.roll_deg, at_least(0),
                "parry: about the long axis; lowitz: about the diagonal, all from 180 on");
}

Orientations::Orientations(const OrientationSettings& settings)
    : tilt_rad_(radians(settings.tilt_deg)), roll_rad_(radians(settings.roll_deg)) {
  const auto& type = settings.type;
  if (type == "random")
    kind_ = Kind::random;
  else if (type == "plate")
    kind_ = Kind::plate;
  else if (type == "column")
    kind_ = Kind::column;
  else if (type == "parry")
    kind_ = Kind::parry;
  else if (type == "lowitz")
    kind_ = Kind::lowitz;
  else
    throw bad_input("orientation type", type, "must be random, plate, column, parry or lowitz");
  if (settings.spread != "gaussian" && settings.spread != "uniform")
    throw bad_input("orientation spread", settings.spread, "must be gaussian or uniform");
  gaussian_ = settings.spread == "gaussian";
  for (const double width : {settings.tilt_deg, settings.roll_deg})
    if (!(width >= 0) || !std::isfinite(width))
      throw bad_input("tilt_deg or roll_deg", number_text(width), "must be at least 0");
}

double Orientations::angle_rad(double width_rad, Random& random) const {
  if (width_rad == 0) return 0;
  const double u = any(random);
  if (!gaussian_) return width_rad * (2 * u - 1);
  // Box and Muller; 1 - u is never 0.
  return width_rad * std::sqrt(-2 * std::log(1 - u)) * any_angle(random).cosine;
}

Orientation Orientations::draw(Random& random) const {
  if (kind_ == Kind::random) return any_rotation(random);
  const Angle azimuth = any_angle(random);
  const Vec3 ahead(azimuth.cosine, azimuth.sine, 0), left(-ahead.y, ahead.x, 0), up(0, 0, 1);
  const Angle tilt = angle_of(angle_rad(tilt_rad_, random));
  if (kind_ == Kind::plate) {
    const Orientation upright{between_axes(ahead, -up, tilt), left, between_axes(up, ahead, tilt)};
    return rolled(upright, any_angle(random));
  }
  const Vec3 axis = between_axes(ahead, up, tilt), top = between_axes(up, -ahead, tilt);
  if (kind_ == Kind::lowitz) {
    const Angle roll = roll_rad_ >= pi ? any_angle(random) : angle_of(angle_rad(roll_rad_, random));
    // c turns about the diagonal; the diagonal lies 30 deg from x, between faces 3 and 4.
    const Vec3 c = between_axes(top, left, roll);
    return rolled({axis, cross(c, axis), c}, angle_of(-pi / 6));
  }
  const Angle roll =
      kind_ == Kind::parry ? angle_of(angle_rad(roll_rad_, random)) : any_angle(random);
  return rolled({top, cross(axis, top), axis}, roll);
}

}  // namespace arcus::phase
