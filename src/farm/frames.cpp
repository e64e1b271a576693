#include "src/farm/frames.h"

#include <charconv>
#include <cmath>
#include <regex>

#include "phase/base/error.h"
#include "phase/settings/number_text.h"

namespace arcus::farm {
namespace {

constexpr long long most_frames = 1'000'000;

const std::regex& between() {
  static const std::regex pattern(R"(([-+]?[0-9]+(?:\.[0-9]+)?(?:[eE][-+]?[0-9]+)?)\.\.([-+]?[0-9]+(?:\.[0-9]+)?(?:[eE][-+]?[0-9]+)?))");
  return pattern;
}

const std::regex& number_of_frame() {
  static const std::regex pattern(R"(\{frame(?::([1-9]))?\})");
  return pattern;
}

/// `text` with every match of the pattern replaced by what `replacement(match)` gives.
template <class Replacement>
std::string replaced(const std::string& text, const std::regex& pattern, const Replacement& replacement) {
  std::string result;
  auto rest = text.cbegin();
  for (std::sregex_iterator match(text.cbegin(), text.cend(), pattern), end; match != end; ++match) {
    result.append(rest, (*match)[0].first);
    result += replacement(*match);
    rest = (*match)[0].second;
  }
  return result.append(rest, text.cend());
}

bool is_whole_number(const std::string& text) { return text.find_first_of(".eE") == std::string::npos; }

}  // namespace

FrameRange read_frame_range(const std::string& text, const std::string& option) {
  FrameRange range;
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, range.first);
  const bool has_colon = first.ec == std::errc() && first.ptr != end && *first.ptr == ':';
  const auto last = has_colon ? std::from_chars(first.ptr + 1, end, range.last) : first;
  if (!has_colon || last.ec != std::errc() || last.ptr != end || range.first < 0 || range.last < range.first)
    throw bad_input(option, "'" + text + "'", "A:B expected: numbers of the first and the last frame, 0 <= A <= B");
  if (range.count() > most_frames) throw bad_input(option, "'" + text + "'", "at most " + std::to_string(most_frames) + " frames expected");
  return range;
}

std::string at_frame(const std::string& assignment, const FrameRange& frames, long long frame) {
  const double part = frames.count() > 1 ? static_cast<double>(frame - frames.first) / static_cast<double>(frames.count() - 1) : 0;
  const std::string numbered = replaced(assignment, number_of_frame(), [&](const std::smatch& match) {
    std::string digits = std::to_string(frame);
    const std::size_t width = match[1].matched ? static_cast<std::size_t>(std::stoi(match[1].str())) : 1;
    return digits.size() < width ? digits.insert(0, width - digits.size(), '0') : digits;
  });
  if (const std::size_t left = numbered.find("{frame"); left != std::string::npos)
    throw bad_input("--set", "'" + numbered.substr(left, numbered.find('}', left) - left + 1) + "'", "{frame}, or {frame:N} with 1 to 9 digits expected");
  return replaced(numbered, between(), [&](const std::smatch& match) {
    const double from = std::stod(match[1].str()), to = std::stod(match[2].str());
    const double value = part == 1 ? to : from + (to - from) * part;  // the ends exactly as they are typed
    if (is_whole_number(match[1].str()) && is_whole_number(match[2].str()) && value == std::floor(value) && std::fabs(value) < 1e15)
      return std::to_string(static_cast<long long>(value));
    return number_text(value);
  });
}

bool varies(const std::string& assignment) { return std::regex_search(assignment, number_of_frame()) || std::regex_search(assignment, between()); }

}  // namespace arcus::farm
