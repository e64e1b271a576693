#pragma once
// The keys of a settings struct as options of a subcommand: `rain_mm_per_hour` becomes --rain-mm-per-hour. The same list
// reads them as reads files, so names, ranges, meanings and messages agree.

#include <CLI/App.hpp>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "phase/settings/toml_text.h"

namespace arcus::tools {

class KeyOptions {
 public:
  /// Adds an option for every key of the list. Keys of a table get its name in front: --table-key.
  KeyOptions(CLI::App& app, const KeyList& list);

  /// Reads the given options into the settings of `list`. Throws bad_input that names the option's key.
  void read(const KeyList& list) const;

  /// The given options as "table.key=VALUE".
  std::vector<std::string> assignments() const;

 private:
  // Owned by pointer: the option parser keeps references to the strings.
  std::shared_ptr<std::map<std::string, std::vector<std::string>>> values_;
};

}  // namespace arcus::tools
