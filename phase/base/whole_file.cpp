#include "phase/base/whole_file.h"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>

#include "phase/base/error.h"

namespace arcus {
namespace {

/// In the names of this machine's temporary files, between the stem and the process id.
std::string temporary_mark() {
  char host[65] = "";
  ::gethostname(host, sizeof host - 1);
  return std::string(".part") + host + "-";
}

/// How the names of all temporary files of a path begin on this machine.
std::string temporary_stem(const std::filesystem::path& path) { return "." + path.stem().string() + temporary_mark(); }

/// Whether the process whose number stands there still runs; nothing where there is no number.
std::optional<bool> still_runs(std::string_view text) {
  pid_t process = 0;
  const auto [rest, fault] = std::from_chars(text.data(), text.data() + text.size(), process);
  if (fault != std::errc() || process <= 0 || rest == text.data() + text.size() || *rest != '-') return std::nullopt;
  return ::kill(process, 0) == 0 || errno != ESRCH;
}

std::string temporary_name(const std::string& path) {
  static std::atomic<unsigned> number{0};
  const std::filesystem::path target(path);
  const std::string name = temporary_stem(target) + std::to_string(::getpid()) + "-" +
                           std::to_string(number++) + target.extension().string();
  return (target.parent_path() / name).string();
}

/// A name outlives a failing machine only when its folder is on the disk as well. Not every file system can do it for folders.
void flush_folder_of(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  const int file = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0) return;
  ::fsync(file);
  ::close(file);
}

}  // namespace

WholeFile::WholeFile(std::string path) : path_(std::move(path)), temporary_path_(temporary_name(path_)) {
  if (std::filesystem::is_directory(path_)) throw cannot("cannot write " + path_, "it is a folder");
  const int file = ::open(temporary_path_.c_str(), O_CREAT | O_WRONLY | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) throw cannot("cannot write " + path_, std::strerror(errno));
  ::close(file);
}

WholeFile::~WholeFile() {
  if (!committed_) ::unlink(temporary_path_.c_str());
}

void WholeFile::commit() {
  const int file = ::open(temporary_path_.c_str(), O_WRONLY | O_CLOEXEC);
  if (file < 0 || ::fsync(file) != 0) {
    const std::string why = std::strerror(errno);
    if (file >= 0) ::close(file);
    throw cannot("cannot write " + path_, why);
  }
  ::close(file);
  if (std::rename(temporary_path_.c_str(), path_.c_str()) != 0)
    throw cannot("cannot write " + path_, std::strerror(errno));
  committed_ = true;
  flush_folder_of(path_);
}

void write_whole_file(const std::string& path, std::string_view content) {
  WholeFile whole(path);
  {
    std::ofstream file(whole.temporary_path(), std::ios::binary);
    file.write(content.data(), static_cast<std::streamsize>(content.size()));
    file.flush();
    if (!file) throw cannot("cannot write " + path, std::strerror(errno));
  }
  whole.commit();
}

void remove_abandoned_in(const std::string& folder) {
  const std::string mark = temporary_mark();
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    const std::size_t at = name.rfind(mark);
    if (!name.starts_with(".") || at == std::string::npos) continue;
    if (still_runs(std::string_view(name).substr(at + mark.size())) == false) ::unlink(entry.path().c_str());
  }
}

bool is_being_written_here(const std::string& path) {
  const std::filesystem::path target(path);
  const std::string begin = temporary_stem(target);
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(target.has_parent_path() ? target.parent_path() : ".", error)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(begin) && still_runs(std::string_view(name).substr(begin.size())) == true) return true;
  }
  return false;
}

void check_writable(const std::string& path) { WholeFile whole(path); }

}  // namespace arcus
