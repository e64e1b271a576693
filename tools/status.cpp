// arcus status: how far a picture in tiles is.

#include <CLI/CLI.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <utility>

#include "phase/base/error.h"
#include "phase/base/whole_file.h"
#include "src/farm/farm_job.h"
#include "src/film/image_file.h"
#include "src/render/photon_folder.h"
#include "src/render/tile.h"
#include "src/render/tile_folder.h"
#include "tools/command.h"

namespace arcus::tools {
namespace {

using Json = nlohmann::ordered_json;
using render::TileState;

struct StatusCommand {
  std::string folder, png;
  bool missing = false, json = false, headers_only = false;
};

/// Samples of a job, and the time that they took.
struct Pace {
  double done = 0, in_all = 0;
  double render_seconds = 0;  ///< of all workers together
  double job_seconds = 0;     ///< from the job's record to its newest file, both by the clock of their file system

  double of_one_worker() const { return render_seconds > 0 ? done / render_seconds : 0; }
  double of_all() const { return job_seconds > 0 ? done / job_seconds : of_one_worker(); }
};

Pace pace_of(const std::string& folder, const render::TileSurvey& survey) {
  const render::TileJob& job = survey.job;
  Pace pace;
  pace.in_all = static_cast<double>(job.samples_per_pixel) * job.width_px * job.height_px;
  std::error_code error;
  const auto begin = std::filesystem::last_write_time(render::record_path(folder), error);
  const bool has_begin = !error;
  for (std::size_t i = 0; i < survey.tiles.size(); ++i) {
    const render::TileReport& tile = survey.tiles[i];
    const bool is_done = tile.state == TileState::done;
    if (!is_done && tile.state != TileState::partial) continue;
    pace.done += tile.samples;
    pace.render_seconds += tile.render_seconds;
    const auto number = static_cast<long long>(i);
    const auto end = std::filesystem::last_write_time(
        is_done ? render::tile_path(folder, job.tiles, number) : render::checkpoint_path(folder, job.tiles, number), error);
    if (has_begin && !error) pace.job_seconds = std::max(pace.job_seconds, std::chrono::duration<double>(end - begin).count());
  }
  return pace;
}

Json facts_of(const std::string& folder, const render::TileSurvey& survey, const render::PhotonSurvey& photons) {
  const render::TileJob& job = survey.job;
  Json facts{{"folder", folder},
             {"scene_hash", job.scene.hash},
             {"program_version", job.version},
             {"resolution", {job.width_px, job.height_px}},
             {"samples_per_pixel", job.samples_per_pixel},
             {"seed", job.seed},
             {"tiles", job.tiles}};
  const std::pair<const char*, TileState> states[] = {{"done", TileState::done},
                                                      {"partial", TileState::partial},
                                                      {"missing", TileState::missing},
                                                      {"damaged", TileState::damaged},
                                                      {"foreign", TileState::foreign}};
  for (const auto& [name, state] : states) {
    const std::vector<long long> tiles = survey.in_state(state);
    facts[name] = tiles.size();
    if (state != TileState::done && !tiles.empty()) facts[std::string(name) + "_tiles"] = render::text_of_tiles(tiles);
    if (const std::string why = survey.first_reason(state); !why.empty()) facts[std::string(name) + "_because"] = why;
  }
  if (!survey.strangers.empty()) facts["other_files"] = survey.strangers;
  if (photons.ranges > 0) {
    facts["photon_ranges"] = photons.ranges;
    facts["photon_ranges_done"] = photons.ranges_done;
  }
  if (photons.passes > 0) {
    facts["photon_passes"] = photons.passes;
    facts["photon_passes_relaxed"] = photons.passes_done;
  }
  if (!photons.foreign.empty()) facts["foreign_photons_because"] = photons.foreign_because;
  const Pace pace = pace_of(folder, survey);
  facts["fraction"] = pace.done / pace.in_all;
  facts["render_seconds"] = pace.render_seconds;
  if (pace.done > 0) {
    facts["samples_per_second_of_one_worker"] = pace.of_one_worker();
    facts["samples_per_second"] = pace.of_all();
    facts["seconds_left"] = pace.of_all() > 0 ? Json((pace.in_all - pace.done) / pace.of_all()) : Json(nullptr);
  }
  return facts;
}

/// The picture's rectangles in the colours of their states, at most 960 pixels wide or high.
render::DisplayPicture map_of(const render::TileSurvey& survey) {
  const render::TileJob& job = survey.job;
  constexpr double longest_side_px = 960;
  const double scale = longest_side_px / std::max(job.width_px, job.height_px);
  const auto scaled = [&](int pixels) { return static_cast<int>(std::lround(pixels * scale)); };
  render::DisplayPicture map{std::max(1, scaled(job.width_px)), std::max(1, scaled(job.height_px)), {}};
  map.rgb.resize(static_cast<std::size_t>(map.width_px) * static_cast<std::size_t>(map.height_px) * 3, 40);
  constexpr std::uint8_t colours[5][3] = {{96, 96, 96}, {230, 190, 60}, {70, 160, 90}, {215, 60, 50}, {150, 80, 190}};  // as TileState counts
  for (long long tile = 0; tile < job.tiles; ++tile) {
    const render::PixelBox box = render::tile_box(job.width_px, job.height_px, job.tiles, tile);
    const auto& colour = colours[static_cast<std::size_t>(survey.tiles[static_cast<std::size_t>(tile)].state)];
    const int left = scaled(box.x0), right = std::min(scaled(box.x1), map.width_px), top = scaled(box.y0), bottom = std::min(scaled(box.y1), map.height_px);
    const int gap = right - left > 4 && bottom - top > 4 ? 1 : 0;  // between tiles, where there is room
    for (int y = top; y < bottom - gap; ++y)
      for (int x = left; x < right - gap; ++x)
        std::copy_n(colour, 3, &map.rgb[(static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width_px) + static_cast<std::size_t>(x)) * 3]);
  }
  return map;
}

/// Of an animation: its frames together.
Json facts_of(const farm::FarmJob& job, bool is_thorough) {
  constexpr TileState states[] = {TileState::done, TileState::partial, TileState::missing, TileState::damaged, TileState::foreign};
  constexpr const char* names[] = {"done", "partial", "missing", "damaged", "foreign"};
  long long counts[5] = {}, frames_done = 0;
  Pace all;
  std::vector<long long> frames_to_make;
  for (long long frame = 0; frame < job.frame_count(); ++frame) {
    const std::string folder = farm::folder_of(job, frame);
    long long left = job.tiles;
    if (render::read_record(folder)) {
      const render::TileSurvey survey = render::survey_tiles(folder, is_thorough);
      for (std::size_t i = 0; i < std::size(states); ++i) counts[i] += static_cast<long long>(survey.in_state(states[i]).size());
      left = survey.job.tiles - static_cast<long long>(survey.in_state(TileState::done).size());
      const Pace pace = pace_of(folder, survey);
      all.done += pace.done;
      all.in_all += pace.in_all;
      all.render_seconds += pace.render_seconds;
    } else {
      counts[2] += job.tiles;
    }
    if (left == 0) ++frames_done;
    else frames_to_make.push_back(job.frames->first + frame);
  }
  Json facts{{"folder", job.folder}, {"frames", job.frame_count()}, {"tiles_per_frame", job.tiles}};
  for (std::size_t i = 0; i < std::size(states); ++i) facts[names[i]] = counts[i];
  facts["frames_done"] = frames_done;
  if (!frames_to_make.empty()) facts["frames_to_make"] = render::text_of_tiles(frames_to_make);
  facts["render_seconds"] = all.render_seconds;
  if (all.done > 0) facts["samples_per_second_of_one_worker"] = all.of_one_worker();
  return facts;
}

void print(const StatusCommand& command, const Json& facts) {
  if (command.json) {
    std::cout << facts.dump(1) << '\n';
    return;
  }
  for (const auto& [key, value] : facts.items()) std::cout << key << ": " << (value.is_string() ? value.get<std::string>() : value.dump()) << '\n';
}

void run(const StatusCommand& command) {
  if (const auto job = farm::read_farm(command.folder); job && job->frames) {
    if (command.missing || !command.png.empty())
      throw bad_input(command.folder, "an animation", "one frame's folder expected with --missing and --png", "For instance " + farm::folder_of(*job, 0));
    return print(command, facts_of(*job, !command.headers_only));
  }
  if (!command.png.empty()) check_writable(command.png);
  const render::TileSurvey survey = render::survey_tiles(command.folder, !command.headers_only);
  if (!command.png.empty()) render::write_png(command.png, map_of(survey));
  if (command.missing) {
    std::cout << render::text_of_tiles(survey.to_make()) << '\n';
    return;
  }
  print(command, facts_of(command.folder, survey, render::survey_photons(command.folder, survey.job, !command.headers_only)));
}

}  // namespace

void add_status(CLI::App& program) {
  auto command = std::make_shared<StatusCommand>();
  CLI::App* app = program.add_subcommand("status", "How far a picture in tiles is");
  app->add_option("DIR", command->folder, "folder of the tiles")->required();
  app->add_flag("--missing", command->missing, "only the tiles that are to be made, as 2,5,9: missing, half-way or damaged");
  app->add_option("--png", command->png, "OUT.png: which tiles are there: green done, yellow half-way, grey missing, red damaged, violet foreign");
  app->add_flag("--headers-only", command->headers_only, "do not read the pixels of tiles: quicker, finds less damage");
  app->add_flag("--json", command->json, "for programs");
  app->callback([command] { run(*command); });
}

}  // namespace arcus::tools
