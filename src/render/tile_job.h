#pragma once
// What all tiles of one picture have in common, so that tiles made anywhere can be told to belong together; and its record, a text
// file in their folder.

#include <optional>
#include <string>
#include <vector>

#include "src/film/colour.h"
#include "src/scene/fingerprint.h"
#include "src/scene/settings.h"

namespace arcus::render {

struct TileJob {
  std::string scene_text;  ///< complete settings as TOML
  SceneIdentity scene;
  std::string version;     ///< of the program
  long long seed = 0, samples_per_pixel = 0;
  int width_px = 0, height_px = 0;  ///< of the whole picture
  long long tiles = 0;              ///< that it is cut into
  std::vector<std::string> channels;
  Xyz sun;                 ///< sun_colour, so that tiles can be joined where the scene's files are not
};

/// The job of a scene that is cut into so many tiles. Reads every file that the scene names. Throws bad_input where one cannot be
/// read, or where there are more tiles than pixels.
TileJob tile_job(const SceneSettings& settings, long long tiles);

/// Equal for tiles that may be joined.
std::string id_of(const TileJob& job);

/// The scene again; its files are not there for certain.
SceneSettings settings_of(const TileJob& job);

/// What makes two jobs different: "the seed is 1 there and 2 here", the nearest to a cause; empty where ids are equal.
std::string difference(const TileJob& there, const TileJob& here);

/// As JSON and back; nothing where the text is none of a job.
std::string json_of(const TileJob& job);
std::optional<TileJob> job_from_json(const std::string& text);

/// Name of the record in a folder of tiles: JSON with the job and its hash.
std::string record_path(const std::string& folder);
void write_record(const std::string& folder, const TileJob& job);
/// Nothing where there is none, or it is damaged: tiles know their job themselves.
std::optional<TileJob> read_record(const std::string& folder);

}  // namespace arcus::render
