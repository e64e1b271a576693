#pragma once
// Numbers as text, the same on every machine.

#include <charconv>
#include <string>

namespace arcus {

/// The shortest text that reads back as the same number.
inline std::string number_text(double x) {
  char buffer[40];
  const auto result = std::to_chars(buffer, buffer + sizeof buffer, x);
  return std::string(buffer, result.ptr);
}

}  // namespace arcus
