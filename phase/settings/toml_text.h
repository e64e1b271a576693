#pragma once
// Settings from TOML text and back. Every message has file, line and column; an unknown key is an error that names
// the nearest valid one.

#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "phase/settings/keys.h"

namespace arcus {

using KeyList = std::function<void(Keys&)>;

/// Reads the keys that `list` names from a TOML text. `where` names the text in messages. `overrides` are texts
/// "table.key=VALUE" (an entry of an array of tables: "medium.0.albedo=0.9") applied before reading.
/// Throws bad_input: syntax, unknown key, wrong type, out of range.
void read_toml(std::string_view text, std::string_view where, std::span<const std::string> overrides,
               const KeyList& list);

/// The same from a file.
void read_toml_file(const std::string& path, std::span<const std::string> overrides, const KeyList& list);

/// All keys with their present values as TOML, in the order of the list, numbers in shortest form: equal settings give
/// equal texts, so the text can be hashed.
std::string write_toml(const KeyList& list);

/// Settings S from a file: defaults where the file is silent.
template <class S>
S settings_from_file(const std::string& path, std::span<const std::string> overrides = {}) {
  S settings;
  read_toml_file(path, overrides, [&](Keys& keys) { list_keys(keys, settings); });
  return settings;
}
template <class S>
S settings_from_text(std::string_view text, std::string_view where) {
  S settings;
  read_toml(text, where, {}, [&](Keys& keys) { list_keys(keys, settings); });
  return settings;
}
/// Canonical TOML of S.
template <class S>
std::string text_of(S settings) {
  return write_toml([&](Keys& keys) { list_keys(keys, settings); });
}

/// The whole text of a file; throws bad_input where it cannot be read.
std::string read_text_file(const std::string& path);

/// `path` as seen from a file that lies in `folder`: unchanged where it is absolute.
std::string path_from(const std::string& folder, const std::string& path);

}  // namespace arcus
