// The formulas are those of orientations.cpp; loops without branches, which compilers turn into vectors.
#include "phase/crystal/orientation_columns.h"

#include "phase/base/quick_math.h"
#include "phase/base/units.h"

namespace arcus::phase {
namespace {

/// Sine and cosine by columns.
struct Angles {
  Column sine, cosine;
};

void any_angle(RandomColumns& random, Angles& angles) {
  Column turn;
  random.uniform(turn.values, column_rays);
  for (int i = 0; i < column_rays; ++i) {
    const QuickSineCosine a = quick_sine_and_cosine_of_turn(turn[i]);
    angles.sine[i] = a.sine;
    angles.cosine[i] = a.cosine;
  }
}

/// Normal or uniform around 0, as Orientations::angle_rad.
void spread_angle(double width_rad, bool gaussian, RandomColumns& random, Angles& angles) {
  const auto width = static_cast<float>(width_rad);
  Column u;
  random.uniform(u.values, column_rays);
  if (gaussian) {
    Angles around;
    any_angle(random, around);
    for (int i = 0; i < column_rays; ++i)
      u[i] = std::sqrt(-2 * quick_logarithm(1 - u[i])) * around.cosine[i];
  } else {
    for (int i = 0; i < column_rays; ++i) u[i] = 2 * u[i] - 1;
  }
  for (int i = 0; i < column_rays; ++i) {
    float turns = u[i] * width * 0.159154943f;
    turns -= std::floor(turns);
    const QuickSineCosine a = quick_sine_and_cosine_of_turn(turns);
    angles.sine[i] = a.sine;
    angles.cosine[i] = a.cosine;
  }
}

void fill(Angles& angles, double rad) {
  for (int i = 0; i < column_rays; ++i) {
    angles.sine[i] = static_cast<float>(std::sin(rad));
    angles.cosine[i] = static_cast<float>(std::cos(rad));
  }
}

/// `from` turned by the angle towards `to`; sign -1 for the opposite of `to`.
void between_axes(const VectorColumns& from, const VectorColumns& to, float sign, const Angles& angle, VectorColumns& result) {
  for (int i = 0; i < column_rays; ++i) {
    const float c = angle.cosine[i], s = sign * angle.sine[i];
    result.x[i] = from.x[i] * c + to.x[i] * s;
    result.y[i] = from.y[i] * c + to.y[i] * s;
    result.z[i] = from.z[i] * c + to.z[i] * s;
  }
}

void roll(OrientationColumns& lies, const Angles& angle) {
  for (int i = 0; i < column_rays; ++i) {
    const float c = angle.cosine[i], s = angle.sine[i];
    const float xx = lies.x.x[i], xy = lies.x.y[i], xz = lies.x.z[i];
    const float yx = lies.y.x[i], yy = lies.y.y[i], yz = lies.y.z[i];
    lies.x.x[i] = xx * c + yx * s;
    lies.x.y[i] = xy * c + yy * s;
    lies.x.z[i] = xz * c + yz * s;
    lies.y.x[i] = yx * c - xx * s;
    lies.y.y[i] = yy * c - xy * s;
    lies.y.z[i] = yz * c - xz * s;
  }
}

void crossed(const VectorColumns& a, const VectorColumns& b, VectorColumns& result) {
  for (int i = 0; i < column_rays; ++i) {
    result.x[i] = a.y[i] * b.z[i] - a.z[i] * b.y[i];
    result.y[i] = a.z[i] * b.x[i] - a.x[i] * b.z[i];
    result.z[i] = a.x[i] * b.y[i] - a.y[i] * b.x[i];
  }
}

void any_rotation(RandomColumns& random, OrientationColumns& lies) {
  Column u;
  Angles a, b;
  random.uniform(u.values, column_rays);
  any_angle(random, a);
  any_angle(random, b);
  for (int i = 0; i < column_rays; ++i) {
    const float r = std::sqrt(1 - u[i]), s = std::sqrt(u[i]);
    const float x = r * a.sine[i], y = r * a.cosine[i], z = s * b.sine[i], w = s * b.cosine[i];
    lies.x.x[i] = 1 - 2 * (y * y + z * z);
    lies.x.y[i] = 2 * (x * y + w * z);
    lies.x.z[i] = 2 * (x * z - w * y);
    lies.y.x[i] = 2 * (x * y - w * z);
    lies.y.y[i] = 1 - 2 * (x * x + z * z);
    lies.y.z[i] = 2 * (y * z + w * x);
    lies.c.x[i] = 2 * (x * z + w * y);
    lies.c.y[i] = 2 * (y * z - w * x);
    lies.c.z[i] = 1 - 2 * (x * x + y * y);
  }
}

}  // namespace

void OrientationColumns::to_world(const VectorColumns& v, VectorColumns& world) const {
  for (int i = 0; i < column_rays; ++i) {
    world.x[i] = x.x[i] * v.x[i] + y.x[i] * v.y[i] + c.x[i] * v.z[i];
    world.y[i] = x.y[i] * v.x[i] + y.y[i] * v.y[i] + c.y[i] * v.z[i];
    world.z[i] = x.z[i] * v.x[i] + y.z[i] * v.y[i] + c.z[i] * v.z[i];
  }
}

void OrientationColumns::to_crystal(const VectorColumns& v, VectorColumns& crystal) const {
  for (int i = 0; i < column_rays; ++i) {
    crystal.x[i] = x.x[i] * v.x[i] + x.y[i] * v.y[i] + x.z[i] * v.z[i];
    crystal.y[i] = y.x[i] * v.x[i] + y.y[i] * v.y[i] + y.z[i] * v.z[i];
    crystal.z[i] = c.x[i] * v.x[i] + c.y[i] * v.y[i] + c.z[i] * v.z[i];
  }
}

void draw_orientations(const Orientations& o, RandomColumns& random, OrientationColumns& lies) {
  if (o.isotropic()) return any_rotation(random, lies);
  Angles azimuth, tilt, angle;
  any_angle(random, azimuth);
  spread_angle(o.tilt_rad(), o.gaussian(), random, tilt);
  VectorColumns ahead, left, up;
  for (int i = 0; i < column_rays; ++i) {
    ahead.x[i] = azimuth.cosine[i];
    ahead.y[i] = azimuth.sine[i];
    left.x[i] = -azimuth.sine[i];
    left.y[i] = azimuth.cosine[i];
    ahead.z[i] = left.z[i] = up.x[i] = up.y[i] = 0;
    up.z[i] = 1;
  }
  using Kind = Orientations::Kind;
  if (o.kind() == Kind::plate) {
    between_axes(ahead, up, -1, tilt, lies.x);
    lies.y = left;
    between_axes(up, ahead, 1, tilt, lies.c);
    any_angle(random, angle);
    return roll(lies, angle);
  }
  VectorColumns axis, top;
  between_axes(ahead, up, 1, tilt, axis);
  between_axes(up, ahead, -1, tilt, top);
  const bool any_roll = o.kind() == Kind::column || (o.kind() == Kind::lowitz && o.roll_rad() >= pi);
  if (any_roll)
    any_angle(random, angle);
  else
    spread_angle(o.roll_rad(), o.gaussian(), random, angle);
  if (o.kind() == Kind::lowitz) {
    lies.x = axis;
    between_axes(top, left, 1, angle, lies.c);
    crossed(lies.c, lies.x, lies.y);
    fill(angle, -pi / 6);
  } else {
    lies.x = top;
    lies.c = axis;
    crossed(lies.c, lies.x, lies.y);
  }
  roll(lies, angle);
}

}  // namespace arcus::phase
