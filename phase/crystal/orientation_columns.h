#pragma once
// Hundreds of orientations at once, in single precision and by columns, as the packets of rays read them.

#include "phase/base/random_columns.h"
#include "phase/crystal/orientations.h"

namespace arcus::phase {

/// Rays that are handled together.
inline constexpr int column_rays = 256;

struct Column {
  alignas(64) float values[column_rays];
  float& operator[](int ray) { return values[ray]; }
  const float& operator[](int ray) const { return values[ray]; }
};
struct VectorColumns {
  Column x, y, z;
};

/// As Orientation, [ray].
struct OrientationColumns {
  VectorColumns x, y, c;

  void to_world(const VectorColumns& crystal, VectorColumns& world) const;
  void to_crystal(const VectorColumns& world, VectorColumns& crystal) const;
};

/// Draws as Orientations::draw does, with other numbers.
void draw_orientations(const Orientations& orientations, RandomColumns& random, OrientationColumns& lies);

}  // namespace arcus::phase
