#include "phase/species/recipe.h"

#include <cmath>
#include <filesystem>

#include "phase/base/content_hash.h"
#include "phase/settings/number_text.h"
#include "phase/settings/toml_text.h"

namespace arcus::phase {
namespace {

/// Raised whenever a table of an unchanged recipe comes out different, so that older ones in a cache are not used.
constexpr int computation_version = 2;

const std::vector<std::string> types{"hg", "isotropic", "rayleigh", "table", "mie", "rain", "crystal"};

std::vector<double> spaced(double low, double high, int count, Spacing spacing) {
  std::vector<double> nodes;
  for (int i = 0; i < count; ++i) {
    const double t = static_cast<double>(i) / (count - 1);
    nodes.push_back(spacing == Spacing::linear ? low + t * (high - low) : low * std::pow(high / low, t));
  }
  nodes.back() = high;
  return nodes;
}

void set_defaults_of_type(Recipe& recipe) {
  recipe.distribution = SizesSettings{};
  recipe.material = "water";
  if (recipe.is_crystal()) {
    recipe.material = "ice";
    recipe.crystal = crystals_of_habit("plate");
    recipe.size_um = {200};
    // The 22 degree halo's edge moves by less than 0.05 degrees from one to the next.
    recipe.wavelength_nm = spaced(380, 780, 21, Spacing::linear);
    return;
  }
  if (recipe.type == "rain") {
    recipe.distribution.type = "marshall_palmer";
    // 0.015 to 110 mm/h; a bow changes slowly with the size of drops so broadly distributed.
    recipe.size_um = spaced(150, 1000, 11, Spacing::logarithmic);
    recipe.radii = 8000;
  } else {
    // Radii of coronas and glories go as 1/r: neighbours further apart than a tenth would show two sets of rings.
    recipe.size_um = spaced(4, 20, 18, Spacing::logarithmic);
    recipe.radii = 30000;
  }
  recipe.wavelength_nm = spaced(380, 780, 41, Spacing::linear);
}

void list_material(Keys& keys, Recipe& recipe) {
  keys.word_or_table("material", recipe.material, recipe.index,
                     "water, ice, a file of wavelength in nm, n and k, or { n, k } relative to the surroundings");
}

void list_crystal_keys(Keys& keys, Recipe& recipe) {
  list_material(keys, recipe);
  list_keys(keys, recipe.crystal);
  keys.nodes("size_um", recipe.size_um, {.low = 1, .high = 10000}, Spacing::logarithmic,
             "size nodes: mean maximum dimension of a crystal");
  keys.number("size_spread", recipe.size_spread, between(0, 1),
              "standard deviation of the logarithm of the sizes around a node");
  keys.nodes("wavelength_nm", recipe.wavelength_nm, between(200, 2000), Spacing::linear, "vacuum wavelengths");
  keys.choice("optics", recipe.optics, {"wave", "geometric"},
              "wave: rays, and the diffraction of the crystal's shadow, which also blurs them; geometric: rays only, "
              "extinction efficiency 1");
  keys.choice("forward_lobe", recipe.forward_lobe, {"remove", "scatter"},
              "remove: what passes through parallel faces, and where crystals are so large that their diffraction is "
              "narrower than the sun that too, counts as light that goes straight on; scatter: keep it");
  keys.number("rays_million", recipe.rays_million, between(0, 1e5),
              "rays traced at each wavelength, in millions; more of them leave less noise and finer detail; 0: 1 for the table of crystals "
              "that lie at random, 4 for the map of the sky of others");
  if (keys.only_if(recipe.is_oriented(), "oriented crystals")) {
    keys.number("map_step_deg", recipe.map_step_deg, between(0.02, 5), "between the nodes of the map of the sky");
    keys.number("map_noise", recipe.map_noise, above_up_to(0, 1),
                "relative standard error of the map: where rays are too few for it, it is smoothed, but never across an edge that they show");
  }
}

void list_sphere_keys(Keys& keys, Recipe& recipe) {
  list_material(keys, recipe);
  keys.table("distribution", recipe.distribution, "how the radii of a size node are distributed");
  keys.nodes("size_um", recipe.size_um, {.low = 0.001, .high = 5000}, Spacing::logarithmic,
             "size nodes: effective radii; one radius for a monodisperse distribution");
  if (recipe.distribution.type == "marshall_palmer" && recipe.distribution.rain_mm_per_hour > 0)
    recipe.size_um = {marshall_palmer_effective_radius_um(recipe.distribution.rain_mm_per_hour)};
  keys.nodes("wavelength_nm", recipe.wavelength_nm, between(200, 2000), Spacing::linear, "vacuum wavelengths");
  keys.choice("optics", recipe.optics, {"wave", "geometric"},
              "wave: Lorenz-Mie and its limit for large drops; geometric: rays only, extinction efficiency 1, no "
              "diffraction and no interference");
  keys.choice("forward_lobe", recipe.forward_lobe, {"remove", "scatter"},
              "remove: where drops are so large that their forward lobe is narrower than the sun, count it as light "
              "that goes straight on; scatter: keep it");
  keys.integer("radii", recipe.radii, between(100, 1e6),
               "spheres computed at each wavelength, shared by all size nodes; more of them leave less ripple");
}

}  // namespace

void list_keys(Keys& keys, Recipe& recipe) {
  const std::string before = recipe.type;
  keys.choice("type", recipe.type, types, "the kind of particle, or of phase function");
  if (recipe.type != before || recipe.size_um.empty() || recipe.wavelength_nm.empty()) set_defaults_of_type(recipe);
  if (keys.only_if(recipe.type == "hg", "type = hg"))
    keys.number("g", recipe.g, {.low = -1, .high = 1, .low_excluded = true, .high_excluded = true},
                "mean cosine of the scattering angle");
  if (keys.only_if(recipe.type == "rayleigh", "type = rayleigh"))
    keys.number("depolarisation", recipe.depolarisation, between(0, 6.0 / 7), "of natural light scattered at 90 degrees");
  if (keys.only_if(recipe.type == "table", "type = table")) {
    keys.text("file", recipe.file,
              "text: columns of angle in degrees from 0 to 180 and value, more values for more wavelengths; or NetCDF of phase compute or of libRadtran's mie; normalised");
    if (recipe.file.empty() && !keys.documents()) keys.refuse("file", "nothing", "the name of a file expected");
  }
  if (keys.only_if(recipe.is_sphere(), "type = mie or rain")) list_sphere_keys(keys, recipe);
  if (keys.only_if(recipe.is_crystal(), "type = crystal")) list_crystal_keys(keys, recipe);
}

Recipe default_recipe(std::string_view type) {
  Recipe recipe;
  recipe.type = type;
  set_defaults_of_type(recipe);
  return recipe;
}

Recipe recipe_from_text(std::string_view text, std::string_view where) {
  return settings_from_text<Recipe>(text, where);
}

Recipe recipe_from_file(const std::string& path) {
  Recipe recipe = settings_from_file<Recipe>(path);
  resolve_files(recipe, std::filesystem::path(path).parent_path().string());
  return recipe;
}

void resolve_files(Recipe& recipe, const std::string& folder) {
  if (!recipe.file.empty()) recipe.file = path_from(folder, recipe.file);
  if (!recipe.material.empty() && !RefractiveIndex::is_built_in(recipe.material)) recipe.material = path_from(folder, recipe.material);
}

void make_files_absolute(Recipe& recipe) { resolve_files(recipe, std::filesystem::current_path().string()); }

RefractiveIndex refractive_index_of(const Recipe& recipe) {
  return recipe.material.empty() ? RefractiveIndex::constant(recipe.index) : RefractiveIndex::named(recipe.material);
}

std::string recipe_id(const Recipe& recipe) {
  Recipe plain = recipe;
  std::string extra = "computation " + std::to_string(computation_version) + "\n";
  if (recipe.type == "table") {
    extra += read_text_file(recipe.file);
    plain.file = "content";
  } else if (recipe.is_sphere() || recipe.is_crystal()) {
    const RefractiveIndex index = refractive_index_of(recipe);
    for (const double nm : recipe.wavelength_nm) {
      const auto m = index.relative_to_air(nm);
      extra += number_text(m.real()) + " " + number_text(m.imag()) + "\n";
    }
    plain.material = "content";
  }
  return content_hash(text_of(plain) + extra);
}

}  // namespace arcus::phase
