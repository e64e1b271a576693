#include "src/render/merge.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include <tbb/parallel_for.h>
#include <tbb/parallel_pipeline.h>

#include "phase/base/error.h"
#include "src/film/film_file.h"
#include "src/film/image_file.h"
#include "src/film/tone.h"
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

/// Whole rows of tiles, which are joined together.
struct Band {
  long long first = 0, end = 0;  ///< of the tiles, the end excluded
  int y0 = 0, y1 = 0;
};

std::vector<Band> bands_of(const TileJob& job) {
  constexpr int least_height_px = 32;  // rows of pixels are compressed sixteen together
  std::vector<Band> bands;
  for (long long tile = 0; tile < job.tiles; ++tile) {
    const PixelBox box = tile_box(job.width_px, job.height_px, job.tiles, tile);
    if (bands.empty() || (box.x0 == 0 && bands.back().y1 - bands.back().y0 >= least_height_px)) bands.push_back({tile, tile, box.y0, box.y1});
    bands.back().end = tile + 1;
    bands.back().y1 = box.y1;
  }
  return bands;
}

/// A band's pixels, as the two files want them.
struct Strip {
  Image image;
  DisplayPicture shown;
};

/// Where they go.
struct PictureFiles {
  ExrWriter exr;
  std::optional<PngWriter> png;
};

class Joining {
 public:
  Joining(const std::string& folder, TileSurvey& survey, const MergeOptions& options)
      : folder_(folder),
        survey_(survey),
        options_(options),
        settings_(settings_of(survey.job)),
        to_rgb_(to_rgb_of(settings_, survey.job.sun)),
        tone_(tone_of(settings_, survey.job.sun)),
        bands_(bands_of(survey.job)) {}

  /// Where there will be no picture all tiles are verified still, so that one message names all that is wrong.
  void verify() { read_tiles(nullptr); }

  /// Writes the picture; false where it turned out that a tile is damaged, or where it was stopped: then there are no files.
  bool write(const std::string& exr, const std::string& png) {
    ImageHeader header = header_of_picture();
    PictureFiles files{{exr, header}, {}};
    if (!png.empty()) files.png.emplace(png, header.width_px, header.height_px);
    if (!read_tiles(&files)) return false;
    files.exr.commit();
    if (files.png) files.png->commit();
    return true;
  }

  bool is_stopped() const { return options_.stop_request && *options_.stop_request != 0; }

  /// Of the tiles that count.
  double sum_of(double TileReport::* number) const {
    double sum = 0;
    for (const TileReport& report : survey_.tiles) sum += counts(report) ? report.*number : 0;
    return sum;
  }

 private:
  bool counts(const TileReport& report) const {
    return report.state == TileState::done || (report.state == TileState::partial && options_.allow_partial);
  }

  Film empty_film(const PixelBox& box) const { return Film(survey_.job.width_px, survey_.job.height_px, box, settings_.film, to_rgb_); }

  ImageHeader header_of_rows(int y0, int y1) const {
    ImageHeader header = empty_film({0, 0, 1, 1}).image_header();
    header.box = {0, y0, header.width_px, y1};
    return header;
  }

  ImageHeader header_of_picture() const {
    ImageHeader header = header_of_rows(0, survey_.job.height_px);
    describe(header.metadata, settings_, sum_of(&TileReport::samples) / static_cast<double>(header.box.pixels()),
             sum_of(&TileReport::render_seconds));
    return header;
  }

  /// Reads a tile, which verifies it, and puts its pixels in their place in the picture if there is one.
  void read(long long tile, Image* picture) const {
    const TileJob& job = survey_.job;
    const bool is_done = survey_.tiles[static_cast<std::size_t>(tile)].state == TileState::done;
    const std::string path = is_done ? tile_path(folder_, job.tiles, tile) : checkpoint_path(folder_, job.tiles, tile);
    if (!picture) {
      verify_film(path);
      return;
    }
    Film film = empty_film(tile_box(job.width_px, job.height_px, job.tiles, tile));
    read_film(path, id_of(job), film);
    film.put_into(*picture);
  }

  /// The pixels of a band; marks damaged tiles, after which there are none any more.
  std::shared_ptr<Strip> read(const Band& band, const PictureFiles* files) {
    auto strip = std::make_shared<Strip>();
    const bool is_writing = files && !is_spoiled_;
    if (is_writing) strip->image = Image(header_of_rows(band.y0, band.y1));
    tbb::parallel_for(band.first, band.end, [&](long long tile) {
      TileReport& report = survey_.tiles[static_cast<std::size_t>(tile)];
      if (!counts(report)) return;
      try {
        read(tile, is_writing ? &strip->image : nullptr);
      } catch (const Error& error) {
        if (error.fault() != Fault::incomplete) throw;
        report = {report.state == TileState::done ? TileState::damaged : TileState::missing, 0, 0, 0, error.what()};
        is_spoiled_ = true;
      }
    });
    if (is_writing && files->png) strip->shown = tone_mapped(strip->image, tone_);
    return strip;
  }

  std::size_t bands_at_a_time() const {
    constexpr double most_bytes = 1 << 29;
    constexpr std::size_t most = 4;  // both files are written while others are read
    int height_px = 0;
    for (const Band& band : bands_) height_px = std::max(height_px, band.y1 - band.y0);
    const ImageHeader header = header_of_rows(0, height_px);
    const double bytes = static_cast<double>(header.box.pixels()) * static_cast<double>(header.channel_names.size() * sizeof(float));
    return std::clamp<std::size_t>(static_cast<std::size_t>(most_bytes / bytes), 1, most);
  }

  /// Reads all tiles that count. The picture goes to the files as long as no tile is damaged; gives whether all of it did.
  bool read_tiles(PictureFiles* files) {
    is_spoiled_ = false;
    std::size_t next = 0;
    constexpr auto in_order = tbb::filter_mode::serial_in_order;
    const auto number = tbb::make_filter<void, std::size_t>(in_order, [&](tbb::flow_control& flow) {
      if (next == bands_.size() || is_stopped()) flow.stop();
      return next++;
    });
    const auto pixels = tbb::make_filter<std::size_t, std::shared_ptr<Strip>>(
        tbb::filter_mode::parallel, [&](std::size_t band) { return read(bands_[band], files); });
    const auto to_png = tbb::make_filter<std::shared_ptr<Strip>, std::shared_ptr<Strip>>(in_order, [&](std::shared_ptr<Strip> strip) {
      if (files && files->png && !is_spoiled_) files->png->append(strip->shown.rgb);
      return strip;
    });
    const auto to_exr = tbb::make_filter<std::shared_ptr<Strip>, void>(in_order, [&](const std::shared_ptr<Strip>& strip) {
      if (files && !is_spoiled_) files->exr.append(strip->image.values());
    });
    tbb::parallel_pipeline(bands_at_a_time(), number & pixels & to_png & to_exr);
    return !is_spoiled_ && !is_stopped();
  }

  std::string folder_;
  TileSurvey& survey_;
  MergeOptions options_;
  SceneSettings settings_;
  ToRgb to_rgb_;
  ToneSettings tone_;
  std::vector<Band> bands_;
  std::atomic<bool> is_spoiled_ = false;  ///< a tile turned out to be damaged
};

}  // namespace

Merge merge_tiles(const std::string& folder, const std::string& exr, const std::string& png, const MergeOptions& options) {
  TileSurvey survey = survey_tiles(folder, false);
  Joining joining(folder, survey, options);
  bool is_written = false;
  if (is_whole_but_foreign(survey) || !(options.allow_partial || survey.to_make().empty()))
    joining.verify();
  else  // Each time it fails at least one more tile is left out.
    while (!(is_written = joining.write(exr, png)) && options.allow_partial && !joining.is_stopped()) {}
  if (!is_written && joining.is_stopped()) return {.is_complete = false};
  if (options.repair)
    for (const long long tile : survey.in_state(TileState::damaged)) std::filesystem::remove(tile_path(folder, survey.job.tiles, tile));
  if (is_whole_but_foreign(survey)) throw foreign(folder, survey);
  if (!is_written) throw incomplete(folder, survey, options.repair);
  return {.refused = joining.sum_of(&TileReport::refused), .left_out = survey.to_make()};
}

}  // namespace arcus::render
