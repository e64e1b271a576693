#pragma once
// Explicit drops drawn from a medium: as many of each size, and where, as its grids say.

#include <string>
#include <vector>

#include "media/medium/component.h"
#include "phase/population/sizes.h"
#include "src/shape/droplets.h"

namespace arcus::render {

/// A kind of drops, and where they are.
struct DropSource {
  media::Component component;            ///< needs no species
  phase::SizesSettings distribution;
  std::vector<double> size_um;           ///< size nodes of the recipe
  std::vector<double> cross_section_m2;  ///< [node] mean extinction cross-section at 550 nm: phase/species/species.h
};

struct DrawnDrops {
  PieceGroup group;
  double number_meant = 0;  ///< of drops in the medium
  /// Each drop stands for number_meant / count of them: it is the root of that larger, so that all have the medium's cross-section.
  double enlargement = 1;
};

/// Draws `count` drops. The number density in a voxel is its extinction at 550 nm over a drop's mean cross-section, diffraction included,
/// as the recipe's table has it; between voxels it is interpolated as the medium's extinction is. Radii follow the recipe's population of
/// the voxel's size. Throws bad_input, naming `where`: nothing that scatters, drops without room.
DrawnDrops drops_from_medium(const std::vector<DropSource>& sources, long long count, long long seed, const std::string& where);

}  // namespace arcus::render
