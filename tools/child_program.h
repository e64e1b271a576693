#pragma once
// Other programs, started and listened to.

#include <string>
#include <vector>

namespace arcus::tools {

struct Said {
  int code = 0;      ///< its exit code; 127 where there is no such program
  std::string text;  ///< standard output and error
};

/// Runs a program and waits for it.
Said run_program(const std::vector<std::string>& words);

/// A program that runs beside this one, in a process group of its own: Ctrl-C on the terminal does not reach it.
class ChildProgram {
 public:
  /// Its output goes where that of this program goes. Throws cannot() where it cannot be started.
  explicit ChildProgram(const std::vector<std::string>& words);
  ChildProgram(const ChildProgram&) = delete;
  ChildProgram& operator=(const ChildProgram&) = delete;
  /// Waits for its end.
  ~ChildProgram();

  bool is_running();
  void send(int signal);

 private:
  int process_ = 0;
  bool has_ended_ = false;
};

}  // namespace arcus::tools
