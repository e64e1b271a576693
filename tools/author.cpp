// arcus author: media as VDB files.

#include <CLI/CLI.hpp>

#include <filesystem>
#include <iostream>
#include <memory>

#include "media/author/box.h"
#include "media/author/cirrus.h"
#include "media/author/cloud.h"
#include "media/author/diamond_dust.h"
#include "media/author/field.h"
#include "media/author/fill.h"
#include "media/author/fog.h"
#include "media/author/rain.h"
#include "phase/base/whole_file.h"
#include "tools/command.h"
#include "tools/key_options.h"

namespace arcus::tools {
namespace {

/// What all kinds share: the output, a settings file, and the keys as options.
struct AuthorCommand {
  std::string output, settings_file;
  bool quiet = false;
  std::unique_ptr<KeyOptions> options;

  template <class S>
  S settings() const {
    S result;
    const auto list = [&](Keys& keys) { list_keys(keys, result); };
    if (settings_file.empty()) options->read(list);
    else read_toml_file(settings_file, options->assignments(), list);
    return result;
  }
};

template <class S>
void add_kind(CLI::App& author, const char* name, const char* meaning,
              std::function<void(const AuthorCommand&, const S&)> make) {
  auto command = std::make_shared<AuthorCommand>();
  CLI::App* app = author.add_subcommand(name, meaning);
  app->add_option("-o,--output", command->output, "OUT.vdb")->required();
  app->add_option("--settings", command->settings_file, "TOML file with the keys below; options override it");
  app->add_flag("--quiet", command->quiet, "say nothing but errors");
  command->options = std::make_unique<KeyOptions>(*app, [](Keys& keys) {
    S defaults;
    list_keys(keys, defaults);
  });
  app->callback([command, make] {
    check_writable(command->output);
    make(*command, command->settings<S>());
  });
}

void author_rain(const AuthorCommand& command, const media::RainSettings& settings) {
  media::AuthoredRain rain = media::author_rain(settings);
  const std::size_t bricks = rain.species.extinction.size();
  media::save_grids(command.output, media::grids_of(std::move(rain.species)));
  if (command.quiet) return;
  std::fprintf(stderr,
               "%s: %.3g t of water, extinction up to %.3g /m (diffraction included), effective radius %.3g to %.3g um, "
               "%zu bricks of 8^3 voxels\n",
               command.output.c_str(), 1e-3 * rain.water_kg, rain.largest_extinction_per_m, rain.smallest_radius_um,
               rain.largest_radius_um, bricks);
}

/// What droplets are like, in words.
std::string droplet_words(const media::FilledRange& range) {
  char text[200];
  std::snprintf(text, sizeof text, "extinction up to %.3g /m (diffraction included), effective radius %.3g to %.3g um", range.largest_extinction_per_m,
                range.smallest_size_um, range.largest_size_um);
  return text;
}

/// Writes a species of droplets and says what it holds.
void save_droplets(const AuthorCommand& command, media::NewSpecies species) {
  const media::FilledRange range = media::range_of(species);
  const std::size_t bricks = species.extinction.size();
  media::save_grids(command.output, media::grids_of(std::move(species)));
  if (command.quiet) return;
  std::cerr << command.output << ": " << droplet_words(range) << ", " << bricks << " bricks of 8^3 voxels\n";
}

void author_cloud(const AuthorCommand& command, const media::CloudSettings& settings) {
  save_droplets(command, media::author_cloud(settings));
}

void author_fog(const AuthorCommand& command, const media::FogSettings& settings) {
  save_droplets(command, media::author_fog(settings));
}

/// Writes the species of ice into one file and says what they hold.
void save_ice(const AuthorCommand& command, media::AuthoredIce ice) {
  std::vector<media::NewGrid> grids;
  std::string names;
  for (media::NewSpecies& species : ice.species) {
    names += (names.empty() ? "" : ", ") + species.name;
    for (media::NewGrid& grid : media::grids_of(std::move(species))) grids.push_back(std::move(grid));
  }
  media::save_grids(command.output, grids);
  if (command.quiet) return;
  char text[300];
  std::snprintf(text, sizeof text,
                "%.3g t of ice, mean optical depth %.3g, extinction up to %.3g /m (diffraction included), maximum dimension %.3g to %.3g um", 1e-3 * ice.ice_kg,
                ice.mean_optical_depth, ice.largest_extinction_per_m, ice.smallest_size_um, ice.largest_size_um);
  std::cerr << command.output << ": " << text << ", species " << names << '\n';
}

void author_cirrus(const AuthorCommand& command, const media::CirrusSettings& settings) {
  save_ice(command, media::author_cirrus(settings));
}

void author_diamond_dust(const AuthorCommand& command, const media::DiamondDustSettings& settings) {
  save_ice(command, media::author_diamond_dust(settings));
}

void author_box(const AuthorCommand& command, const media::BoxSettings& settings) {
  const std::string folder = std::filesystem::path(command.settings_file).parent_path().string();
  media::save_grids(command.output, media::grids_of(media::author_box(settings, folder)));
}

void author_field(const AuthorCommand& command, const media::FieldSettings& settings) {
  const std::string folder = std::filesystem::path(command.settings_file).parent_path().string();
  const media::AuthoredField field = media::author_field(settings, folder);
  media::save_grids(command.output, field.grids);
  if (command.quiet || !settings.is_water()) return;
  for (const std::string& note : field.notes) std::cerr << settings.file << ": " << note << '\n';
  std::cerr << command.output << ": " << droplet_words(field.range) << ", " << field.grids[0].bricks.size() << " bricks of 8^3 voxels\n";
}

}  // namespace

void add_author(CLI::App& program) {
  CLI::App* author = program.add_subcommand("author", "Make a medium as a VDB file");
  author->require_subcommand(1);
  add_kind<media::RainSettings>(*author, "rain", "A shower: a shaft of rain under a cloud base", author_rain);
  add_kind<media::CloudSettings>(*author, "cloud", "Water clouds: cumulus, stratocumulus, stratus", author_cloud);
  add_kind<media::FogSettings>(*author, "fog", "Radiation or advection fog", author_fog);
  add_kind<media::CirrusSettings>(*author, "cirrus", "Clouds of ice with fall streaks: uncinus, fibratus, cirrostratus", author_cirrus);
  add_kind<media::DiamondDustSettings>(*author, "diamond-dust", "Ice crystals in the air over the ground", author_diamond_dust);
  add_kind<media::BoxSettings>(*author, "box", "A homogeneous block", author_box);
  add_kind<media::FieldSettings>(*author, "field", "Numbers from elsewhere: raw, as text, or the water of a cloud model in NetCDF or LWC files", author_field);
}

}  // namespace arcus::tools
