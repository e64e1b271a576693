// arcus phase plot: pictures of a phase function.

#include <CLI/CLI.hpp>

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

namespace arcus::tools {
namespace {

struct PlotCommand {
  std::string recipe, output, polar, cache_folder, wavelengths = "650,550,450";
  double size_um = 0, sun_radius_deg = 0.2666, from_deg = 0, to_deg = 180;
  bool quiet = false;
};

void run(const PlotCommand& command) {
  phase::Recipe recipe = phase::recipe_from_file(command.recipe);
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

}  // namespace

void add_phase_plot(CLI::App& phase) {
  auto command = std::make_shared<PlotCommand>();
  CLI::App* app = phase.add_subcommand("plot", "A phase function as PNG: curves by colour, colours of the sky, polar");
  app->add_option("RECIPE", command->recipe, "recipe file (TOML)")->required();
  app->add_option("-o,--output", command->output, "OUT.png: curves, and strips of the colours in sunlight")->required();
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
  app->callback([command] { run(*command); });
}

}  // namespace arcus::tools
