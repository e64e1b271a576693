#include "phase/crystal/orientations.h"

#include <cmath>

#include "phase/base/error.h"
#include "phase/base/units.h"
#include "phase/settings/number_text.h"

namespace arcus::phase {
namespace {

/// K. Shoemake, "Uniform Random Rotations", Graphics Gems III (1992): a unit quaternion uniform on
/// its sphere.
Orientation any_rotation(Random& random) {
  const double u = random.uniform_double();
  const double a = 2 * pi * random.uniform_double(), b = 2 * pi * random.uniform_double();
  const double r = std::sqrt(1 - u), s = std::sqrt(u);
  const double x = r * std::sin(a), y = r * std::cos(a), z = s * std::sin(b), w = s * std::cos(b);
  return {{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
          {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
          {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)}};
}

/// `from` turned by the angle towards `to`, both unit and at right angles.
Vec3 between_axes(const Vec3& from, const Vec3& to, double angle_rad) {
  return from * std::cos(angle_rad) + to * std::sin(angle_rad);
}

/// Turned about its own c axis.
Orientation rolled(const Orientation& o, double angle_rad) {
  return {between_axes(o.x, o.y, angle_rad), between_axes(o.y, -o.x, angle_rad), o.c};
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
  const double u = random.uniform_double();
  if (!gaussian_) return width_rad * (2 * u - 1);
  // Box and Muller; 1 - u is never 0.
  return width_rad * std::sqrt(-2 * std::log(1 - u)) * std::cos(2 * pi * random.uniform_double());
}

Orientation Orientations::draw(Random& random) const {
  if (kind_ == Kind::random) return any_rotation(random);
  const double azimuth = 2 * pi * random.uniform_double();
  const Vec3 ahead(std::cos(azimuth), std::sin(azimuth), 0), left(-ahead.y, ahead.x, 0),
      up(0, 0, 1);
  const double tilt = angle_rad(tilt_rad_, random);
  if (kind_ == Kind::plate) {
    const Orientation upright{between_axes(ahead, -up, tilt), left, between_axes(up, ahead, tilt)};
    return rolled(upright, 2 * pi * random.uniform_double());
  }
  const Vec3 axis = between_axes(ahead, up, tilt), top = between_axes(up, -ahead, tilt);
  if (kind_ == Kind::lowitz) {
    const double roll =
        roll_rad_ >= pi ? 2 * pi * random.uniform_double() : angle_rad(roll_rad_, random);
    // c turns about the diagonal; the diagonal lies 30 deg from x, between faces 3 and 4.
    const Vec3 c = between_axes(top, left, roll);
    return rolled({axis, cross(c, axis), c}, -pi / 6);
  }
  const double roll =
      kind_ == Kind::parry ? angle_rad(roll_rad_, random) : 2 * pi * random.uniform_double();
  return rolled({top, cross(axis, top), axis}, roll);
}

}  // namespace arcus::phase
