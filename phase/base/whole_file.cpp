#include "phase/base/whole_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "phase/base/error.h"

namespace arcus {
namespace {

std::string temporary_name(const std::string& path) {
  static std::atomic<unsigned> number{0};
  const std::filesystem::path target(path);
  std::string name = "." + target.stem().string() + ".part" + std::to_string(::getpid()) + "-" +
                     std::to_string(number++) + target.extension().string();
  return (target.parent_path() / name).string();
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

void check_writable(const std::string& path) { WholeFile whole(path); }

}  // namespace arcus
