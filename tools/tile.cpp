// arcus tile: some rectangles of a picture, each a file; the unit of work of many machines.

#include <CLI/CLI.hpp>

#include <csignal>
#include <filesystem>
#include <iostream>
#include <memory>
#include <utility>
#include <vector>

#include "phase/base/error.h"
#include "phase/base/whole_file.h"
#include "phase/settings/toml_text.h"
#include "phase/species/species_cache.h"
#include "src/render/photon_folder.h"
#include "src/render/render_tile.h"
#include "src/render/tile.h"
#include "src/render/tile_folder.h"
#include "src/render/tile_integrator.h"
#include "src/scene/build_scene.h"
#include "tools/command.h"
#include "tools/progress.h"

namespace arcus::tools {
namespace {

struct TileCommand {
  std::string scene, tiles, folder, progress = "auto", cache_folder;
  std::vector<std::string> overrides;
  int threads = 0;
  double checkpoint_s = 60;
  bool force = false, quiet = false;
};

constexpr const char* on_foreign = "Choose another folder, or overwrite with --force";

/// The tiles of the list that are not there yet. Throws Fault::mismatch, before anything is rendered or written, where what is there
/// belongs to another job.
std::vector<long long> to_render(const TileCommand& command, const render::TileJob& job, const std::vector<long long>& tiles) {
  const auto record = render::read_record(command.folder);
  if (record && !command.force && render::id_of(*record) != render::id_of(job))
    throw Error(Fault::mismatch, command.folder + ": holds tiles of something else: " + render::difference(*record, job) + ". " + on_foreign);
  std::vector<long long> wanted;
  for (const long long tile : tiles) {
    const render::TileReport report = render::inspect_tile(command.folder, job, tile, true);
    if (report.state == render::TileState::foreign && !command.force) throw Error(Fault::mismatch, report.why + ". " + on_foreign);
    if (report.state == render::TileState::damaged && !command.quiet) std::cerr << report.why << "; it is made again\n";
    if (report.state != render::TileState::done) wanted.push_back(tile);
  }
  if (wanted.empty()) return wanted;
  const render::PhotonSurvey photons = render::survey_photons(command.folder, job, false);
  if (!photons.foreign.empty() && !command.force) throw Error(Fault::mismatch, photons.foreign_because + ". " + on_foreign);
  return wanted;
}

void prepare_folder(const TileCommand& command, const render::TileJob& job, long long first_tile) {
  std::error_code error;
  std::filesystem::create_directories(command.folder, error);
  if (!std::filesystem::is_directory(command.folder)) throw cannot("cannot make the folder " + command.folder, error.message());
  remove_abandoned_in(command.folder);
  for (const std::string& path : render::survey_photons(command.folder, job, false).foreign) std::filesystem::remove(path);
  check_writable(render::tile_path(command.folder, job.tiles, first_tile));  // before the work, not after it
  const auto record = render::read_record(command.folder);
  if (!record || render::id_of(*record) != render::id_of(job)) render::write_record(command.folder, job);
}

/// When the scene's files were last written, and how long they are.
std::vector<std::pair<std::filesystem::file_time_type, std::uintmax_t>> stamps_of(const render::SceneSettings& settings, const render::TileJob& job) {
  std::vector<std::pair<std::filesystem::file_time_type, std::uintmax_t>> stamps;
  std::error_code none;  // a recipe within the scene is no file
  for (const render::SceneInput& input : job.scene.inputs) {
    const std::string path = path_from(settings.folder, input.name);
    stamps.emplace_back(std::filesystem::last_write_time(path, none), std::filesystem::file_size(path, none));
  }
  return stamps;
}

void report_done(const TileCommand& command, const render::TileJob& job, long long tile, const render::RunResult& run) {
  if (command.quiet) return;
  char line[200];
  std::snprintf(line, sizeof line, "tile %lld of %lld: %.1f s, %.3g million samples/s", tile, job.tiles, run.progress.seconds,
                1e-6 * run.progress.samples_per_second());
  std::cerr << line << (run.is_complete ? "" : ", stopped before it was done; the same command goes on") << '\n';
}

int exit_when_stopped() { return stop_request() == SIGINT ? exit_interrupted : exit_try_again; }

void run(const TileCommand& command) {
  leave_on_termination();
  const render::TileList list = render::read_tile_list(command.tiles, "--tiles");
  const render::SceneSettings settings = render::read_scene(command.scene, command.overrides);
  const render::TileJob job = render::tile_job(settings, list.count);
  const auto stamps = stamps_of(settings, job);
  const std::vector<long long> tiles = to_render(command, job, list.tiles);
  if (!command.quiet && tiles.size() < list.tiles.size())
    std::cerr << list.tiles.size() - tiles.size() << " of " << list.tiles.size() << " tiles are there\n";
  if (tiles.empty()) return;
  prepare_folder(command, job, tiles.front());

  const auto say = [&](std::string_view text) {
    if (!command.quiet) std::cerr << text << '\n';
  };
  render::BuildOptions build;
  build.cache_folder = command.cache_folder.empty() ? phase::default_cache_folder() : command.cache_folder;
  build.log = say;
  const render::Scene scene = render::build_scene(settings, build);
  if (stamps_of(settings, job) != stamps)
    throw Error(Fault::mismatch, command.scene + ": a file that it names was changed while it was read. Nothing was rendered");

  watch_for_interruption();
  render::RunOptions options;
  options.threads = command.threads;
  options.checkpoint_s = command.checkpoint_s;
  options.stop_request = &stop_request();
  if (!command.quiet) options.report = progress_report(command.progress);
  const auto integrator = render::make_tile_integrator(settings, scene, job, command.folder, tiles.front(), options, say);
  if (!integrator) throw Exit{exit_when_stopped()};
  for (const long long tile : tiles) {
    const render::RunResult result = render::render_tile(settings, scene, *integrator, job, command.folder, tile, options, say);
    if (options.report) end_progress(command.progress);
    report_done(command, job, tile, result);
    if (!result.is_complete) throw Exit{exit_when_stopped()};
  }
}

}  // namespace

void add_tile(CLI::App& program) {
  auto command = std::make_shared<TileCommand>();
  CLI::App* app = program.add_subcommand("tile", "Render some rectangles of a picture, to be joined by merge");
  app->add_option("SCENE", command->scene, "scene file (TOML)")->required();
  app->add_option("--tiles", command->tiles, "K[,K...]/N: these of N rectangles, counted from 0; A-B among the K is a range")->required();
  app->add_option("--out", command->folder, "folder of the tiles; one that is there already is not made again")->required();
  app->add_option("--set", command->overrides, "table.key=VALUE: overrides the scene file; may be repeated")
      ->expected(1)
      ->take_all();
  app->add_flag("--force", command->force, "overwrite tiles of another scene, seed or number of samples");
  app->add_option("--checkpoint-seconds", command->checkpoint_s, "how often a checkpoint is written, from which the next run goes on")
      ->check(CLI::PositiveNumber);
  app->add_option("--threads", command->threads, "0: as many as there are cores")->check(CLI::Range(0, 4096));
  app->add_flag("--quiet", command->quiet, "say nothing but errors");
  app->add_option("--progress", command->progress, "auto | json | none")->check(CLI::IsMember({"auto", "json", "none"}));
  app->add_option("--cache", command->cache_folder, "folder of the phase tables (default: $XDG_CACHE_HOME/arcus/phase)");
  app->callback([command] { run(*command); });
}

}  // namespace arcus::tools
