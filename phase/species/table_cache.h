#pragma once
// Files of tables that are kept in a folder under an id, whatever is in them: SpeciesCache and oriented_table_of say what. A
// missing one is made, a damaged one is made again with a warning, a folder that cannot be written costs a warning only; two
// processes that want the same one do not harm each other, and as a rule one waits for the other instead of computing it too.

#include <functional>
#include <string>
#include <string_view>

namespace arcus::phase {

class TableCache {
 public:
  /// An empty folder: nothing is kept. `log` gets warnings and what is being waited for; may be empty.
  explicit TableCache(std::string folder, std::function<void(std::string_view)> log = {});

  /// read(path) takes the table from a file, or throws Error where it is none or another's; make() computes it; write(path) keeps
  /// what was made.
  void find_or_make(const std::string& id, const std::function<void(const std::string&)>& read, const std::function<void()>& make,
                    const std::function<void(const std::string&)>& write) const;

  /// Where a table is kept.
  std::string path_of(const std::string& id) const { return folder_ + "/" + id + ".nc"; }

 private:
  void log(const std::string& text) const;
  /// True where it is there and whole.
  bool was_read(const std::string& path, const std::function<void(const std::string&)>& read) const;

  std::string folder_;
  std::function<void(std::string_view)> log_;
};

}  // namespace arcus::phase
