#pragma once
// A name for content: equal bytes, equal name.

#include <string>
#include <string_view>

namespace arcus {

/// 32 hexadecimal digits: XXH3 with 128 bits, in canonical byte order. Not cryptographic.
std::string content_hash(std::string_view content);

/// The same of a file's content. Throws bad_input where it cannot be read.
std::string file_hash(const std::string& path);

}  // namespace arcus
