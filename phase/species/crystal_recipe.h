#pragma once
// From a recipe of crystals to what their tables are made of.

#include "phase/population/tabulate_crystals.h"
#include "phase/species/recipe.h"

namespace arcus::phase {

/// recipe.is_crystal(). Throws bad_input where its material is no material for crystals: an index of 1 or less.
CrystalTableSettings crystal_settings_of(const Recipe& recipe);

}  // namespace arcus::phase
