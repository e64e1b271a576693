#pragma once
// A homogeneous block: the medium whose answers are known. Wide enough, it stands for an endless layer.

#include <string>

#include "media/grid/new_grid.h"
#include "phase/settings/keys.h"
#include "phase/species/recipe.h"

namespace arcus::media {

struct BoxSettings {
  std::string name = "cloud";       ///< of the species
  Vec3 centre_m{0, 0, 500};
  Vec3 size_m{1000, 1000, 1000};
  double extinction_per_m = 0.001;  ///< at 550 nm, diffraction included
  double optical_depth = 0;         ///< along z, at 550 nm; above 0 it decides the extinction
  std::vector<double> voxels{8, 8, 8};  ///< along x, y and z; one number: along the shortest edge, cubes
  double size_um = 10;              ///< of all particles
  std::string phase_file;           ///< recipe of the phase functions: a file ...
  phase::Recipe phase;              ///< ... or its keys
};
void list_keys(Keys& keys, BoxSettings& box);

/// Makes the block: its voxels fill it exactly, so that across the block the optical depth is the extinction times the
/// edge however it is interpolated. `folder`: recipe files are relative to it. Throws bad_input.
NewSpecies author_box(const BoxSettings& settings, const std::string& folder);

}  // namespace arcus::media
