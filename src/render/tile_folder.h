#pragma once
// A folder of tiles: what is there, what of it can be trusted, and what is missing.
//
//   job.json                    what the tiles have in common (tile_job.h)
//   tile_02_of_64.tile          tile 2 of 64, done: a film file (src/film/film_file.h)
//   tile_02_of_64.checkpoint    the same, half-way

#include <optional>
#include <string>
#include <vector>

#include "src/film/film.h"
#include "src/render/tile_job.h"

namespace arcus::render {

std::string tile_path(const std::string& folder, long long tiles, long long tile);
std::string checkpoint_path(const std::string& folder, long long tiles, long long tile);

/// Writes a tile, done or half-way, as a whole file. render_seconds: of all runs that it took.
void write_tile(const std::string& path, const Film& film, const TileJob& job, long long tile, double render_seconds);

enum class TileState {
  missing,
  partial,  ///< there is a checkpoint
  done,
  damaged,  ///< cut off, changed, or no tile at all: to be made again
  foreign,  ///< whole, but of another job, or another tile under this name
};

struct TileReport {
  TileState state = TileState::missing;
  double samples = 0;         ///< that it has, of all pixels together
  double refused = 0;         ///< of those, samples that were not finite
  double render_seconds = 0;  ///< that it took
  std::string why;            ///< damaged or foreign: a sentence that begins with the file
};

/// How a tile stands. is_thorough: reads the arrays as well; otherwise the header vouches for them and only their length is seen.
TileReport inspect_tile(const std::string& folder, const TileJob& job, long long tile, bool is_thorough);

/// Reads a tile, or a checkpoint of one, into an empty film of its place. Throws Fault::incomplete and Fault::mismatch as read_film;
/// gives the seconds of rendering that it took.
double read_tile(const std::string& path, const TileJob& job, Film& film);

struct TileSurvey {
  TileJob job;
  std::vector<TileReport> tiles;
  std::vector<std::string> strangers;  ///< files that end as tiles do and have none of their names

  std::vector<long long> in_state(TileState state) const;
  /// Those that are to be made: missing, partial or damaged.
  std::vector<long long> to_make() const;
  /// Why the first one in that state is; empty where none is.
  std::string first_reason(TileState state) const;
};

/// Looks at a whole folder. The job is that of the record, or of the first whole tile where there is no record. Throws bad_input where
/// there is no such folder or nothing of this kind in it.
TileSurvey survey_tiles(const std::string& folder, bool is_thorough);

}  // namespace arcus::render
