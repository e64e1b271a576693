#pragma once
// Explicit drops: spheres one by one, for comparison with a medium.

#include <functional>
#include <string>
#include <vector>

#include "media/space/box.h"
#include "phase/population/sizes.h"
#include "phase/settings/keys.h"
#include "src/material/material.h"
#include "src/shape/pieces.h"

namespace arcus::render {

/// How the radii of drops are distributed.
struct DropRadiiSettings {
  DropRadiiSettings() { shape.type = "monodisperse"; }
  phase::SizesSettings shape;
  double effective = 500;  ///< effective radius [µm]
};
void list_keys(Keys& keys, DropRadiiSettings& radii);

struct DropletsSettings {
  DropletsSettings() { material.type = "dielectric"; }
  std::string name;
  std::string medium;            ///< name of the medium that they are drawn from; empty: the box and the radii count
  long long count = 1000;
  DropRadiiSettings radius_um;
  Vec3 low_m{-5, 20, 0}, high_m{5, 40, 10};  ///< the box
  double scale = 1;              ///< multiplies the radii, and divides the absorption
  MaterialSettings material;     ///< a body's keys alone; with a medium its recipe's index counts
  long long seed = 1;
};
void list_keys(Keys& keys, DropletsSettings& droplets);

/// Drops may not overlap: where one does with another of a smaller number, it is drawn anew.
struct DropDraw {
  Vec3 centre_m;
  double radius_m;
};
/// Draws `count` drops. `draw(i, attempt)` gives drop number i, another one at every attempt; it may be called from many threads. Throws
/// bad_input, naming `where`, if after a hundred attempts some still overlap: they fill too much of the space; cannot() without memory.
PieceGroup place_drops(std::size_t count, const std::function<DropDraw(std::size_t drop, unsigned attempt)>& draw, const std::string& where);

/// Evenly within the box; centres lie so that the whole drop does.
PieceGroup drops_in_box(const DropletsSettings& settings, const std::string& where);

}  // namespace arcus::render
