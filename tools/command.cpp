#include "tools/command.h"

#include <unistd.h>

#include <csignal>

namespace arcus::tools {
namespace {

std::atomic<int> requested_stop{0};
static_assert(std::atomic<int>::is_always_lock_free, "set from a signal handler");

extern "C" void on_signal(int signal) {
  requested_stop = signal;
  std::signal(signal, SIG_DFL);  // the second one ends the program at once
}

extern "C" void on_early_signal(int) { ::_exit(exit_try_again); }

}  // namespace

const std::atomic<int>& stop_request() { return requested_stop; }

void watch_for_interruption() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
}

void leave_on_termination() { std::signal(SIGTERM, on_early_signal); }

}  // namespace arcus::tools
