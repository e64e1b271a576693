#include "src/farm/farm_survey.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include "phase/base/error.h"
#include "phase/settings/toml_text.h"
#include "src/render/tile_folder.h"

namespace arcus::farm {
namespace {

namespace fs = std::filesystem;

bool is_tile(const fs::directory_entry& entry) {
  const std::string name = entry.path().filename().string();
  return name.starts_with("tile_") && name.ends_with(".tile");
}

/// Calls visit(entry) for every tile in the folder of a frame; there may be no such folder.
template <class Visit>
void for_tiles(const FarmJob& job, long long frame, const Visit& visit) {
  std::error_code error;
  for (fs::directory_iterator entry(folder_of(job, frame), error), end; !error && entry != end; entry.increment(error))
    if (is_tile(*entry)) visit(*entry);
}

std::vector<long long> tiles_to_make(const FarmJob& job, long long frame) {
  bool has_any = render::read_record(folder_of(job, frame)).has_value();
  for_tiles(job, frame, [&](const fs::directory_entry&) { has_any = true; });
  if (has_any) {
    const render::TileSurvey survey = render::survey_tiles(folder_of(job, frame), true);
    if (const std::string why = survey.first_reason(render::TileState::foreign); !why.empty())
      throw Error(Fault::mismatch, why + ". Choose another folder, or delete it");
    if (survey.job.tiles == job.tiles) return survey.to_make();
    throw Error(Fault::mismatch, folder_of(job, frame) + ": holds " + std::to_string(survey.job.tiles) + " tiles a picture, not " + std::to_string(job.tiles) +
                                     ". Choose another folder, or say --tiles " + std::to_string(survey.job.tiles));
  }
  std::vector<long long> all(static_cast<std::size_t>(job.tiles));
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<long long>(i);
  return all;
}

}  // namespace

void check_belongs(const FarmJob& job, long long frame, const render::SceneSettings& settings, bool is_thorough) {
  const std::string folder = folder_of(job, frame);
  const auto there = render::read_record(folder);
  if (!there) return;
  std::string why;
  if (is_thorough) {
    why = render::difference(*there, render::tile_job(settings, there->tiles));
  } else {
    render::TileJob here = *there;
    here.scene_text = text_of(settings);
    if (here.scene_text != there->scene_text) {
      here.scene.hash = "another";
      why = render::difference(*there, here);
    }
  }
  if (!why.empty()) throw Error(Fault::mismatch, folder + ": holds tiles of something else: " + why + ". Choose another folder, or delete it");
}

std::vector<long long> tasks_to_do(const FarmJob& job) {
  std::set<long long> tasks;
  for (long long frame = 0; frame < job.frame_count(); ++frame)
    for (const long long tile : tiles_to_make(job, frame)) tasks.insert(task_of(job, frame, tile));
  return {tasks.begin(), tasks.end()};
}

long long count_tiles(const FarmJob& job) {
  long long count = 0;
  for (long long frame = 0; frame < job.frame_count(); ++frame) for_tiles(job, frame, [&](const fs::directory_entry&) { ++count; });
  return count;
}

bool is_merged(const FarmJob& job, long long frame) {
  std::error_code error;
  const auto merged = fs::last_write_time(picture_of(job, frame), error);
  if (error) return false;
  bool is_newest = true;
  for_tiles(job, frame, [&](const fs::directory_entry& tile) { is_newest = is_newest && tile.last_write_time(error) <= merged; });
  return is_newest && !error;
}

}  // namespace arcus::farm
