#pragma once
// What meshes and terrain are made of.

#include "phase/base/vec3.h"

namespace arcus::render {

struct Triangle {
  Vec3 a_m, b_m, c_m;
};

}  // namespace arcus::render
