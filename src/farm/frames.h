#pragma once
// An animation's frames, and settings that change from one to the next.

#include <string>

namespace arcus::farm {

/// Numbers of frames, both ends included.
struct FrameRange {
  long long first = 0, last = 0;
  long long count() const { return last - first + 1; }
  bool operator==(const FrameRange&) const = default;
};

/// Reads "A:B", 0 <= A <= B. Throws bad_input that names the option.
FrameRange read_frame_range(const std::string& text, const std::string& option);

/// An override "table.key=VALUE" as it is in one frame. In its value
///   FROM..TO            between two numbers goes evenly from the first frame to the last one; in arrays too: [0, 100..900, 2]
///   {frame}, {frame:4}  become the frame's number, with at least so many digits
/// Throws bad_input where braces hold something else.
std::string at_frame(const std::string& assignment, const FrameRange& frames, long long frame);

/// Whether at_frame depends on the frame.
bool varies(const std::string& assignment);

}  // namespace arcus::farm
