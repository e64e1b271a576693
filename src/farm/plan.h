#pragma once
// Into how many tiles a picture is cut, and how many of them make a task of an engine.

namespace arcus::farm {

/// What the choice goes by.
struct Workload {
  double thread_seconds = 0;   ///< rendering of one frame, by one thread
  double start_seconds = 0;    ///< what a worker takes before it renders
  int width_px = 0, height_px = 0;
  long long frames = 1;
  int threads = 1;             ///< of a worker
  long long workers = 0;       ///< at once; 0: not known
  long long most_tasks = 0;    ///< that the engine takes; 0: any number
  long long tiles = 0;         ///< of a frame, where it is given; 0: to be chosen
};

struct Plan {
  long long tiles = 1;           ///< of a frame
  long long tiles_per_task = 1;  ///< at most
  long long tasks = 1;
  double task_seconds = 0;       ///< that a task will take, about
};

/// A tile takes about a minute, but there are at least four of them for each worker, since their work is unequal; none is smaller than the
/// renderer's own blocks. A task has as many tiles as make a minute of work and forty times the worker's start, so that starting costs 2.5 % at
/// most; fewer where workers would have nothing to do; more where the engine takes no more tasks.
Plan plan_of(const Workload& workload);

}  // namespace arcus::farm
