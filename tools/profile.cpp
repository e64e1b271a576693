// arcus profile: mean radiance of a picture against the angle from the sun, the antisolar point or the zenith.

#include <CLI/CLI.hpp>

#include <filesystem>
#include <iostream>
#include <memory>

#include "phase/base/whole_file.h"
#include "src/analysis/profile_chart.h"
#include "src/film/image_file.h"
#include "tools/command.h"

namespace arcus::tools {
namespace {

struct ProfileCommand {
  std::string image, csv, png;
  render::ProfileSettings settings;
  std::vector<double> range_deg, sector_deg;
  bool is_logarithmic = false, no_png = false, quiet = false;
};

void run(ProfileCommand& command) {
  if (!command.range_deg.empty()) {
    command.settings.from_deg = command.range_deg[0];
    command.settings.to_deg = command.range_deg[1];
  }
  if (!command.sector_deg.empty()) {
    command.settings.sector_from_deg = command.sector_deg[0];
    command.settings.sector_to_deg = command.sector_deg[1];
  }
  const render::Image image = render::read_exr(command.image);
  const render::Profile profile = render::measure_profile(image, command.settings, command.image);
  const std::string name = std::filesystem::path(command.image).filename().string();
  const std::string csv = render::csv_of(profile, name);
  if (command.csv.empty()) {
    std::cout << csv;
  } else {
    write_whole_file(command.csv, csv);
  }
  std::string png = command.png;
  if (png.empty() && !command.csv.empty()) png = std::filesystem::path(command.csv).replace_extension(".png").string();
  if (!png.empty() && !command.no_png)
    render::write_chart(png, render::chart_of(profile, name, command.is_logarithmic));
  if (!command.quiet) std::cerr << render::peaks_text(profile);
}

}  // namespace

void add_profile(CLI::App& program) {
  auto command = std::make_shared<ProfileCommand>();
  CLI::App* app = program.add_subcommand("profile", "Mean radiance of a picture against an angle: CSV and a chart");
  app->add_option("IMAGE", command->image, "a picture that arcus rendered (EXR)")->required();
  app->add_option("--around", command->settings.around, "sun | antisolar | zenith | AZIMUTH,ELEVATION in degrees")
      ->capture_default_str();
  app->add_option("-o,--output", command->csv, "OUT.csv, and the chart OUT.png beside it (default: CSV to stdout)");
  app->add_option("--png", command->png, "the chart, under another name");
  app->add_option("--bin-deg", command->settings.bin_deg, "width of a bin (default: about a pixel)")
      ->check(CLI::NonNegativeNumber);
  app->add_option("--range-deg", command->range_deg, "FROM TO: only these angles")->expected(2)->delimiter(',');
  app->add_option("--sector-deg", command->sector_deg,
                  "FROM TO: only these position angles; 0 is up, 90 to the right as one faces the centre")
      ->expected(2)
      ->delimiter(',');
  app->add_flag("--log", command->is_logarithmic, "logarithmic radiance in the chart");
  app->add_flag("--no-png", command->no_png, "no chart");
  app->add_flag("--quiet", command->quiet, "do not list the peaks");
  app->callback([command] { run(*command); });
}

}  // namespace arcus::tools
