#pragma once
// The shell scripts that engines start.

#include <string>
#include <vector>

namespace arcus::farm {

/// Runs the commands of one task, by its number: the argument, or what Slurm, PBS, Kubernetes, Grid Engine or LSF say. Ends with 0, with what a
/// command ended with, or with 75 where one was killed. Under Slurm an interrupted task puts itself back into the queue, at most `retries` times.
std::string task_script(const std::string& folder, int retries);

/// Runs all of the commands; ends with the first code that is not 0.
std::string merge_script(const std::vector<std::string>& commands);

}  // namespace arcus::farm
