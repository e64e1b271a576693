// arcus phase: phase functions, from one sphere to the tables that clouds carry. The plots are in phase_plot.cpp.

#include <unistd.h>

#include <CLI/CLI.hpp>

#include <nlohmann/json.hpp>

#include <cstdio>
#include <iostream>
#include <memory>

#include "phase/base/error.h"
#include "phase/base/units.h"
#include "phase/base/whole_file.h"
#include "phase/optics/sun_disc.h"
#include "phase/particle/mie.h"
#include "phase/settings/toml_text.h"
#include "phase/species/evaluate.h"
#include "phase/species/make_species.h"
#include "phase/species/oriented_file.h"
#include "phase/species/species_cache.h"
#include "phase/species/species_file.h"
#include "tools/command.h"
#include "tools/number_list.h"

namespace arcus::tools {
namespace {

struct SphereCommand {
  double x = 0, n = 1.333, k = 0;
  std::string angles = "0:180:1";
  bool json = false;
};

void run_sphere(const SphereCommand& command) {
  const std::vector<double> angle_deg = number_list(command.angles, "--angles-deg");
  std::vector<double> angle_rad;
  for (const double angle : angle_deg) {
    if (!(angle >= 0 && angle <= 180))
      throw bad_input("--angles-deg", "'" + command.angles + "'", "angles between 0 and 180 expected");
    angle_rad.push_back(radians(angle));
  }
  const auto sphere = phase::mie_sphere(command.x, {command.n, command.k}, angle_rad);
  const auto& q = sphere.efficiencies;
  if (command.json) {
    nlohmann::ordered_json out{{"x", command.x}, {"n", command.n}, {"k", command.k}, {"qext", q.extinction},
                               {"qsca", q.scattering}, {"qback", q.backscatter}, {"g", q.asymmetry},
                               {"angles_deg", angle_deg}};
    for (const char* key : {"s1_re", "s1_im", "s2_re", "s2_im"}) out[key] = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < angle_deg.size(); ++i) {
      out["s1_re"].push_back(sphere.s1[i].real());
      out["s1_im"].push_back(sphere.s1[i].imag());
      out["s2_re"].push_back(sphere.s2[i].real());
      out["s2_im"].push_back(sphere.s2[i].imag());
    }
    std::cout << out.dump(1) << '\n';
    return;
  }
  std::printf("# x %.17g  m %.17g + %.17gi\n# qext %.12g  qsca %.12g  qback %.12g  g %.12g\n", command.x, command.n,
              command.k, q.extinction, q.scattering, q.backscatter, q.asymmetry);
  std::printf("scattering_angle_deg,s1_re,s1_im,s2_re,s2_im\n");
  for (std::size_t i = 0; i < angle_deg.size(); ++i)
    std::printf("%.10g,%.12g,%.12g,%.12g,%.12g\n", angle_deg[i], sphere.s1[i].real(), sphere.s1[i].imag(),
                sphere.s2[i].real(), sphere.s2[i].imag());
}

struct EvalCommand {
  std::string recipe, angles = "0:180:0.5";
  double size_um = 0, wavelength_nm = 550;
  bool json = false;
};

void run_eval(const EvalCommand& command) {
  const phase::Recipe recipe = phase::recipe_from_file(command.recipe);
  const std::vector<double> angle_deg = number_list(command.angles, "--angles-deg");
  double size_um = command.size_um;
  if (size_um == 0 && (recipe.is_sphere() || recipe.is_crystal())) {
    if (recipe.size_um.size() != 1)
      throw bad_input("--size-um", "nothing", "a size expected, because the recipe has several size nodes");
    size_um = recipe.size_um[0];
  }
  const auto row = phase::evaluate_recipe(recipe, size_um, command.wavelength_nm, angle_deg);
  if (command.json) {
    std::cout << nlohmann::ordered_json{{"size_um", size_um}, {"wavelength_nm", command.wavelength_nm},
                                        {"extinction_cross_section_m2", row.extinction_m2},
                                        {"scattering_cross_section_m2", row.scattering_m2}, {"asymmetry", row.asymmetry},
                                        {"forward_fraction", row.forward_fraction},
                                        {"scattering_angle_deg", angle_deg}, {"P11", row.p11}, {"P12", row.p12},
                                        {"P33", row.p33}, {"P34", row.p34}}.dump(1) << '\n';
    return;
  }
  std::printf("scattering_angle_deg,P11,P12,P33,P34\n");
  for (std::size_t i = 0; i < angle_deg.size(); ++i)
    std::printf("%.10g,%.9g,%.9g,%.9g,%.9g\n", angle_deg[i], row.p11[i], row.p12[i], row.p33[i], row.p34[i]);
}

struct ComputeCommand {
  std::string recipe, output, cache_folder;
  double sun_elevation_deg = 20, sun_radius_deg = phase::mean_sun_radius_deg;
  bool quiet = false;
};

void run_compute(const ComputeCommand& command) {
  const phase::Recipe recipe = phase::recipe_from_file(command.recipe);
  if (!command.output.empty()) check_writable(command.output);
  phase::SpeciesOptions options;
  options.cache_folder = command.cache_folder.empty() ? phase::default_cache_folder() : command.cache_folder;
  if (!command.quiet) {
    options.log = [](std::string_view text) { std::cerr << text << '\n'; };
    if (::isatty(STDERR_FILENO) == 1)
      options.progress = [](double share) { std::fprintf(stderr, "\r%3.0f %%%s", 100 * share, share >= 1 ? "\n" : ""); };
  }
  if (recipe.is_oriented()) {
    phase::OrientedFile file;
    file.id = phase::oriented_table_id(recipe, command.sun_elevation_deg, command.sun_radius_deg);
    file.table = phase::oriented_table_of(recipe, command.sun_elevation_deg, command.sun_radius_deg, options);
    file.recipe = text_of(recipe);
    if (command.output.empty()) std::cout << phase::SpeciesCache(options.cache_folder).path_of(file.id) << '\n';
    else phase::write_oriented_file(command.output, file);
    return;
  }
  phase::SpeciesFile file;
  file.table = phase::table_of(recipe, options);
  file.recipe = text_of(recipe);
  file.recipe_id = phase::recipe_id(recipe);
  if (command.output.empty()) {
    std::cout << phase::SpeciesCache(options.cache_folder).path_of(file.recipe_id) << '\n';
  } else {
    phase::write_species_file(command.output, file);
  }
}

}  // namespace

void add_phase_plot(CLI::App& phase);

void add_phase(CLI::App& program) {
  CLI::App* phase = program.add_subcommand("phase", "Phase functions: one sphere, populations, tables and pictures");
  phase->require_subcommand(1);
  {
    auto command = std::make_shared<SphereCommand>();
    CLI::App* app = phase->add_subcommand("sphere", "Lorenz-Mie scattering by one sphere");
    app->add_option("--x", command->x, "size parameter 2 pi r / wavelength in the surroundings")->required();
    app->add_option("--n", command->n, "real part of the index, relative to the surroundings")->capture_default_str();
    app->add_option("--k", command->k, "imaginary part, at least 0")->capture_default_str();
    app->add_option("--angles-deg", command->angles, "0,90,180 or BEGIN:END:STEP")->capture_default_str();
    app->add_flag("--json", command->json, "efficiencies and amplitudes as JSON");
    app->callback([command] { run_sphere(*command); });
  }
  {
    auto command = std::make_shared<EvalCommand>();
    CLI::App* app = phase->add_subcommand("eval", "The scattering matrix of a recipe, computed directly");
    app->add_option("RECIPE", command->recipe, "recipe file (TOML)")->required();
    app->add_option("--size-um", command->size_um, "effective radius, of crystals maximum dimension; may be left out where the recipe has one size");
    app->add_option("--wavelength-nm", command->wavelength_nm, "in vacuum")->capture_default_str();
    app->add_option("--angles-deg", command->angles, "0,90,180 or BEGIN:END:STEP")->capture_default_str();
    app->add_flag("--json", command->json, "JSON instead of CSV, with cross-sections and asymmetry");
    app->callback([command] { run_eval(*command); });
  }
  {
    auto command = std::make_shared<ComputeCommand>();
    CLI::App* app = phase->add_subcommand("compute", "The table of a recipe as NetCDF-4, kept in the cache");
    app->add_option("RECIPE", command->recipe, "recipe file (TOML)")->required();
    app->add_option("-o,--output", command->output, "OUT.nc (default: print the name of the file in the cache)");
    app->add_option("--sun-elevation-deg", command->sun_elevation_deg, "oriented crystals: how high the sun of the map stands")
        ->check(CLI::Range(-90.0, 90.0))->capture_default_str();
    app->add_option("--sun-radius-deg", command->sun_radius_deg, "oriented crystals: radius of the sun's disc")
        ->check(CLI::Range(0.0, 30.0))->capture_default_str();
    app->add_option("--cache", command->cache_folder, "folder of the phase tables (default: $XDG_CACHE_HOME/arcus/phase)");
    app->add_flag("--quiet", command->quiet, "say nothing but errors");
    app->callback([command] { run_compute(*command); });
  }
  add_phase_plot(*phase);
}

}  // namespace arcus::tools
