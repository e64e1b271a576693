// arcus compare-droplets: a medium against explicit drops drawn from it.

#include <CLI/CLI.hpp>

#include <algorithm>
#include <csignal>
#include <iostream>
#include <memory>

#include "phase/base/whole_file.h"
#include "phase/species/species_cache.h"
#include "src/analysis/drops_comparison.h"
#include "src/film/image_file.h"
#include "tools/command.h"

namespace arcus::tools {
namespace {

/// Paths from the eye find the sun through drops by chance alone: under the real sun that takes fifty times as long.
constexpr double usual_sun_radius_deg = 2;

struct CompareDropletsCommand {
  std::string scene, report, cache_folder;
  std::vector<std::string> overrides;
  long long samples = 0;
  double sun_radius_deg = 0;
  bool quiet = false, has_times = true;
  render::DropsComparisonOptions options;
};

/// 10, 100, ... and the number that is compared.
std::vector<long long> decades_to(long long drops) {
  std::vector<long long> counts;
  for (long long count = 10; count < drops; count *= 10) counts.push_back(count);
  counts.push_back(drops);
  return counts;
}

void run(CompareDropletsCommand& command) {
  std::vector<std::string> overrides = command.overrides;
  if (command.samples > 0) overrides.push_back("render.samples_per_pixel=" + std::to_string(command.samples));
  render::SceneSettings settings = render::read_scene(command.scene, overrides);
  settings.sun.angular_radius_deg =
      command.sun_radius_deg > 0 ? command.sun_radius_deg : std::max(settings.sun.angular_radius_deg, usual_sun_radius_deg);
  check_writable(command.report);

  render::DropsComparisonOptions& options = command.options;
  const auto say = [&](std::string_view text) {
    if (!command.quiet) std::cerr << text << '\n';
  };
  options.log = say;
  options.build.log = say;
  options.build.cache_folder = command.cache_folder.empty() ? phase::default_cache_folder() : command.cache_folder;
  if (command.has_times) options.timed_counts = decades_to(options.drops);
  render::load_image_files();
  watch_for_interruption();
  options.run.stop_request = &stop_request();
  const render::DropsComparison comparison = compare_drops(settings, options);
  if (stop_request() == SIGINT) throw Exit{exit_interrupted};
  if (stop_request() == SIGTERM) throw Exit{exit_terminated};
  std::cout << figures_text(comparison);
  write_whole_file(command.report, html_report(comparison));
}

}  // namespace

void add_compare_droplets(CLI::App& program) {
  auto command = std::make_shared<CompareDropletsCommand>();
  render::DropsComparisonOptions& options = command->options;
  CLI::App* app = program.add_subcommand("compare-droplets", "A medium against explicit drops drawn from it");
  app->add_option("SCENE", command->scene, "scene file (TOML) with a medium of drops")->required();
  app->add_option("-o,--output", command->report, "REPORT.html: pictures, profiles with errors, chi-square, optical depths, times")->required();
  app->add_option("--set", command->overrides, "table.key=VALUE: overrides the scene file; may be repeated")->expected(1)->take_all();
  app->add_option("--drops", options.drops, "explicit drops for each medium [100000]")->check(CLI::Range(1LL, 4000000000LL));
  app->add_option("--runs", options.runs, "drops lie elsewhere in each; errors are from their scatter [16]")->check(CLI::Range(4, 100000));
  app->add_option("--spp", command->samples, "samples per pixel, shared by the runs")->check(CLI::Range(1LL, 4294967295LL));
  app->add_option("--sun-radius-deg", command->sun_radius_deg, "of the sun's disc in both; without it the scene's, but at least 2: the smaller, the more samples")
      ->check(CLI::Range(0.01, 60.0));
  app->add_option("--around", options.profile.around, "sun | antisolar | zenith | AZIMUTH,ELEVATION: centre of the profile [antisolar]");
  app->add_option("--bin-deg", options.profile.bin_deg, "width of the profile's bins")->check(CLI::PositiveNumber);
  app->add_option("--from-deg", options.profile.from_deg, "profile from this angle on")->check(CLI::Range(0.0, 180.0));
  app->add_option("--to-deg", options.profile.to_deg, "profile up to this angle")->check(CLI::Range(0.0, 180.0));
  app->add_flag("!--no-times", command->has_times, "do not take times against the number of drops");
  app->add_flag("--quiet", command->quiet, "say nothing but errors and the figures");
  app->add_option("--cache", command->cache_folder, "folder of the phase tables (default: $XDG_CACHE_HOME/arcus/phase)");
  app->callback([command] { run(*command); });
}

}  // namespace arcus::tools
