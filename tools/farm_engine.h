#pragma once
// Engines that run the tasks of a farm: GNU parallel here and on hosts with ssh, Slurm on a cluster.

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "src/farm/farm_job.h"

namespace arcus::tools {

struct EngineOptions {
  long long jobs = 0;      ///< workers at once; 0: as many as the engine likes
  int threads = 0;         ///< of a worker; 0: all that it finds
  int retries = 3;         ///< of a task that was interrupted
  std::string hosts;       ///< of GNU parallel: --sshlogin
  std::vector<std::string> more;  ///< options for parallel or sbatch
};

class Engine {
 public:
  virtual ~Engine() = default;
  /// How many tasks it takes at once; 0: any number.
  virtual long long most_tasks() const { return 0; }
  /// Whether tasks that an earlier command has handed over are still there.
  virtual bool goes_on(const farm::FarmJob& job) = 0;
  /// Hands tasks over. Throws cannot() where the engine refuses.
  virtual void start(const farm::FarmJob& job, const std::vector<long long>& tasks) = 0;
  /// Whether there are tasks still, or their merge. Called about once a second or less often.
  virtual bool is_running() = 0;
  /// The command was interrupted: ends what ends with it, and says what goes on.
  virtual void leave() = 0;
};

using Say = std::function<void(std::string_view)>;

/// Throws cannot() where GNU parallel is not there.
std::unique_ptr<Engine> make_parallel_engine(const EngineOptions& options, const Say& say);
/// Throws cannot() where Slurm's commands are not there, or its controller does not answer.
std::unique_ptr<Engine> make_slurm_engine(const EngineOptions& options, const Say& say);

}  // namespace arcus::tools
