#pragma once
// A crystal as the packets read it: single precision, opposite faces together, faces in triangles.

#include <cstdint>
#include <vector>

#include "phase/crystal/crystal_shape.h"

namespace arcus::phase {

/// Where a slab has no second face [unit of the shape].
inline constexpr float no_face = 1e30f;

// Opposite faces share their products with the normal: a pair is a slab of two half-spaces,
// normal.x <= plus and -normal.x <= minus.
struct CrystalTables {
  struct Slab {
    float nx, ny, nz, plus, minus, area_plus, area_minus;
    std::int32_t number_plus, number_minus;
  };
  struct Triangle {
    float corner[3], first[3], second[3];
    float share_up_to_here;  // of its face, 1 for the last one
  };
  std::vector<Slab> slabs;
  std::vector<Triangle> triangles;
  std::vector<int> first_triangle;  // of the plus and the minus face of every slab

  explicit CrystalTables(const CrystalShape& shape);

 private:
  void add_fan(const CrystalFace* face);
};

}  // namespace arcus::phase
