#include "media/author/box.h"

#include "phase/base/error.h"
#include "phase/settings/number_text.h"
#include "phase/settings/toml_text.h"

namespace arcus::media {

void list_keys(Keys& keys, BoxSettings& box) {
  keys.text("species", box.species, "name of the species in the file");
  keys.vector3("centre_m", box.centre_m, "middle of the block");
  keys.vector3("size_m", box.size_m, "edges of the block");
  if (!(box.size_m.x > 0 && box.size_m.y > 0 && box.size_m.z > 0))
    keys.refuse("size_m", number_text(box.size_m.x) + ", " + number_text(box.size_m.y) + ", " + number_text(box.size_m.z),
                "each must be above 0");
  keys.number("extinction_per_m", box.extinction_per_m, above(0), "at 550 nm, diffraction included");
  keys.number("optical_depth", box.optical_depth, at_least(0), "through the height, at 550 nm; above 0: decides the extinction");
  keys.number("size_um", box.size_um, at_least(0), "of all particles; 0: the recipe's middle size node");
  keys.text("phase_file", box.phase_file, "recipe file of the phase functions");
  keys.table("phase", box.phase, "recipe of the phase functions, where there is no file");
}

NewSpecies author_box(const BoxSettings& settings, const std::string& folder) {
  const phase::Recipe recipe =
      settings.phase_file.empty() ? settings.phase : phase::recipe_from_file(path_from(folder, settings.phase_file));
  NewSpecies species;
  species.name = settings.species;
  species.recipe = text_of(recipe);
  species.phase_id = phase::recipe_id(recipe);
  species.size_um = static_cast<float>(settings.size_um);
  if (settings.size_um == 0)
    species.size_um = recipe.is_sphere() ? static_cast<float>(recipe.size_um[recipe.size_um.size() / 2]) : 1;
  species.world_from_index = Affine::translation(settings.centre_m) * Affine::scaling(settings.size_m);
  NewBrick brick{.origin = {0, 0, 0}, .values = {}};
  brick.values[0] = static_cast<float>(settings.optical_depth > 0 ? settings.optical_depth / settings.size_m.z
                                                                  : settings.extinction_per_m);
  species.extinction.push_back(brick);
  return species;
}

}  // namespace arcus::media
