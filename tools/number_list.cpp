#include "tools/number_list.h"

#include <charconv>
#include <cmath>

#include "phase/base/error.h"

namespace arcus::tools {
namespace {

std::vector<double> split(const std::string& text, char separator, const std::string& option) {
  std::vector<double> values;
  const char* begin = text.data();
  const char* const end = begin + text.size();
  while (true) {
    double value = 0;
    const auto [next, fault] = std::from_chars(begin, end, value);
    if (fault != std::errc() || !std::isfinite(value) || (next != end && *next != separator))
      throw bad_input(option, "'" + text + "'", "numbers as 0,90,180 or BEGIN:END:STEP expected");
    values.push_back(value);
    if (next == end) return values;
    begin = next + 1;
  }
}

}  // namespace

std::vector<double> number_list(const std::string& text, const std::string& option) {
  if (text.find(':') == std::string::npos) return split(text, ',', option);
  const auto range = split(text, ':', option);
  if (range.size() != 3 || !(range[2] > 0) || !(range[1] >= range[0]))
    throw bad_input(option, "'" + text + "'", "BEGIN:END:STEP with END at least BEGIN and STEP above 0 expected");
  const double steps = std::floor((range[1] - range[0]) / range[2] * (1 + 1e-12));
  if (steps > 1e7) throw bad_input(option, "'" + text + "'", "at most ten million numbers expected");
  std::vector<double> values;
  for (double i = 0; i <= steps; ++i) values.push_back(range[0] + i * range[2]);
  return values;
}

}  // namespace arcus::tools
