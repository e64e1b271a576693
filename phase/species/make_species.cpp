#include "phase/species/make_species.h"

#include <cmath>
#include <utility>

#include "phase/base/error.h"
#include "phase/base/units.h"
#include "phase/population/tabulate.h"
#include "phase/population/tabulate_crystals.h"
#include "phase/settings/toml_text.h"
#include "phase/species/crystal_recipe.h"
#include "phase/species/oriented_file.h"
#include "phase/species/species_cache.h"
#include "phase/species/table_file.h"

namespace arcus::phase {
namespace {

/// Air scatters as λ⁻⁴, but for the small dispersion of its index: Rayleigh's law.
constexpr double rayleigh_exponent = -4;

Population population_of(const Recipe& recipe) {
  const RefractiveIndex index = refractive_index_of(recipe);
  Population p;
  p.size_um = recipe.size_um;
  p.distribution = recipe.distribution;
  p.wavelength_nm = recipe.wavelength_nm;
  p.index_at = [index](double nm) { return index.relative_to_air(nm); };
  for (const double nm : recipe.wavelength_nm) p.index.push_back(index.relative_to_air(nm));
  p.radii = recipe.radii;
  p.remove_forward_lobe = recipe.forward_lobe == "remove";
  return p;
}

std::unique_ptr<const OrientedCrystals> oriented_crystals(const Recipe& recipe, const SpeciesOptions& options) {
  CrystalTableSettings settings = crystal_settings_of(recipe);
  if (options.sun_elevation_deg) {
    // To 1e-9 degrees, so that turning it into radians and back leads to the same table.
    const double radius_deg = std::round(degrees(options.sun_angular_radius_rad) * 1e9) / 1e9;
    return std::make_unique<const OrientedCrystals>(settings, oriented_table_of(recipe, *options.sun_elevation_deg, radius_deg, options));
  }
  // Without a sun nobody looks at the map, but extinction is needed.
  settings.rays = 1;
  settings.map_step_deg = 5;
  OrientedTable table = tabulate_oriented_crystals(settings, 0, 0);
  return std::make_unique<const OrientedCrystals>(settings, std::move(table));
}

}  // namespace

ScatteringTable compute_table(const Recipe& recipe, const std::function<void(double)>& progress) {
  if (recipe.type == "table") return read_table_file(recipe.file).table;
  if (recipe.is_oriented())
    throw bad_input("orientation.type", "'" + recipe.crystal.orientation.type + "'", "only crystals at random scatter by the angle alone",
                    "phase compute and phase plot make a map of the sky of others");
  if (recipe.is_crystal()) return tabulate_random_crystals(crystal_settings_of(recipe), progress);
  if (!recipe.is_sphere())
    throw bad_input("type", "'" + recipe.type + "'", "a recipe with a table expected", "Use mie, rain, crystal or table");
  const Population population = population_of(recipe);
  return recipe.optics == "geometric" ? tabulate_rays(population) : tabulate(population, progress);
}

ScatteringTable table_of(const Recipe& recipe, const SpeciesOptions& options) {
  if (recipe.type == "table") {
    TableFile file = read_table_file(recipe.file);
    for (const std::string& warning : file.warnings)
      if (options.log) options.log(warning);
    return std::move(file.table);
  }
  if (!recipe.is_sphere() && (!recipe.is_crystal() || recipe.is_oriented())) return compute_table(recipe);
  const std::string id = recipe_id(recipe);
  return SpeciesCache(options.cache_folder, options.log).find_or_make(id, [&] {
    if (options.log)
      options.log("computing the phase table of " + recipe.type + ": " + std::to_string(recipe.size_um.size()) +
                  " sizes, " + std::to_string(recipe.wavelength_nm.size()) + " wavelengths");
    return SpeciesFile{compute_table(recipe, options.progress), text_of(recipe), id, ""};
  });
}

std::shared_ptr<const Species> make_species(const Recipe& recipe, const SpeciesOptions& options) {
  if (recipe.type == "isotropic") return std::make_shared<const Species>(PhaseFunction(Isotropic()), 0.0);
  if (recipe.type == "hg") return std::make_shared<const Species>(PhaseFunction(HenyeyGreenstein(recipe.g)), 0.0);
  if (recipe.type == "rayleigh")
    return std::make_shared<const Species>(PhaseFunction(Rayleigh(recipe.depolarisation)), rayleigh_exponent);
  if (recipe.is_oriented()) return std::make_shared<const Species>(oriented_crystals(recipe, options));
  SphereTableOptions lobes;
  lobes.sun_angular_radius_rad = options.sun_angular_radius_rad;
  lobes.disc = options.disc;
  return std::make_shared<const Species>(table_of(recipe, options), lobes, options.counted_m2);
}

}  // namespace arcus::phase
