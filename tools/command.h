#pragma once
// What all subcommands share: the program's frame, its exit codes and interruption.

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <atomic>
#include <string>

namespace arcus::tools {

/// Exit codes beside those of arcus::Fault.
inline constexpr int exit_done = 0, exit_try_again = 75, exit_interrupted = 130, exit_terminated = 143;

/// The signal that asked the program to stop (SIGINT, SIGTERM), or 0. A second one ends it at once.
const std::atomic<int>& stop_request();

/// Makes SIGINT and SIGTERM set stop_request().
void watch_for_interruption();

/// Makes SIGTERM end the program at once with exit_try_again, until watch_for_interruption(): for a unit of work that has nothing
/// to save yet.
void leave_on_termination();

/// What a subcommand returns where it is not done: ends the program with that code after all output is written.
struct Exit {
  int code;
};

// Each adds its subcommand to the program.
void add_render(CLI::App& program);
void add_tile(CLI::App& program);
void add_merge(CLI::App& program);
void add_status(CLI::App& program);
void add_farm(CLI::App& program);
void add_author(CLI::App& program);
void add_phase(CLI::App& program);
void add_info(CLI::App& program);
void add_profile(CLI::App& program);
void add_compare(CLI::App& program);
void add_compare_droplets(CLI::App& program);
void add_reference(CLI::App& program);

}  // namespace arcus::tools
