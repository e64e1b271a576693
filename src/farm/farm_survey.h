#pragma once
// What of a farm is there.

#include <vector>

#include "src/farm/farm_job.h"
#include "src/scene/settings.h"

namespace arcus::farm {

/// Throws Fault::mismatch where the folder of a frame holds tiles of something else than `settings` in as many tiles. is_thorough: holds the content
/// of the scene's files against them as well, otherwise the settings alone.
void check_belongs(const FarmJob& job, long long frame, const render::SceneSettings& settings, bool is_thorough);

/// Tasks with a tile that is not there, or damaged; reads every byte of those that are. Throws Fault::mismatch where one is of something else.
std::vector<long long> tasks_to_do(const FarmJob& job);

/// How many tiles there are, by the names of files alone.
long long count_tiles(const FarmJob& job);

/// Whether a frame's picture is there and no older than its tiles.
bool is_merged(const FarmJob& job, long long frame);

}  // namespace arcus::farm
