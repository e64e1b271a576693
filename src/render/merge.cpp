#include "src/render/merge.h"

#include <algorithm>
#include <filesystem>

#include "phase/base/error.h"
#include "src/film/film_file.h"
#include "src/render/picture.h"
#include "src/render/tile.h"
#include "src/render/tile_folder.h"

namespace arcus::render {
namespace {

bool is_whole_but_foreign(const TileSurvey& survey) {
  return !survey.strangers.empty() || !survey.in_state(TileState::foreign).empty();
}

Error foreign(const std::string& folder, const TileSurvey& survey) {
  std::string text = folder + ": holds tiles of something else";
  if (const auto tiles = survey.in_state(TileState::foreign); !tiles.empty())
    text += ": " + text_of_tiles(tiles) + " (" + survey.first_reason(TileState::foreign) + ")";
  if (!survey.strangers.empty()) text += ": " + list_of(survey.strangers);
  return Error(Fault::mismatch, text + ". Remove them, or make them anew with `arcus tile --force`");
}

Error incomplete(const std::string& folder, const TileSurvey& survey, bool is_repaired) {
  std::string text = folder + ": not complete";
  std::vector<long long> missing = survey.in_state(TileState::missing);
  const auto partial = survey.in_state(TileState::partial), damaged = survey.in_state(TileState::damaged);
  missing.insert(missing.end(), partial.begin(), partial.end());
  std::sort(missing.begin(), missing.end());
  if (!missing.empty()) text += ": missing " + text_of_tiles(missing);
  if (!damaged.empty())
    text += ": damaged" + std::string(is_repaired ? " and deleted " : " ") + text_of_tiles(damaged) + " (" + survey.first_reason(TileState::damaged) + ")";
  return Error(Fault::incomplete,
               text + ". `arcus tile SCENE --tiles " + text_of_tiles(survey.to_make()) + "/" + std::to_string(survey.job.tiles) + " --out " + folder + "` makes them");
}

/// The picture as it grows.
class Joining {
 public:
  explicit Joining(const TileJob& job) : job_(job), settings_(settings_of(job)), to_rgb_(to_rgb_of(settings_, job.sun)) {}

  /// Reads a tile, which verifies it, and puts its pixels in their place. The picture is made with the first one.
  void add(const std::string& path, long long tile) {
    Film film = empty_film(tile_box(job_.width_px, job_.height_px, job_.tiles, tile));
    read_tile(path, job_, film);
    const Image part = film.to_image();
    Image& whole = picture();
    const std::size_t row_values = static_cast<std::size_t>(part.box().width()) * part.channel_names().size();
    for (int y = part.box().y0; y < part.box().y1; ++y)
      std::copy_n(&part.values()[static_cast<std::size_t>(y - part.box().y0) * row_values], row_values, &whole.value(part.box().x0, y, 0));
  }

  /// Frees the picture: tiles are only verified from now on.
  void give_up() { whole_ = Image(); }

  Merge finish(double samples, double render_seconds) {
    Merge merge;
    merge.image = std::move(picture());
    const double pixels = static_cast<double>(job_.width_px) * job_.height_px;
    describe(merge.image, settings_, samples / pixels, render_seconds);
    merge.tone = tone_of(settings_, job_.sun);
    return merge;
  }

 private:
  Film empty_film(const PixelBox& box) const { return Film(job_.width_px, job_.height_px, box, settings_.film, to_rgb_); }

  Image& picture() {
    if (whole_.width_px() == 0) {
      const Image sample = empty_film({0, 0, 1, 1}).to_image();  // for its channels
      whole_ = Image(job_.width_px, job_.height_px, sample.channel_names());
      whole_.metadata = sample.metadata;
    }
    return whole_;
  }

  const TileJob& job_;
  SceneSettings settings_;
  ToRgb to_rgb_;
  Image whole_;
};

}  // namespace

Merge merge_tiles(const std::string& folder, const MergeOptions& options) {
  TileSurvey survey = survey_tiles(folder, false);
  const long long tiles = survey.job.tiles;
  Joining joining(survey.job);
  // Where there will be no picture all tiles are verified still, so that one message names all that is wrong.
  bool is_joining = !is_whole_but_foreign(survey) && (options.allow_partial || survey.to_make().empty());
  double samples = 0, render_seconds = 0, refused = 0;
  for (long long tile = 0; tile < tiles; ++tile) {
    TileReport& report = survey.tiles[static_cast<std::size_t>(tile)];
    const bool is_done = report.state == TileState::done;
    if (!is_done && !(report.state == TileState::partial && options.allow_partial)) continue;
    const std::string path = is_done ? tile_path(folder, tiles, tile) : checkpoint_path(folder, tiles, tile);
    try {
      if (is_joining) joining.add(path, tile);
      else verify_film(path);
    } catch (const Error& error) {
      if (error.fault() != Fault::incomplete) throw;
      report = {is_done ? TileState::damaged : TileState::missing, 0, 0, 0, error.what()};
      is_joining = is_joining && options.allow_partial;
      if (!is_joining) joining.give_up();
      continue;
    }
    samples += report.samples;
    render_seconds += report.render_seconds;
    refused += report.refused;
  }
  if (options.repair)
    for (const long long tile : survey.in_state(TileState::damaged)) std::filesystem::remove(tile_path(folder, tiles, tile));
  if (is_whole_but_foreign(survey)) throw foreign(folder, survey);
  if (!is_joining) throw incomplete(folder, survey, options.repair);
  Merge merge = joining.finish(samples, render_seconds);
  merge.refused = refused;
  merge.left_out = survey.to_make();
  return merge;
}

}  // namespace arcus::render
