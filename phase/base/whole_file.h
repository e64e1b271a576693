#pragma once
// Files that exist are whole: written under a temporary name beside the final one, then renamed.

#include <string>
#include <string_view>

namespace arcus {

class WholeFile {
 public:
  /// Prepares to write `path`. Throws cannot() where its folder does not exist or cannot be written, so that a long
  /// computation fails before it begins.
  explicit WholeFile(std::string path);
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;
  /// Removes what was written and not committed.
  ~WholeFile();

  /// Where to write: same folder, same ending, name with host and process id, so that two processes do not
  /// meet, on one machine or on several.
  const std::string& temporary_path() const { return temporary_path_; }
  /// Flushes the temporary file to the disk, gives it its name and flushes that. Throws cannot() on failure.
  void commit();

 private:
  std::string path_, temporary_path_;
  bool committed_ = false;
};

/// Writes a text or bytes as a whole file.
void write_whole_file(const std::string& path, std::string_view content);

/// Removes the temporary files in a folder that belong to processes of this machine that are no more: killed, they could not do it
/// themselves.
void remove_abandoned_in(const std::string& folder);

/// Whether a process of this machine that still runs has a WholeFile of that path which is not committed.
bool is_being_written_here(const std::string& path);

/// Throws cannot() unless a file could be made at `path`; leaves nothing.
void check_writable(const std::string& path);

}  // namespace arcus
