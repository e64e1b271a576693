// arcus phase plot: pictures of a phase function. Those of the sky with crystals are in phase_sky.cpp.

#include <CLI/CLI.hpp>

#include <algorithm>
#include <iostream>
#include <memory>

#include "phase/base/error.h"
#include "phase/base/whole_file.h"
#include "phase/species/make_species.h"
#include "phase/species/species_cache.h"
#include "phase/settings/number_text.h"
#include "src/analysis/phase_chart.h"
#include "src/light/sun.h"
#include "tools/command.h"
#include "tools/number_list.h"
#include "tools/phase_sky.h"

namespace arcus::tools {
namespace {

struct PlotCommand : SkyCommand {
  std::string polar, wavelengths = "650,550,450";
  double from_deg = 0, to_deg = 180;
  bool curves = false;
};

void run_curves(const PlotCommand& command, phase::Recipe recipe) {
  if (command.output.empty()) throw bad_input("--output", "nothing", "the name of a picture expected");
  if (recipe.is_oriented())
    throw bad_input(command.recipes[0], "crystals that lie as '" + recipe.crystal.orientation.type + "'",
                    "crystals at random expected for curves, because others do not scatter by the angle alone");
  if (!(command.from_deg < command.to_deg))
    throw bad_input("--to-deg", number_text(command.to_deg), "an angle above --from-deg expected");
  render::PhaseChartSettings settings;
  settings.size_um = command.size_um;
  settings.title = recipe.type;
  if (recipe.is_sphere()) {
    // One size is all that the picture shows: the table of that size alone is quicker than the whole recipe's.
    if (settings.size_um == 0) settings.size_um = recipe.size_um[recipe.size_um.size() / 2];
    recipe.size_um = {settings.size_um};
    settings.title = (recipe.material.empty() ? "sphere" : recipe.material) + ", " + recipe.distribution.type +
                     ", effective radius " + number_text(settings.size_um) + " µm";
  }
  if (recipe.is_crystal()) {
    if (settings.size_um == 0) settings.size_um = recipe.size_um[recipe.size_um.size() / 2];
    recipe.size_um = {settings.size_um};
    settings.title = recipe.crystal.name + ", " + number_text(settings.size_um) + " µm";
  }
  settings.wavelength_nm = number_list(command.wavelengths, "--wavelengths-nm");
  settings.angle_deg = render::chart_angles_deg(command.from_deg, command.to_deg);
  settings.with_sun_disc = command.sun_radius_deg > 0;
  check_writable(command.output);
  if (!command.polar.empty()) check_writable(command.polar);

  phase::SpeciesOptions options;
  options.sun_angular_radius_rad = radians(command.sun_radius_deg);
  options.cache_folder = command.cache_folder.empty() ? phase::default_cache_folder() : command.cache_folder;
  if (!command.quiet) options.log = [](std::string_view text) { std::cerr << text << '\n'; };
  const auto species = phase::make_species(recipe, options);
  write_chart(command.output, phase_chart(*species, render::sun_irradiance({}, ""), settings));
  if (!command.polar.empty()) write_chart(command.polar, phase_polar_chart(*species, settings));
}

void run(const PlotCommand& command) {
  std::vector<phase::Recipe> recipes;
  for (const std::string& file : command.recipes) recipes.push_back(phase::recipe_from_file(file));
  const auto other = std::ranges::find_if(recipes, [](const phase::Recipe& recipe) { return !recipe.is_crystal(); });
  const bool asks_for_curves = command.curves || !command.polar.empty();
  if (other == recipes.end() && !asks_for_curves) return run_sky(command, std::move(recipes));
  if (recipes.size() > 1) {
    if (asks_for_curves) throw bad_input(command.recipes[1], "a second recipe", "curves are drawn of one");
    throw bad_input(command.recipes[static_cast<std::size_t>(other - recipes.begin())], "type '" + other->type + "'",
                    "recipes of crystals expected, because only they add up to a picture of the sky");
  }
  if (other != recipes.end() && !(command.paths_at.empty() && command.ray_paths.empty() && command.without_paths.empty()))
    throw bad_input(command.recipes[0], "type '" + other->type + "'", "a recipe of crystals expected for ray paths");
  run_curves(command, std::move(recipes.front()));
}

}  // namespace

void add_phase_plot(CLI::App& phase) {
  auto command = std::make_shared<PlotCommand>();
  CLI::App* app = phase.add_subcommand("plot", "A phase function as PNG: curves by colour, colours of the sky, polar; of crystals the whole sky");
  app->add_option("RECIPE", command->recipes, "recipe file (TOML); several of crystals make a display together")->required();
  app->add_option("-o,--output", command->output, "OUT.png: curves, and strips of the colours in sunlight; of crystals the sky");
  app->add_flag("--curves", command->curves, "curves of crystals that lie at random, too, and not the sky");
  app->add_option("--polar", command->polar, "POLAR.png: the curves around the particle");
  app->add_option("--size-um", command->size_um, "effective radius, of crystals maximum dimension (default: the recipe's middle size node)")
      ->check(CLI::PositiveNumber);
  app->add_option("--wavelengths-nm", command->wavelengths, "a curve for each")->capture_default_str();
  app->add_option("--sun-radius-deg", command->sun_radius_deg, "of the disc that curves are averaged over; 0: a point")
      ->check(CLI::Range(0.0, 90.0))
      ->capture_default_str();
  app->add_option("--from-deg", command->from_deg, "smallest scattering angle")->check(CLI::Range(0.0, 180.0));
  app->add_option("--to-deg", command->to_deg, "largest scattering angle")->check(CLI::Range(0.0, 180.0));
  app->add_option("--cache", command->cache_folder, "folder of the phase tables (default: $XDG_CACHE_HOME/arcus/phase)");
  app->add_flag("--quiet", command->quiet, "say nothing but errors");
  add_sky_options(*app, *command);
  app->callback([command] { run(*command); });
}

}  // namespace arcus::tools
