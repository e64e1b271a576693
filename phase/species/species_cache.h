#pragma once
// Tables that were computed once are kept in a folder under the id of their recipe. A missing one is made, a damaged
// one is made again with a warning, a folder that cannot be written costs a warning only; two processes that want the
// same one do not harm each other, and as a rule one waits for the other instead of computing it too.

#include <functional>
#include <string>
#include <string_view>

#include "phase/species/species_file.h"

namespace arcus::phase {

/// $XDG_CACHE_HOME/arcus/phase, or ~/.cache/arcus/phase where that is not set; "" where there is no home either.
std::string default_cache_folder();

class SpeciesCache {
 public:
  /// An empty folder: nothing is kept. `log` gets warnings and what is being waited for; may be empty.
  explicit SpeciesCache(std::string folder, std::function<void(std::string_view)> log = {});

  /// The table of that recipe id: read, or else made and kept.
  ScatteringTable find_or_make(const std::string& recipe_id, const std::function<SpeciesFile()>& make) const;

  /// Where the table of a recipe is kept.
  std::string path_of(const std::string& recipe_id) const { return folder_ + "/" + recipe_id + ".nc"; }

 private:
  void log(const std::string& text) const;
  /// Reads the kept table into `table`: true where it is there and whole.
  bool read(const std::string& recipe_id, ScatteringTable& table) const;

  std::string folder_;
  std::function<void(std::string_view)> log_;
};

}  // namespace arcus::phase
