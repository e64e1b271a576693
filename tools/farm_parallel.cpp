// GNU parallel: tasks of a farm on this machine, or on hosts with ssh and a common file system.

#include <csignal>
#include <filesystem>

#include "phase/base/error.h"
#include "phase/base/whole_file.h"
#include "tools/child_program.h"
#include "tools/farm_engine.h"

namespace arcus::tools {
namespace {

class ParallelEngine : public Engine {
 public:
  explicit ParallelEngine(const EngineOptions& options) : options_(options) {
    const Said version = run_program({"parallel", "--version"});  // another program of this name is in moreutils
    if (version.code != 0 || !version.text.starts_with("GNU parallel"))
      throw cannot("GNU parallel cannot be started", "install the package `parallel`, or choose --engine print");
  }

  bool goes_on(const farm::FarmJob&) override { return false; }  // its tasks end with the command

  void start(const farm::FarmJob& job, const std::vector<long long>& tasks) override {
    const std::filesystem::path folder(job.folder);
    std::string numbers;
    for (const long long task : tasks) numbers += std::to_string(task) + "\n";
    write_whole_file((folder / "todo.txt").string(), numbers);
    std::vector<std::string> words{"parallel", "--will-cite", "--ungroup", "--retries", std::to_string(options_.retries + 1),
                                   "--joblog", "+" + (folder / "joblog.tsv").string(), "--arg-file", (folder / "todo.txt").string(),
                                   // A minute for the checkpoint; its own sequence sends TERM twice, and the second one ends a worker at once.
                                   "--termseq", "TERM,60000,KILL,25"};
    words.insert(words.end(), {"--jobs", std::to_string(std::max(1LL, options_.jobs))});
    if (!options_.hosts.empty()) words.insert(words.end(), {"--sshlogin", options_.hosts, "--workdir", std::filesystem::current_path().string()});
    words.insert(words.end(), options_.more.begin(), options_.more.end());
    words.insert(words.end(), {"sh", farm::shell_quoted((folder / "task.sh").string()), "{}"});
    program_ = std::make_unique<ChildProgram>(words);
  }

  bool is_running() override { return program_ && program_->is_running(); }

  void leave() override {
    program_->send(SIGTERM);  // no new ones, and its sequence of signals to those that run
    program_.reset();         // when they have left their checkpoints
  }

 private:
  EngineOptions options_;
  std::unique_ptr<ChildProgram> program_;
};

}  // namespace

std::unique_ptr<Engine> make_parallel_engine(const EngineOptions& options, const Say&) { return std::make_unique<ParallelEngine>(options); }

}  // namespace arcus::tools
