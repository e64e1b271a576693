#include "phase/species/table_cache.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>

#include "phase/base/error.h"

namespace arcus::phase {
namespace {

/// A lock between processes. The kernel lets go of it when a process ends, however it ends; where the file system has
/// no locks, or the folder cannot be written, there is none, and two processes compute the same table.
class FileLock {
 public:
  explicit FileLock(std::string path) : path_(std::move(path)) {
    file_ = ::open(path_.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0666);
  }
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;
  ~FileLock() {
    if (file_ < 0) return;
    ::unlink(path_.c_str());  // whoever waits holds it open; at worst a third process computes once more
    ::close(file_);
  }
  /// True where another process holds it; not where the file system has no locks (ENOLCK, ENOTSUP).
  bool is_taken() const { return file_ >= 0 && ::flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK; }
  void wait() const { (void)!::flock(file_, LOCK_EX); }

 private:
  std::string path_;
  int file_ = -1;
};

}  // namespace

TableCache::TableCache(std::string folder, std::function<void(std::string_view)> log)
    : folder_(std::move(folder)), log_(std::move(log)) {}

void TableCache::log(const std::string& text) const {
  if (log_) log_(text);
}

bool TableCache::was_read(const std::string& path, const std::function<void(const std::string&)>& read) const {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return false;
  try {
    read(path);
    return true;
  } catch (const Error& fault) {
    log(std::string("warning: ") + fault.what() + "; the table is computed again");
    return false;
  }
}

void TableCache::find_or_make(const std::string& id, const std::function<void(const std::string&)>& read,
                              const std::function<void()>& make, const std::function<void(const std::string&)>& write) const {
  if (folder_.empty()) return make();
  const std::string path = path_of(id);
  if (was_read(path, read)) return;
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  const FileLock lock(folder_ + "/" + id + ".lock");
  if (lock.is_taken()) {
    log("waiting for another process, which is computing the same table");
    lock.wait();
    if (was_read(path, read)) return;
  }
  make();
  try {
    write(path);
  } catch (const Error& fault) {
    log(std::string("warning: the table is not kept: ") + fault.what());
  }
}

}  // namespace arcus::phase
