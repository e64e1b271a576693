#pragma once
// The lists of keys as a reference page for people and as a schema for editors.

#include <string>
#include <string_view>

#include "phase/settings/toml_text.h"

namespace arcus {

/// The keys as Markdown: a table of name, default, allowed values and meaning for every table of the list.
std::string reference_page(std::string_view title, const KeyList& list);

/// The keys as JSON Schema (draft 7): editors that know it check and complete as one types.
std::string json_schema(std::string_view title, const KeyList& list);

}  // namespace arcus
