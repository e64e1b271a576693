#include "tools/child_program.h"

#include <spawn.h>
#include <sys/wait.h>

#include <csignal>
#include <cstdio>
#include <cstring>

#include "phase/base/error.h"
#include "src/farm/farm_job.h"

extern char** environ;

namespace arcus::tools {

Said run_program(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += farm::shell_quoted(word) + " ";
  std::FILE* const pipe = ::popen((line + "2>&1 </dev/null").c_str(), "r");
  if (!pipe) throw cannot("cannot start " + words.front(), std::strerror(errno));
  Said said;
  char buffer[4096];
  while (const std::size_t count = std::fread(buffer, 1, sizeof buffer, pipe)) said.text.append(buffer, count);
  const int status = ::pclose(pipe);
  said.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  while (!said.text.empty() && said.text.back() == '\n') said.text.pop_back();
  return said;
}

ChildProgram::ChildProgram(const std::vector<std::string>& words) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawnattr_t attributes;
  ::posix_spawnattr_init(&attributes);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  ::posix_spawnattr_setpgroup(&attributes, 0);
  pid_t process = 0;
  const int fault = ::posix_spawnp(&process, arguments[0], nullptr, &attributes, arguments.data(), environ);
  ::posix_spawnattr_destroy(&attributes);
  if (fault != 0) throw cannot("cannot start " + words.front(), std::strerror(fault));
  process_ = process;
}

ChildProgram::~ChildProgram() {
  if (!has_ended_) ::waitpid(process_, nullptr, 0);
}

bool ChildProgram::is_running() {
  if (!has_ended_) has_ended_ = ::waitpid(process_, nullptr, WNOHANG) != 0;
  return !has_ended_;
}

void ChildProgram::send(int signal) {
  if (is_running()) ::kill(process_, signal);
}

}  // namespace arcus::tools
