#include "src/farm/plan.h"

#include <algorithm>
#include <cmath>

namespace arcus::farm {
namespace {

constexpr double tile_seconds = 60, starts_per_task = 40;
constexpr long long tiles_per_worker = 4, smallest_tile_px = 256, most_tiles = 40'000;

long long divided_up(long long a, long long b) { return (a + b - 1) / b; }

long long whole(double value) { return std::llround(std::clamp(std::ceil(value), 1.0, 1e15)); }

}  // namespace

Plan plan_of(const Workload& load) {
  const double frame_seconds = load.thread_seconds / load.threads;
  const long long pixels = static_cast<long long>(load.width_px) * load.height_px;
  Plan plan;
  plan.tiles = load.tiles;
  if (plan.tiles == 0) {
    const long long for_workers = divided_up(tiles_per_worker * load.workers, load.frames);
    plan.tiles = std::max(whole(frame_seconds / tile_seconds), for_workers);
    plan.tiles = std::clamp(plan.tiles, 1LL, std::clamp(pixels / smallest_tile_px, 1LL, most_tiles));
  }
  const long long all = plan.tiles * load.frames;
  const double seconds = frame_seconds / static_cast<double>(plan.tiles);
  plan.tiles_per_task = seconds > 0 ? whole(std::max(tile_seconds, starts_per_task * load.start_seconds) / seconds) : all;
  if (load.workers > 0) plan.tiles_per_task = std::min(plan.tiles_per_task, divided_up(all, load.workers * tiles_per_worker));
  if (load.most_tasks > 0) plan.tiles_per_task = std::max(plan.tiles_per_task, divided_up(all, load.most_tasks));
  plan.tiles_per_task = std::clamp(plan.tiles_per_task, 1LL, all);
  plan.tasks = divided_up(all, plan.tiles_per_task);
  plan.task_seconds = seconds * static_cast<double>(plan.tiles_per_task);
  return plan;
}

}  // namespace arcus::farm
