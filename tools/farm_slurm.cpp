// Slurm: tasks of a farm as a job array, and a merge that waits for them.

#include <chrono>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

#include <nlohmann/json.hpp>

#include "phase/base/error.h"
#include "phase/base/whole_file.h"
#include "tools/child_program.h"
#include "tools/farm_engine.h"

namespace arcus::tools {
namespace {

/// "0-3,7": Slurm's lists may be no longer than some kilobytes.
std::string ranges_of(const std::vector<long long>& tasks) {
  std::string text;
  for (std::size_t i = 0; i < tasks.size();) {
    std::size_t last = i;
    while (last + 1 < tasks.size() && tasks[last + 1] == tasks[last] + 1) ++last;
    text += (text.empty() ? "" : ",") + std::to_string(tasks[i]) + (last > i ? "-" + std::to_string(tasks[last]) : "");
    i = last + 1;
  }
  return text;
}

/// Jobs that an earlier command or this one has handed over.
struct Handed {
  std::string array, merge;
};

class SlurmEngine : public Engine {
 public:
  SlurmEngine(const EngineOptions& options, const Say& say) : options_(options), say_(say) {
    const Said config = run_program({"scontrol", "show", "config"});
    if (config.code == 127) throw cannot("Slurm's commands cannot be started", "run this where `sbatch` is there, or choose --engine print");
    if (config.code != 0) throw cannot("Slurm does not answer", config.text);
    const std::size_t at = config.text.find("MaxArraySize");
    if (at != std::string::npos) most_tasks_ = std::atoll(config.text.c_str() + config.text.find('=', at) + 1);
  }

  long long most_tasks() const override { return most_tasks_; }

  bool goes_on(const farm::FarmJob& job) override {
    std::ifstream in(record_path(job));
    const auto record = nlohmann::json::parse(in, nullptr, false);
    if (!record.is_object()) return false;
    handed_ = {record.value("array", ""), record.value("merge", "")};
    if (!is_running()) return false;
    say_("going on with what is in the queue: " + names());
    return true;
  }

  void start(const farm::FarmJob& job, const std::vector<long long>& tasks) override {
    const std::filesystem::path folder(job.folder);
    std::vector<std::string> words{"--requeue", "--job-name=" + std::filesystem::path(job.scene).stem().string(), "--open-mode=append",
                                   "--array=" + ranges_of(tasks) + (options_.jobs > 0 ? "%" + std::to_string(options_.jobs) : ""),
                                   "--cpus-per-task=" + std::to_string(std::max(1, options_.threads)), "--signal=B:USR1@60",
                                   "--output=" + (folder / "log" / "slurm_%a.txt").string()};
    words.insert(words.end(), options_.more.begin(), options_.more.end());
    words.push_back((folder / "task.sh").string());
    handed_ = {submit(words), ""};
    write_record(job);
    words = {"--requeue", "--dependency=afterany:" + handed_.array, "--job-name=" + std::filesystem::path(job.scene).stem().string() + "-merge",
             "--output=" + (folder / "log" / "merge.txt").string()};
    words.insert(words.end(), options_.more.begin(), options_.more.end());
    words.push_back((folder / "merge.sh").string());
    handed_.merge = submit(words);
    write_record(job);
    say_("submitted: " + names());
  }

  bool is_running() override {
    const std::string jobs = handed_.array + (handed_.merge.empty() ? "" : "," + handed_.merge);
    const Said queue = run_program({"squeue", "--noheader", "--jobs=" + jobs, "--format=%A %F %T %r"});
    const bool is_unknown = queue.text.find("Invalid job id") != std::string::npos;
    if (queue.code != 0 && !is_unknown) {
      if (!is_silent_) say_("Slurm does not answer; waiting for it: " + queue.text);
      return is_silent_ = true;
    }
    is_silent_ = false;
    return is_under_way(queue.text);
  }

  void leave() override {
    say_("what was submitted goes on: " + names() + ". The same command watches it again; `scancel " + handed_.array + " " + handed_.merge + "` ends it");
  }

 private:
  /// By lines of squeue: job, job of its array, state, reason. A merge that has waited for a minute since the tasks are done is not waited for: the
  /// queue is full, or it is held, and merging here does no harm.
  bool is_under_way(const std::string& queue) {
    using Clock = std::chrono::steady_clock;
    bool has_tasks = false, has_merge = false, is_merging = false, is_held = false, has_others = false;
    std::istringstream lines(queue);
    std::string job, array, state, reason;
    while (lines >> job >> array >> state && std::getline(lines, reason)) {
      if (array == handed_.array) {
        has_tasks = true;
        (reason.find("held") != std::string::npos || reason.find("Held") != std::string::npos ? is_held : has_others) = true;
      } else if (job == handed_.merge) {
        has_merge = true;
        is_merging = state != "PENDING";
      }
    }
    if (is_held && !has_others && !said_held_) {
      say_("Slurm holds what is left of job " + handed_.array + ": `squeue -j " + handed_.array + "` says why, `scontrol release " + handed_.array + "` lets it go on");
      said_held_ = true;
    }
    if (has_tasks || is_merging) {
      tasks_done_.reset();
      return true;
    }
    if (!has_merge) return false;
    if (!tasks_done_) tasks_done_ = Clock::now();
    return Clock::now() - *tasks_done_ < std::chrono::minutes(1);
  }

  static std::string record_path(const farm::FarmJob& job) { return (std::filesystem::path(job.folder) / "slurm.json").string(); }

  void write_record(const farm::FarmJob& job) const {
    write_whole_file(record_path(job), nlohmann::ordered_json{{"array", handed_.array}, {"merge", handed_.merge}}.dump(1) + "\n");
  }

  std::string names() const { return "job array " + handed_.array + ", merge " + handed_.merge; }

  static std::string submit(std::vector<std::string> words) {
    words.insert(words.begin(), {"sbatch", "--parsable"});
    const Said said = run_program(words);
    // The number is on a line of its own; warnings may stand before it. A cluster's name may follow it.
    const std::size_t line = said.text.rfind('\n') == std::string::npos ? 0 : said.text.rfind('\n') + 1;
    const std::string number = said.text.substr(line, said.text.find_first_not_of("0123456789", line) - line);
    if (said.code != 0 || number.empty()) throw cannot("Slurm does not take the job", said.text);
    return number;
  }

  EngineOptions options_;
  Say say_;
  long long most_tasks_ = 0;
  Handed handed_;
  bool is_silent_ = false, said_held_ = false;
  std::optional<std::chrono::steady_clock::time_point> tasks_done_;  ///< since when only a merge that waits is left
};

}  // namespace

std::unique_ptr<Engine> make_slurm_engine(const EngineOptions& options, const Say& say) { return std::make_unique<SlurmEngine>(options, say); }

}  // namespace arcus::tools
