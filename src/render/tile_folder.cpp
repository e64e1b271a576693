#include "src/render/tile_folder.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include <nlohmann/json.hpp>
#include <tbb/parallel_for.h>

#include "phase/base/error.h"
#include "src/film/film_file.h"
#include "src/render/tile.h"

namespace arcus::render {
namespace {

constexpr const char* tile_ending = ".tile";
constexpr const char* checkpoint_ending = ".checkpoint";

std::string name_of(long long tiles, long long tile) {
  const std::string number = std::to_string(tile);
  const std::size_t digits = std::to_string(tiles - 1).size();
  return "tile_" + std::string(digits - number.size(), '0') + number + "_of_" + std::to_string(tiles);
}

std::string path_of(const std::string& folder, long long tiles, long long tile, const char* ending) {
  return (std::filesystem::path(folder) / (name_of(tiles, tile) + ending)).string();
}

/// What write_tile says beside the film.
struct About {
  TileJob job;
  long long tile = 0;
  double render_seconds = 0;
};

std::optional<About> about_of(const std::string& text) {
  const nlohmann::json about = nlohmann::json::parse(text, nullptr, false);
  if (!about.is_object() || !about.contains("job")) return std::nullopt;
  const auto job = job_from_json(about["job"].dump());
  if (!job) return std::nullopt;
  return About{*job, about.value("tile", -1LL), about.value("render_seconds", 0.0)};
}

TileReport damaged(const std::string& why) { return {TileState::damaged, 0, 0, 0, why}; }

TileReport inspect_done(const std::string& path, const TileJob& job, long long tile, bool is_thorough) {
  FilmFacts facts;
  try {
    facts = is_thorough ? verify_film(path) : read_film_facts(path);
  } catch (const Error& error) {
    if (error.fault() != Fault::incomplete) throw;
    return damaged(error.what());
  }
  const auto about = about_of(facts.about);
  if (!about) return damaged(path + ": the file is damaged: it is a film, but no tile");
  TileReport report{TileState::done, facts.samples, facts.refused, about->render_seconds, ""};
  if (facts.belongs_to != id_of(job)) {
    report.state = TileState::foreign;
    report.why = path + ": " + difference(about->job, job);
  } else if (about->tile != tile || facts.box != tile_box(job.width_px, job.height_px, job.tiles, tile)) {
    report.state = TileState::foreign;
    report.why = path + ": is tile " + std::to_string(about->tile) + " under another name";
  } else if (facts.samples != static_cast<double>(job.samples_per_pixel) * static_cast<double>(facts.box.pixels())) {
    report.state = TileState::damaged;
    report.why = path + ": the file is damaged: it is only half-way";
  }
  return report;
}

/// A checkpoint that is of no use counts as none.
TileReport inspect_partial(const std::string& path, const TileJob& job) {
  try {
    const FilmFacts facts = read_film_facts(path);
    const auto about = about_of(facts.about);
    if (!about || facts.belongs_to != id_of(job)) return {};
    return {TileState::partial, facts.samples, facts.refused, about->render_seconds, ""};
  } catch (const Error&) {
    return {};
  }
}

/// Names of files in a folder, in order.
std::set<std::string> names_in(const std::string& folder) {
  std::error_code error;
  std::set<std::string> names;
  std::filesystem::directory_iterator entries(folder, error);
  if (error) throw bad_input(folder, "no folder that can be read", "a folder that `arcus tile --out` has written expected");
  for (const auto& entry : entries) names.insert(entry.path().filename().string());
  return names;
}

bool is_tile_name(const std::string& name) { return name.starts_with("tile_") && name.ends_with(tile_ending); }

TileJob job_in(const std::string& folder, const std::set<std::string>& names) {
  if (const auto job = read_record(folder)) return *job;
  std::string damaged_tile;
  for (const std::string& name : names) {
    if (!is_tile_name(name)) continue;
    try {
      if (const auto about = about_of(read_film_facts((std::filesystem::path(folder) / name).string()).about)) return about->job;
    } catch (const Error& error) {
      damaged_tile = error.what();
    }
  }
  if (!damaged_tile.empty()) throw Error(Fault::incomplete, damaged_tile + ". No other tile and no job.json is there to say what it was");
  throw bad_input(folder, "no tile and no job.json", "a folder that `arcus tile --out` has written expected");
}

}  // namespace

std::string tile_path(const std::string& folder, long long tiles, long long tile) { return path_of(folder, tiles, tile, tile_ending); }

std::string checkpoint_path(const std::string& folder, long long tiles, long long tile) {
  return path_of(folder, tiles, tile, checkpoint_ending);
}

void write_tile(const std::string& path, const Film& film, const TileJob& job, long long tile, double render_seconds) {
  const nlohmann::ordered_json about{
      {"tile", tile}, {"render_seconds", render_seconds}, {"job", nlohmann::ordered_json::parse(json_of(job))}};
  write_film(path, film, id_of(job), about.dump());
}

TileReport inspect_tile(const std::string& folder, const TileJob& job, long long tile, bool is_thorough) {
  const std::string path = tile_path(folder, job.tiles, tile), checkpoint = checkpoint_path(folder, job.tiles, tile);
  if (std::filesystem::exists(path)) return inspect_done(path, job, tile, is_thorough);
  if (std::filesystem::exists(checkpoint)) return inspect_partial(checkpoint, job);
  return {};
}

double read_tile(const std::string& path, const TileJob& job, Film& film) {
  const auto about = about_of(read_film(path, id_of(job), film).about);
  return about ? about->render_seconds : 0;
}

std::vector<long long> TileSurvey::in_state(TileState state) const {
  std::vector<long long> found;
  for (std::size_t i = 0; i < tiles.size(); ++i)
    if (tiles[i].state == state) found.push_back(static_cast<long long>(i));
  return found;
}

std::vector<long long> TileSurvey::to_make() const {
  std::vector<long long> found;
  for (std::size_t i = 0; i < tiles.size(); ++i)
    if (tiles[i].state != TileState::done && tiles[i].state != TileState::foreign) found.push_back(static_cast<long long>(i));
  return found;
}

std::string TileSurvey::first_reason(TileState state) const {
  for (const TileReport& tile : tiles)
    if (tile.state == state) return tile.why;
  return "";
}

TileSurvey survey_tiles(const std::string& folder, bool is_thorough) {
  std::set<std::string> names = names_in(folder);
  TileSurvey survey;
  survey.job = job_in(folder, names);
  const TileJob& job = survey.job;
  survey.tiles.resize(static_cast<std::size_t>(job.tiles));
  tbb::parallel_for(0LL, job.tiles, [&](long long tile) {
    const std::string name = name_of(job.tiles, tile);
    TileReport& report = survey.tiles[static_cast<std::size_t>(tile)];
    if (names.contains(name + tile_ending))
      report = inspect_done(tile_path(folder, job.tiles, tile), job, tile, is_thorough);
    else if (names.contains(name + checkpoint_ending))
      report = inspect_partial(checkpoint_path(folder, job.tiles, tile), job);
  });
  for (long long tile = 0; tile < job.tiles; ++tile) names.erase(name_of(job.tiles, tile) + tile_ending);
  for (const std::string& name : names)
    if (is_tile_name(name)) survey.strangers.push_back(name);
  return survey;
}

}  // namespace arcus::render
