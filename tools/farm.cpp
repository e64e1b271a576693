// arcus farm: pictures in tiles, planned, handed to an engine, watched and merged.

#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <thread>

#include "phase/base/error.h"
#include "phase/base/whole_file.h"
#include "phase/species/species_cache.h"
#include "src/farm/farm_survey.h"
#include "src/farm/pilot.h"
#include "src/farm/plan.h"
#include "src/render/tile_job.h"
#include "src/scene/fingerprint.h"
#include "tools/child_program.h"
#include "tools/command.h"
#include "tools/farm_engine.h"
#include "tools/progress.h"

namespace arcus::tools {
namespace {

namespace fs = std::filesystem;

struct FarmCommand {
  std::string scene, folder, output, engine = "local", frames, cache_folder, program, progress = "auto";
  std::vector<std::string> overrides;
  long long tiles = 0, tiles_per_task = 0;
  double checkpoint_s = 60;
  bool no_png = false, quiet = false, no_wait = false;
  EngineOptions engine_options;
};

/// This program, as workers find it.
std::string own_path() {
  std::error_code error;
  const fs::path path = fs::read_symlink("/proc/self/exe", error);
  return error ? "arcus" : path.string();
}

render::SceneSettings settings_of(const farm::FarmJob& job, long long frame) { return render::read_scene(job.scene, farm::overrides_of(job, frame)); }

farm::FarmJob job_of(const FarmCommand& command) {
  farm::FarmJob job;
  job.program = command.program.empty() ? own_path() : command.program;
  job.scene = command.scene;
  job.folder = command.folder;
  job.picture = command.output.empty() ? (fs::path(command.folder) / fs::path(command.scene).stem()).string() + ".exr" : command.output;
  if (fs::path(job.picture).extension() != ".exr")
    throw bad_input("-o", "'" + job.picture + "'", "a name that ends in .exr expected", "A .png is written beside it");
  job.overrides = command.overrides;
  if (!command.frames.empty()) job.frames = farm::read_frame_range(command.frames, "--frames");
  const bool varies = std::any_of(job.overrides.begin(), job.overrides.end(), farm::varies);
  if (job.frames && job.frames->count() > 1 && !varies)
    throw bad_input("--frames", "no --set that changes from frame to frame", "one with FROM..TO or {frame} expected", "For instance --set sun.elevation_deg=5..30");
  if (command.engine_options.threads > 0) job.worker_options.insert(job.worker_options.end(), {"--threads", std::to_string(command.engine_options.threads)});
  if (!command.cache_folder.empty()) job.worker_options.insert(job.worker_options.end(), {"--cache", command.cache_folder});
  if (command.checkpoint_s != FarmCommand().checkpoint_s)
    job.worker_options.insert(job.worker_options.end(), {"--checkpoint-seconds", std::to_string(command.checkpoint_s)});
  if (command.no_png) job.merge_options.emplace_back("--no-png");
  job.merge_options.emplace_back("--quiet");
  return job;
}

/// Takes tiles and tasks from what is there already; false where nothing is.
bool go_on_with(const FarmCommand& command, farm::FarmJob& job) {
  const auto there = farm::read_farm(job.folder);
  if (there) {
    job.tiles = command.tiles > 0 ? command.tiles : there->tiles;
    job.tiles_per_task = there->tiles_per_task;
    if (const std::string why = farm::difference(*there, job); !why.empty())
      throw Error(Fault::mismatch, job.folder + ": holds something else: " + why + ". Choose another folder, or delete it");
  } else if (const auto record = render::read_record(farm::folder_of(job, 0)); record && command.tiles == 0) {
    job.tiles = record->tiles;
  }
  return there.has_value();
}

void make_plan(const FarmCommand& command, const Engine* engine, farm::FarmJob& job, long long tiles_there, const Say& say) {
  const render::SceneSettings settings = settings_of(job, 0);
  const long long all_pixels = static_cast<long long>(settings.camera.width_px) * settings.camera.height_px;
  farm::Workload load;
  load.width_px = settings.camera.width_px;
  load.height_px = settings.camera.height_px;
  load.frames = job.frame_count();
  load.threads = std::max(1, command.engine_options.threads > 0 ? command.engine_options.threads : static_cast<int>(std::thread::hardware_concurrency()));
  load.workers = command.engine_options.jobs;
  load.most_tasks = engine ? engine->most_tasks() : 0;
  load.tiles = tiles_there;
  const std::string cache = command.cache_folder.empty() ? phase::default_cache_folder() : command.cache_folder;
  const farm::Pilot pilot = farm::run_pilot(settings, cache, say);
  load.start_seconds = pilot.start_seconds;
  load.thread_seconds = pilot.thread_seconds_a_sample * static_cast<double>(all_pixels) * static_cast<double>(settings.render.samples_per_pixel);
  const farm::Plan plan = farm::plan_of(load);
  job.tiles = plan.tiles;
  job.tiles_per_task = command.tiles_per_task > 0 ? command.tiles_per_task : plan.tiles_per_task;
  char line[200];
  std::snprintf(line, sizeof line, "%lld frame%s of about %.3g thread-seconds; %lld tiles each, %lld a task: %lld tasks", load.frames,
                load.frames == 1 ? "" : "s", load.thread_seconds, job.tiles, job.tiles_per_task, job.task_count());
  say(line);
}

/// The last line of a file; empty where there is none.
std::string last_line(const std::string& path) {
  std::ifstream in(path);
  std::string line, last;
  while (std::getline(in, line))
    if (!line.empty()) last = line;
  return last;
}

/// Says what tasks that are not done have said last, three of them.
void say_why(const farm::FarmJob& job, const std::vector<long long>& tasks) {
  constexpr std::size_t most = 3;
  for (std::size_t i = 0; i < std::min(most, tasks.size()); ++i)
    if (const std::string last = last_line(farm::log_path(job, tasks[i])); !last.empty())
      std::cerr << "arcus: task " << tasks[i] << ": " << last << '\n';
  std::cerr << "arcus: " << tasks.size() << " of " << job.task_count() << " tasks are not done; what they said is in " << (fs::path(job.folder) / "log").string()
            << ". The same command goes on\n";
}

/// Watches until the engine is done. False where that was interrupted.
bool watch(const FarmCommand& command, const farm::FarmJob& job, Engine& engine) {
  using Clock = std::chrono::steady_clock;
  const auto seconds_since = [](Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); };
  const auto report = command.quiet ? nullptr : progress_report(command.progress);
  const render::SceneSettings settings = settings_of(job, 0);
  const double samples_a_tile = static_cast<double>(settings.render.samples_per_pixel) * settings.camera.width_px * settings.camera.height_px / static_cast<double>(job.tiles);
  const auto samples = [&] { return samples_a_tile * static_cast<double>(farm::count_tiles(job)); };
  const Clock::time_point begin = Clock::now();
  const double before = samples(), in_all = samples_a_tile * static_cast<double>(job.tiles * job.frame_count());
  while (engine.is_running()) {
    const Clock::time_point look = Clock::now();
    if (report) report({seconds_since(begin), before, samples(), in_all});
    // Looking must not become work, for the file system or for Slurm's controller.
    const double pause_s = std::clamp(20 * seconds_since(look) + 0.05 * seconds_since(begin), 0.2, 10.0);
    const Clock::time_point pause = Clock::now();
    while (seconds_since(pause) < pause_s) {
      if (stop_request() != 0) {
        if (report) end_progress(command.progress);
        engine.leave();
        return false;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  }
  if (report) {
    report({seconds_since(begin), before, samples(), in_all});
    end_progress(command.progress);
  }
  return true;
}

/// Merges every frame that has tiles and is not merged yet. The code of the first merge that failed.
int merge_all(const FarmCommand& command, const farm::FarmJob& job) {
  int code = exit_done;
  for (long long frame = 0; frame < job.frame_count(); ++frame) {
    if (!render::read_record(farm::folder_of(job, frame))) continue;  // no worker came to make one
    if (!farm::is_merged(job, frame)) {
      std::vector<std::string> words = farm::merge_words_of(job, frame);
      words[0] = own_path();
      const Said said = run_program(words);
      if (!said.text.empty()) std::cerr << said.text << '\n';
      if (said.code != 0) {
        code = code != 0 ? code : said.code;
        continue;
      }
    }
    if (!command.quiet) std::cerr << farm::picture_of(job, frame) << (command.no_png ? "" : " and .png") << '\n';
  }
  return code;
}

void print_commands(const farm::FarmJob& job, const std::vector<long long>& tasks, const Say& say) {
  for (const long long task : tasks) {
    std::string line;
    for (const farm::TaskPart& part : farm::parts_of(job, task)) line += (line.empty() ? "" : " && ") + farm::command_of(job, part);
    std::cout << line << '\n';
  }
  const std::string folder = farm::shell_quoted(job.folder);
  say("or by number, 0 to " + std::to_string(job.task_count() - 1) + ": sh " + folder + "/task.sh NUMBER; then: sh " + folder + "/merge.sh");
}

void run(FarmCommand command) {
  const auto say = [&](std::string_view text) {
    if (!command.quiet) std::cerr << text << '\n';
  };
  EngineOptions& options = command.engine_options;
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  if (command.engine == "local" && options.jobs == 0) options.jobs = 1;
  if (command.engine == "local" && options.threads == 0 && options.hosts.empty() && options.jobs > 1)
    options.threads = std::max(1, cores / static_cast<int>(std::min<long long>(options.jobs, cores)));
  if (command.engine == "slurm" && options.threads == 0) options.threads = 1;

  farm::FarmJob job = job_of(command);
  const render::SceneSettings first = settings_of(job, 0);
  for (long long frame = 1; frame < job.frame_count(); ++frame) settings_of(job, frame);  // a key that is wrong in the last frame is found now
  const bool goes_on = go_on_with(command, job);
  std::unique_ptr<Engine> engine;
  if (command.engine == "local") engine = make_parallel_engine(options, say);
  if (command.engine == "slurm") engine = make_slurm_engine(options, say);
  for (long long frame = 0; frame < job.frame_count(); ++frame)
    farm::check_belongs(job, frame, frame == 0 ? first : settings_of(job, frame), frame == 0);
  const long long tiles_there = command.tiles > 0 ? command.tiles : render::read_record(farm::folder_of(job, 0)) ? job.tiles : 0;
  if (tiles_there > 0) render::tile_job(first, tiles_there);  // or there are more tiles than pixels
  if (!goes_on && command.tiles > 0 && command.tiles_per_task > 0) {
    job.tiles = command.tiles;
    job.tiles_per_task = command.tiles_per_task;
    render::scene_identity(first);  // a file that is missing is found here and not by a thousand workers
  } else if (!goes_on) {
    make_plan(command, engine.get(), job, tiles_there, say);
  }
  farm::write_farm(job, options.retries);
  check_writable(farm::picture_of(job, 0));

  const std::vector<long long> tasks = farm::tasks_to_do(job);
  if (!engine) return print_commands(job, tasks, say);
  watch_for_interruption();
  if (!engine->goes_on(job)) {
    if (tasks.empty()) say("all tiles are there");
    else engine->start(job, tasks);
  }
  if (command.no_wait) return;
  if (!watch(command, job, *engine)) throw Exit{stop_request() == SIGINT ? exit_interrupted : exit_terminated};
  const int code = merge_all(command, job);
  const std::vector<long long> left = farm::tasks_to_do(job);
  if (!left.empty()) say_why(job, left);
  if (code != 0 || !left.empty()) throw Exit{code != 0 ? code : static_cast<int>(Fault::incomplete)};
}

}  // namespace

void add_farm(CLI::App& program) {
  auto command = std::make_shared<FarmCommand>();
  EngineOptions& engine = command->engine_options;
  CLI::App* app = program.add_subcommand("farm", "Render on many machines: plan, submit, watch, merge; the same command again goes on");
  app->add_option("SCENE", command->scene, "scene file (TOML)")->required();
  app->add_option("--out", command->folder, "folder of the tiles, seen by all machines")->required();
  app->add_option("-o,--output", command->output, "the picture, OUT.exr, or OUT.0001.exr and so on (default: DIR/SCENE.exr)");
  app->add_option("--engine", command->engine, "local (GNU parallel) | slurm | print (the command lines, for any other)")
      ->check(CLI::IsMember({"local", "slurm", "print"}));
  app->add_option("--jobs", engine.jobs, "workers at once (default: 1 with local; as many as there is room for with slurm)")->check(CLI::Range(1LL, 1'000'000LL));
  app->add_option("--threads", engine.threads, "of a worker (default: all cores over --jobs with local, 1 with slurm)")->check(CLI::Range(1, 4096));
  app->add_option("--hosts", engine.hosts, "local: hosts with ssh, as --sshlogin of parallel takes them: 4/one,4/two,:");
  app->add_option("--frames", command->frames, "A:B: an animation; in --set, FROM..TO goes evenly over the frames and {frame} is their number");
  app->add_option("--set", command->overrides, "table.key=VALUE: overrides the scene file; may be repeated")->expected(1)->take_all();
  app->add_option("--tiles", command->tiles, "of a picture (default: about a minute of work each)")->check(CLI::Range(1LL, 1'000'000'000LL));
  app->add_option("--tiles-per-task", command->tiles_per_task, "what one task renders (default: a minute of work or more)")->check(CLI::Range(1LL, 1'000'000'000LL));
  app->add_option("--retries", engine.retries, "how often a task that was killed or interrupted is started again")->check(CLI::Range(0, 1000));
  app->add_option("--engine-option", engine.more, "handed to parallel or sbatch, for instance --engine-option=--partition=long; may be repeated")->expected(1)->take_all();
  app->add_option("--checkpoint-seconds", command->checkpoint_s, "how often a worker writes a checkpoint")->check(CLI::PositiveNumber);
  app->add_option("--program", command->program, "what workers start (default: this program by its full path)");
  app->add_flag("--no-wait", command->no_wait, "slurm: submit, and leave watching and merging to the queue");
  app->add_flag("--no-png", command->no_png, "write the EXR alone");
  app->add_flag("--quiet", command->quiet, "say nothing but errors");
  app->add_option("--progress", command->progress, "auto | json | none")->check(CLI::IsMember({"auto", "json", "none"}));
  app->add_option("--cache", command->cache_folder, "folder of the phase tables, seen by all machines (default: $XDG_CACHE_HOME/arcus/phase)");
  app->callback([command] { run(*command); });
}

}  // namespace arcus::tools
