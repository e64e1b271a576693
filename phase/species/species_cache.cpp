#include "phase/species/species_cache.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cstdlib>
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
  /// True where another process holds it.
  bool is_taken() const { return file_ >= 0 && ::flock(file_, LOCK_EX | LOCK_NB) != 0; }
  void wait() const { (void)!::flock(file_, LOCK_EX); }

 private:
  std::string path_;
  int file_ = -1;
};

}  // namespace

std::string default_cache_folder() {
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && *cache == '/')
    return std::string(cache) + "/arcus/phase";
  if (const char* home = std::getenv("HOME"); home && *home == '/') return std::string(home) + "/.cache/arcus/phase";
  return "";
}

SpeciesCache::SpeciesCache(std::string folder, std::function<void(std::string_view)> log)
    : folder_(std::move(folder)), log_(std::move(log)) {}

void SpeciesCache::log(const std::string& text) const {
  if (log_) log_(text);
}

bool SpeciesCache::read(const std::string& recipe_id, ScatteringTable& table) const {
  const std::string path = path_of(recipe_id);
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return false;
  try {
    SpeciesFile file = read_species_file(path);
    if (file.recipe_id != recipe_id)
      throw bad_input(path, "the table of another recipe", recipe_id + " expected");
    table = std::move(file.table);
    return true;
  } catch (const Error& fault) {
    log(std::string("warning: ") + fault.what() + "; the table is computed again");
    return false;
  }
}

ScatteringTable SpeciesCache::find_or_make(const std::string& recipe_id,
                                           const std::function<SpeciesFile()>& make) const {
  if (folder_.empty()) return make().table;
  ScatteringTable table;
  if (read(recipe_id, table)) return table;
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  const FileLock lock(folder_ + "/" + recipe_id + ".lock");
  if (lock.is_taken()) {
    log("waiting for another process, which is computing the same table");
    lock.wait();
    if (read(recipe_id, table)) return table;
  }
  SpeciesFile file = make();
  try {
    write_species_file(path_of(recipe_id), file);
  } catch (const Error& fault) {
    log(std::string("warning: the table is not kept: ") + fault.what());
  }
  return std::move(file.table);
}

}  // namespace arcus::phase
