#include "phase/species/crystal_recipe.h"

#include "phase/base/error.h"
#include "phase/settings/number_text.h"

namespace arcus::phase {

CrystalTableSettings crystal_settings_of(const Recipe& recipe) {
  CrystalTableSettings settings;
  settings.crystals = recipe.crystal;
  settings.size_um = recipe.size_um;
  settings.size_spread = recipe.size_spread;
  settings.diffraction = recipe.optics == "wave";
  settings.remove_forward = recipe.forward_lobe == "remove";
  settings.rays = recipe.rays();
  settings.map_step_deg = recipe.map_step_deg;
  settings.map_noise = recipe.map_noise;
  const RefractiveIndex material = refractive_index_of(recipe);
  for (const double nm : recipe.wavelength_nm) {
    const auto index = material.relative_to_air(nm);
    if (!(index.real() > 1))
      throw bad_input("material", "an index of " + number_text(index.real()) + " at " + number_text(nm) + " nm",
                      "crystals need an index above 1");
    settings.waves.push_back({nm, index.real(), absorption_per_um(index.imag(), nm)});
  }
  return settings;
}

}  // namespace arcus::phase
