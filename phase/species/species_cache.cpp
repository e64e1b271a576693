#include "phase/species/species_cache.h"

#include <cstdlib>

#include "phase/base/error.h"

namespace arcus::phase {

std::string default_cache_folder() {
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && *cache == '/')
    return std::string(cache) + "/arcus/phase";
  if (const char* home = std::getenv("HOME"); home && *home == '/') return std::string(home) + "/.cache/arcus/phase";
  return "";
}

ScatteringTable SpeciesCache::find_or_make(const std::string& recipe_id,
                                           const std::function<SpeciesFile()>& make) const {
  SpeciesFile file;
  const auto read = [&](const std::string& path) {
    file = read_species_file(path);
    if (file.recipe_id != recipe_id)
      throw bad_input(path, "the table of another recipe", recipe_id + " expected");
  };
  cache_.find_or_make(
      recipe_id, read, [&] { file = make(); }, [&](const std::string& path) { write_species_file(path, file); });
  return std::move(file.table);
}

}  // namespace arcus::phase
