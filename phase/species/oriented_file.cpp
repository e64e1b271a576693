#include "phase/species/oriented_file.h"

#include "phase/base/content_hash.h"
#include "phase/base/error.h"
#include "phase/base/version.h"
#include "phase/population/tabulate_crystals.h"
#include "phase/settings/number_text.h"
#include "phase/settings/toml_text.h"
#include "phase/species/crystal_recipe.h"
#include "phase/species/netcdf_table.h"
#include "phase/species/table_cache.h"

namespace arcus::phase {
namespace {

constexpr int format = 101;  // species_file.cpp counts from 1
/// Raised whenever a table of an unchanged recipe comes out different.
constexpr int computation_version = 2;

const char* const references =
    "Rays through crystals: W. Tape, Atmospheric Halos (AGU 1994); W. Tape and J. Moilanen, Atmospheric Halos and the Search for "
    "Angle x (AGU 2006). Ice: S. G. Warren and R. E. Brandt, J. Geophys. Res. 113, D14220 (2008). Air: B. Edlen, Metrologia 2, "
    "71 (1966). The sun's disc: H. Neckel and D. Labs, Solar Physics 153, 91 (1994).";

constexpr TableVariable size_axis{"size_um", "um", "mean maximum dimension of the crystals"};
constexpr TableVariable wavelength_axis{"wavelength_nm", "nm", "wavelength in vacuum"};
constexpr TableVariable sine_axis{"sine_elevation", "1", "absolute value of the sine of the elevation from which light comes"};
constexpr TableVariable elevation_axis{"elevation_deg", "degree", "elevation at which the light is seen, opposite to its travel"};
constexpr TableVariable azimuth_axis{"azimuth_deg", "degree", "azimuth from the sun; the other side is its mirror image"};
const std::vector<int> by_row{0, 1}, by_sine{0, 1, 2}, by_cell{0, 3, 4}, by_cell_and_wavelength{0, 3, 4, 1};

template <class Table, class Action>
void for_each_by_sine(Table& t, const Action& action) {
  action(TableVariable{"extinction_cross_section", "m2", "mean extinction cross-section of a crystal, diffraction included"},
         t.extinction_cross_section_m2);
  action(TableVariable{"forward_fraction", "1", "share of the extinction that goes straight on and is in no map"}, t.forward_fraction);
}
template <class Table, class Action>
void for_each_by_row(Table& t, const Action& action) {
  action(TableVariable{"mean_extinction_cross_section", "m2", "extinction cross-section, mean over all directions of light"},
         t.mean_extinction_cross_section_m2);
  action(TableVariable{"albedo", "1", "scattered share of the extinction less what goes straight on, mean over all directions"}, t.albedo);
}
constexpr TableVariable scattering{"scattering", "m2 sr-1", "mean differential scattering cross-section of a crystal in sunlight"};
constexpr TableVariable relative_error{"relative_error", "1", "standard error of scattering over its value, all wavelengths together"};

}  // namespace

void write_oriented_file(const std::string& path, const OrientedFile& file) {
  const OrientedTable& t = file.table;
  NetcdfTableWriter to(path);
  to.text("Conventions", "CF-1.8");
  to.text("title", "Sunlight scattered by oriented ice crystals over the sky");
  to.text("source", std::string("arcus ") + version);
  to.text("program_version", version);
  to.integer("arcus_format", format);
  to.text("recipe", file.recipe);
  to.text("table_id", file.id);
  to.text("references", references);
  to.text("comment",
          "Linear between the nodes of every axis. Light of the limb-darkened sun (of the uniform disc of a full moon where it was made for one), "
          "scattered once; light that goes straight on is "
          "in forward_fraction and not in scattering.");
  to.number("sun_elevation_deg", t.sun_elevation_deg);
  to.number("sun_angular_radius_deg", t.sun_angular_radius_deg);
  to.axis(size_axis, t.size_um);
  to.axis(wavelength_axis, t.wavelength_nm);
  to.axis(sine_axis, t.sine_elevation);
  to.axis(elevation_axis, t.elevation_deg);
  to.axis(azimuth_axis, t.azimuth_deg);
  for_each_by_sine(t, [&](const TableVariable& v, const auto& values) { to.variable(v, values, by_sine); });
  for_each_by_row(t, [&](const TableVariable& v, const auto& values) { to.variable(v, values, by_row); });
  to.compressed(scattering, t.scattering_m2_per_sr, by_cell_and_wavelength);
  to.compressed(relative_error, t.relative_error, by_cell);
  to.commit();
}

OrientedFile read_oriented_file(const std::string& path) {
  NetcdfTableReader from(path, "table of oriented crystals", format);
  OrientedFile file;
  OrientedTable& t = file.table;
  from.axis(size_axis, t.size_um, 10000);
  from.axis(wavelength_axis, t.wavelength_nm, 10000);
  from.axis(sine_axis, t.sine_elevation, 100000);
  from.axis(elevation_axis, t.elevation_deg, 100000);
  from.axis(azimuth_axis, t.azimuth_deg, 100000);
  for_each_by_sine(t, [&](const TableVariable& v, auto& values) { from.variable(v, values, by_sine); });
  for_each_by_row(t, [&](const TableVariable& v, auto& values) { from.variable(v, values, by_row); });
  from.variable(scattering, t.scattering_m2_per_sr, by_cell_and_wavelength);
  from.variable(relative_error, t.relative_error, by_cell);
  t.sun_elevation_deg = from.number("sun_elevation_deg");
  t.sun_angular_radius_deg = from.number("sun_angular_radius_deg");
  file.recipe = from.text("recipe");
  file.id = from.text("table_id");
  file.program_version = from.text("program_version");
  check_table(t, path);
  return file;
}

bool is_oriented_file(const std::string& path) { return netcdf_table_format(path) == format; }

std::string oriented_table_id(const Recipe& recipe, double sun_elevation_deg, double sun_angular_radius_deg, const PathFilter& paths, DiscKind disc) {
  // Recipes of crystals at random say nothing about maps, so that their own tables do not depend on it.
  const std::string map = recipe.is_oriented() ? "" : " step " + number_text(recipe.map_step_deg) + " noise " + number_text(recipe.map_noise);
  return content_hash(recipe_id(recipe) + map + " map " + std::to_string(computation_version) + " sun " + number_text(sun_elevation_deg) +
                      " " + number_text(sun_angular_radius_deg) + (paths.lets_all_through() ? "" : " paths " + paths.text()) +
                      (disc == DiscKind::uniform ? " uniform disc" : ""));
}

OrientedTable oriented_table_of(const Recipe& recipe, double sun_elevation_deg, double sun_angular_radius_deg,
                                const SpeciesOptions& options, const PathFilter& paths) {
  if (!recipe.is_crystal()) throw bad_input("type", "'" + recipe.type + "'", "a recipe of crystals expected");
  if (!(sun_elevation_deg >= -90 && sun_elevation_deg <= 90))
    throw bad_input("elevation of the sun", number_text(sun_elevation_deg), "must be between -90 and 90");
  OrientedFile file;
  file.recipe = text_of(recipe);
  file.id = oriented_table_id(recipe, sun_elevation_deg, sun_angular_radius_deg, paths, options.disc);
  const std::string id = file.id;
  const auto read = [&](const std::string& path) {
    OrientedFile found = read_oriented_file(path);
    if (found.id != id) throw bad_input(path, "the table of another recipe", id + " expected");
    file = std::move(found);
  };
  const auto make = [&] {
    if (options.log)
      options.log("tracing " + number_text(recipe.rays() / 1e6) + " million rays at each of " +
                  std::to_string(recipe.wavelength_nm.size()) + " wavelengths through " + recipe.crystal.name +
                  " crystals, sun at " + number_text(sun_elevation_deg) + " degrees");
    CrystalTableSettings settings = crystal_settings_of(recipe);
    settings.map_paths = paths;
    settings.disc = options.disc;
    file.table = tabulate_oriented_crystals(settings, sun_elevation_deg, sun_angular_radius_deg, options.progress);
  };
  TableCache(options.cache_folder, options.log).find_or_make(id, read, make, [&](const std::string& path) { write_oriented_file(path, file); });
  return std::move(file.table);
}

}  // namespace arcus::phase
