#pragma once
// Affine maps between coordinate systems: scale, rotation, shear, mirror, translation.

#include <array>
#include <cmath>

#include "media/space/box.h"
#include "phase/base/units.h"
#include "phase/base/vec3.h"

namespace arcus::media {

/// p ↦ x·p.x + y·p.y + z·p.z + origin: x, y, z are the images of the axes.
struct Affine {
  Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  Vec3 origin{0, 0, 0};

  Vec3 point(const Vec3& p) const { return x * p.x + y * p.y + z * p.z + origin; }
  /// Of a difference of points: without the translation.
  Vec3 vector(const Vec3& v) const { return x * v.x + y * v.y + z * v.z; }
  /// Signed volume of the image of the unit cube; negative where the map mirrors.
  double determinant() const { return dot(x, cross(y, z)); }

  static Affine translation(const Vec3& by) { return {.origin = by}; }
  static Affine scaling(const Vec3& by) { return {{by.x, 0, 0}, {0, by.y, 0}, {0, 0, by.z}, {0, 0, 0}}; }
  /// Right-handed turns about the fixed axes x, then y, then z [degrees].
  static Affine rotation_deg(const Vec3& about);

  /// The map that undoes this one; its determinant must not be 0.
  Affine inverse() const {
    const double d = 1 / determinant();
    const Vec3 u = cross(y, z) * d, v = cross(z, x) * d, w = cross(x, y) * d;  // rows of the inverse
    Affine result{{u.x, v.x, w.x}, {u.y, v.y, w.y}, {u.z, v.z, w.z}, {0, 0, 0}};
    result.origin = result.vector(origin) * -1;
    return result;
  }
  /// First `inner`, then `outer`.
  friend Affine operator*(const Affine& outer, const Affine& inner) {
    return {outer.vector(inner.x), outer.vector(inner.y), outer.vector(inner.z), outer.point(inner.origin)};
  }
};

inline Affine Affine::rotation_deg(const Vec3& about) {
  const auto turn = [](double degrees, int axis) {
    const double c = std::cos(radians(degrees)), s = std::sin(radians(degrees));
    if (axis == 0) return Affine{{1, 0, 0}, {0, c, s}, {0, -s, c}, {0, 0, 0}};
    if (axis == 1) return Affine{{c, 0, -s}, {0, 1, 0}, {s, 0, c}, {0, 0, 0}};
    return Affine{{c, s, 0}, {-s, c, 0}, {0, 0, 1}, {0, 0, 0}};
  };
  return turn(about.z, 2) * (turn(about.y, 1) * turn(about.x, 0));
}

/// The smallest axis-aligned box around the image of a box.
inline Box bounds_of(const Affine& map, const Box& box) {
  Box result;
  if (box.is_empty()) return result;
  for (int i = 0; i < 8; ++i) result.include(map.point(box.corner(i)));
  return result;
}

}  // namespace arcus::media
