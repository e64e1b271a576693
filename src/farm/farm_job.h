#pragma once
// A farm: the pictures of one scene, in tiles, in a folder, as tasks that an engine runs by their number.
//
//   farm.json        what is to be made, so that the same command goes on with it
//   tasks.txt        a line for each command of a task: its number, a tab, the command
//   task.sh          runs one task by its number, for any engine
//   merge.sh         joins the tiles of all frames
//   log/             what tasks have said
//   job.json, tile_...            tiles (src/render/tile_folder.h), or
//   frame_0007/job.json, ...      those of a frame

#include <optional>
#include <string>
#include <vector>

#include "src/farm/frames.h"

namespace arcus::farm {

struct FarmJob {
  std::string program;                 ///< the command that workers start
  std::string scene;                   ///< file
  std::string folder;                  ///< of the tiles
  std::string picture;                 ///< OUT.exr; frames get their number before the ending
  std::vector<std::string> overrides;  ///< as typed, with what changes from frame to frame
  std::optional<FrameRange> frames;
  long long tiles = 1;                 ///< of a frame
  long long tiles_per_task = 1;
  std::vector<std::string> worker_options;  ///< of `arcus tile`, that change no pixel
  std::vector<std::string> merge_options;   ///< of `arcus merge`

  long long frame_count() const { return frames ? frames->count() : 1; }
  long long task_count() const { return (tiles * frame_count() + tiles_per_task - 1) / tiles_per_task; }
};

/// Tiles of one frame that one command renders.
struct TaskPart {
  long long frame = 0;           ///< from 0
  std::vector<long long> tiles;  ///< ascending
};

/// What a task renders, in order. 0 <= task < task_count(). Tiles are dealt like cards, frame after frame: each task gets some from all over the
/// picture, and takes about as long as any other, where tiles in a row would all be cloud or all be sky.
std::vector<TaskPart> parts_of(const FarmJob& job, long long task);
/// The task that renders a tile of a frame.
long long task_of(const FarmJob& job, long long frame, long long tile);

/// Overrides in a frame, counted from 0.
std::vector<std::string> overrides_of(const FarmJob& job, long long frame);
/// Folder of a frame's tiles.
std::string folder_of(const FarmJob& job, long long frame);
/// Picture of a frame: OUT.exr, or OUT.0007.exr.
std::string picture_of(const FarmJob& job, long long frame);

/// A word as a shell takes it.
std::string shell_quoted(const std::string& word);
/// As a shell takes it: `arcus tile ...`.
std::string command_of(const FarmJob& job, const TaskPart& part);
/// What joins a frame's tiles, word by word: `arcus merge ...`.
std::vector<std::string> merge_words_of(const FarmJob& job, long long frame);

std::string record_path(const std::string& folder);
/// Nothing where there is none. Throws Fault::mismatch where it is damaged.
std::optional<FarmJob> read_farm(const std::string& folder);

/// What makes two farms different, for a message; empty where the same tasks make the same pictures.
std::string difference(const FarmJob& there, const FarmJob& here);

/// Writes farm.json, tasks.txt, task.sh and merge.sh. retries: how often a task that was interrupted is put back by task.sh where only that
/// can do it (Slurm).
void write_farm(const FarmJob& job, int retries);

/// Where a task's messages are.
std::string log_path(const FarmJob& job, long long task);

}  // namespace arcus::farm
