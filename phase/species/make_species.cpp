#include "phase/species/make_species.h"

#include <algorithm>
#include <cmath>

#include "phase/base/curve.h"
#include "phase/base/error.h"
#include "phase/population/tabulate.h"
#include "phase/settings/number_text.h"
#include "phase/settings/toml_text.h"
#include "phase/species/species_cache.h"

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

/// Angles between two rows such that what is linear in angle is followed by what is linear in s = sin²(θ/2) within
/// 1e-4 of the larger value: the rows' step is halved while the curves differ by more.
void add_between(double a_deg, double b_deg, double a, double b, std::vector<double>& angles) {
  const double middle = 0.5 * (a_deg + b_deg);
  const double s0 = sin2_half_deg(a_deg), s1 = sin2_half_deg(b_deg);
  const double t = (sin2_half_deg(middle) - s0) / (s1 - s0);
  const double difference = std::fabs((t - 0.5) * (b - a));
  if (difference <= 1e-4 * std::max(a, b) || b_deg - a_deg < 1e-4) return;
  const double value = 0.5 * (a + b);
  add_between(a_deg, middle, a, value, angles);
  angles.push_back(middle);
  add_between(middle, b_deg, value, b, angles);
}

ScatteringTable table_from_columns(const std::string& path) {
  const Columns columns = read_columns_file(path);
  if (columns.columns.size() != 2)
    throw bad_input(path, std::to_string(columns.columns.size()) + " columns", "must be two: angle in degrees, value");
  const std::vector<double>&angle = columns.columns[0], &value = columns.columns[1];
  const Curve curve(angle, value, path);
  if (angle.front() != 0 || angle.back() != 180)
    throw bad_input(path, "angles from " + number_text(angle.front()) + " to " + number_text(angle.back()),
                    "must reach from 0 to 180 degrees");
  if (const double least = *std::min_element(value.begin(), value.end()); least < 0)
    throw bad_input(path, "the value " + number_text(least), "must be at least 0");
  ScatteringTable t;
  t.size_um = {1};
  t.wavelength_nm = {550};
  for (std::size_t i = 0; i < angle.size(); ++i) {
    if (i > 0) add_between(angle[i - 1], angle[i], value[i - 1], value[i], t.scattering_angle_deg);
    t.scattering_angle_deg.push_back(angle[i]);
  }
  const double most = *std::max_element(value.begin(), value.end());
  for (const double deg : t.scattering_angle_deg) t.p11.push_back(static_cast<float>(curve(deg) / most));
  const double whole = sphere_integral(t.scattering_angle_deg, t.p11.data());
  if (!(whole > 0)) throw bad_input(path, "zero everywhere", "a phase function expected");
  for (float& p : t.p11) p = static_cast<float>(p / whole);
  t.p12.assign(t.p11.size(), 0);
  t.p33 = t.p34 = t.p12;
  // Scattering alone is known; as for the closed forms, albedo 1.
  t.extinction_cross_section_m2 = t.scattering_cross_section_m2 = {1};
  t.asymmetry = {sphere_integral_of_cosine(t.scattering_angle_deg, t.p11.data())};
  t.forward_fraction = {0};
  return t;
}

}  // namespace

ScatteringTable compute_table(const Recipe& recipe, const std::function<void(double)>& progress) {
  if (recipe.type == "table") return table_from_columns(recipe.file);
  if (!recipe.is_sphere())
    throw bad_input("type", "'" + recipe.type + "'", "a recipe with a table expected", "Use mie, rain or table");
  const Population population = population_of(recipe);
  return recipe.optics == "geometric" ? tabulate_rays(population) : tabulate(population, progress);
}

ScatteringTable table_of(const Recipe& recipe, const SpeciesOptions& options) {
  if (!recipe.is_sphere()) return compute_table(recipe);
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
  SphereTableOptions lobes;
  lobes.sun_angular_radius_rad = options.sun_angular_radius_rad;
  return std::make_shared<const Species>(table_of(recipe, options), lobes);
}

}  // namespace arcus::phase
