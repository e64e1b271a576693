#pragma once
// Tables by scattering angle that were computed once are kept in a folder under the id of their recipe: see table_cache.h.

#include <functional>
#include <string>
#include <string_view>
#include <utility>

#include "phase/species/species_file.h"
#include "phase/species/table_cache.h"

namespace arcus::phase {

/// $XDG_CACHE_HOME/arcus/phase, or ~/.cache/arcus/phase where that is not set; "" where there is no home either.
std::string default_cache_folder();

class SpeciesCache {
 public:
  /// An empty folder: nothing is kept. `log` gets warnings and what is being waited for; may be empty.
  explicit SpeciesCache(std::string folder, std::function<void(std::string_view)> log = {})
      : cache_(std::move(folder), std::move(log)) {}

  /// The table of that recipe id: read, or else made and kept.
  ScatteringTable find_or_make(const std::string& recipe_id, const std::function<SpeciesFile()>& make) const;

  /// Where the table of a recipe is kept.
  std::string path_of(const std::string& recipe_id) const { return cache_.path_of(recipe_id); }

 private:
  TableCache cache_;
};

}  // namespace arcus::phase
