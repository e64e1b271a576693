#include "src/material/matte.h"

namespace arcus::render {

void list_keys(Keys& keys, MaterialSettings& material) {
  keys.choice("type", material.type, {"matte"}, "how the surface reflects");
  keys.number("albedo", material.albedo, between(0, 1), "share of the light that is reflected");
}

}  // namespace arcus::render
