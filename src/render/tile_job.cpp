#include "src/render/tile_job.h"

#include <algorithm>
#include <filesystem>

#include <nlohmann/json.hpp>

#include "phase/base/content_hash.h"
#include "phase/base/error.h"
#include "phase/base/version.h"
#include "phase/base/whole_file.h"
#include "phase/settings/toml_text.h"
#include "src/light/sun.h"
#include "src/render/picture.h"

namespace arcus::render {
namespace {

using Json = nlohmann::ordered_json;

constexpr int format = 1;

std::string there_and_here(const std::string& what, const std::string& there, const std::string& here) {
  return what + " is " + there + " there and " + here + " here";
}

/// Keys of a scene's text with their values, one each: "sun.elevation_deg = 20".
std::vector<std::string> entries_of(const std::string& text) {
  std::vector<std::string> entries;
  std::string table, entry;
  int brackets = 0;
  const auto end_entry = [&] {
    const std::size_t begin = entry.find_first_not_of(' ');
    if (begin != std::string::npos) entries.push_back(table + entry.substr(begin));
    entry.clear();
  };
  for (const char c : text) {
    brackets += (c == '[') - (c == ']');
    if (c == '{') {
      table = entry.substr(0, entry.find(' ')) + ".";
      entry.clear();
    } else if (c == '}' || c == '\n' || (c == ',' && brackets == 0)) {
      end_entry();
      if (c == '\n') table.clear();
    } else {
      entry += c;
    }
  }
  end_entry();
  // These change no pixel.
  std::erase_if(entries, [](const std::string& one) {
    return one.find("exposure_ev") != std::string::npos || one.find("film.adaptation") != std::string::npos;
  });
  return entries;
}

/// The first key that differs, or "".
std::string scene_difference(const std::string& there, const std::string& here) {
  const std::vector<std::string> a = entries_of(there), b = entries_of(here);
  for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
    const std::string x = i < a.size() ? a[i] : "nothing", y = i < b.size() ? b[i] : "nothing";
    if (x != y) return there_and_here("the scene", "'" + x + "'", "'" + y + "'");
  }
  return "";
}

Json json(const TileJob& job) {
  Json inputs = Json::array();
  for (const SceneInput& input : job.scene.inputs) inputs.push_back({{"name", input.name}, {"hash", input.hash}});
  return {{"format", format},
          {"scene_hash", job.scene.hash},
          {"inputs", inputs},
          {"version", job.version},
          {"seed", job.seed},
          {"samples_per_pixel", job.samples_per_pixel},
          {"picture", {job.width_px, job.height_px}},
          {"tiles", job.tiles},
          {"channels", job.channels},
          {"sun_xyz", {job.sun.x, job.sun.y, job.sun.z}},
          {"scene", job.scene_text}};
}

/// Throws Json::exception where something is not there or of another type.
TileJob job_of(const Json& json) {
  TileJob job;
  json.at("scene_hash").get_to(job.scene.hash);
  for (const Json& input : json.at("inputs")) job.scene.inputs.push_back({input.at("name"), input.at("hash")});
  json.at("version").get_to(job.version);
  json.at("seed").get_to(job.seed);
  json.at("samples_per_pixel").get_to(job.samples_per_pixel);
  json.at("picture").at(0).get_to(job.width_px);
  json.at("picture").at(1).get_to(job.height_px);
  json.at("tiles").get_to(job.tiles);
  json.at("channels").get_to(job.channels);
  job.sun = {json.at("sun_xyz").at(0), json.at("sun_xyz").at(1), json.at("sun_xyz").at(2)};
  json.at("scene").get_to(job.scene_text);
  return job;
}

}  // namespace

TileJob tile_job(const SceneSettings& settings, long long tiles) {
  const CameraSettings& camera = settings.camera;
  const long long pixels = static_cast<long long>(camera.width_px) * camera.height_px;
  if (tiles < 1 || tiles > pixels)
    throw bad_input(settings.path, std::to_string(tiles) + " tiles",
                    "1 to " + std::to_string(pixels) + " expected, the pixels of " + std::to_string(camera.width_px) + " x " + std::to_string(camera.height_px));
  TileJob job;
  job.scene_text = text_of(settings);
  job.scene = scene_identity(settings);
  job.version = version;
  job.seed = settings.render.seed;
  job.samples_per_pixel = settings.render.samples_per_pixel;
  job.width_px = camera.width_px;
  job.height_px = camera.height_px;
  job.tiles = tiles;
  job.channels = settings.film.channels;
  job.sun = sun_colour(sun_irradiance(settings.sun, settings.folder));
  return job;
}

std::string id_of(const TileJob& job) {
  return content_hash(job.scene.hash + "\n" + job.version + "\n" + std::to_string(job.tiles));
}

SceneSettings settings_of(const TileJob& job) {
  SceneSettings settings;
  read_toml(job.scene_text, "scene of the tiles", {}, [&](Keys& keys) { list_keys(keys, settings); });
  return settings;
}

std::string difference(const TileJob& there, const TileJob& here) {
  if (id_of(there) == id_of(here)) return "";
  const auto size = [](const TileJob& job) { return std::to_string(job.width_px) + " x " + std::to_string(job.height_px); };
  if (there.tiles != here.tiles) return there_and_here("the number of tiles", std::to_string(there.tiles), std::to_string(here.tiles));
  if (there.version != here.version) return there_and_here("the program's version", there.version, here.version);
  if (size(there) != size(here)) return there_and_here("the picture", size(there), size(here));
  if (there.seed != here.seed) return there_and_here("the seed", std::to_string(there.seed), std::to_string(here.seed));
  if (there.samples_per_pixel != here.samples_per_pixel)
    return there_and_here("samples_per_pixel", std::to_string(there.samples_per_pixel), std::to_string(here.samples_per_pixel));
  for (const SceneInput& a : there.scene.inputs)
    for (const SceneInput& b : here.scene.inputs)
      if (a.name == b.name && a.hash != b.hash) return "the content of " + a.name + " was another";
  const std::string key = scene_difference(there.scene_text, here.scene_text);
  return key.empty() ? "the scene is another" : key;
}

std::string json_of(const TileJob& job) { return json(job).dump(); }

std::optional<TileJob> job_from_json(const std::string& text) {
  try {
    return job_of(Json::parse(text));
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

std::string record_path(const std::string& folder) { return (std::filesystem::path(folder) / "job.json").string(); }

void write_record(const std::string& folder, const TileJob& job) {
  const Json record{{"arcus_tiles", format}, {"hash", content_hash(json_of(job))}, {"job", json(job)}};
  write_whole_file(record_path(folder), record.dump(1) + "\n");
}

std::optional<TileJob> read_record(const std::string& folder) {
  if (!std::filesystem::exists(record_path(folder))) return std::nullopt;
  try {
    const Json record = Json::parse(read_text_file(record_path(folder)));
    const TileJob job = job_of(record.at("job"));
    if (record.at("arcus_tiles") != format || record.at("hash") != content_hash(json_of(job))) return std::nullopt;
    return job;
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

}  // namespace arcus::render
