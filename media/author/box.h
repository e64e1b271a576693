#pragma once
// A homogeneous block: a layer to check against theory, a cube of fog, a jar of spray.

#include <string>

#include "media/grid/new_grid.h"
#include "phase/settings/keys.h"
#include "phase/species/recipe.h"

namespace arcus::media {

struct BoxSettings {
  std::string species = "box";
  Vec3 centre_m{0, 0, 0};
  Vec3 size_m{100, 100, 100};      ///< edges
  double extinction_per_m = 0.01;  ///< at 550 nm
  double optical_depth = 0;        ///< through the height; above 0: decides the extinction
  double size_um = 0;              ///< of all particles; 0: the recipe's middle size node
  std::string phase_file;          ///< a recipe file
  phase::Recipe phase = phase::default_recipe("isotropic");  ///< where there is no file
};
void list_keys(Keys& keys, BoxSettings& box);

/// One voxel stretched over the block; with nearest interpolation the block is exact. (With linear interpolation a
/// single voxel would be a pyramid: the scene asks for `interpolation = "nearest"`.) `folder`: where phase_file's path starts.
NewSpecies author_box(const BoxSettings& settings, const std::string& folder);

}  // namespace arcus::media
