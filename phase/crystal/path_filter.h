#pragma once
// Which ray paths count: for maps that show the light of some of them alone.

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "phase/crystal/face_path.h"

namespace arcus::phase {

class PathFilter {
 public:
  /// Lets everything through.
  PathFilter() = default;
  /// only: paths that count, all where it is empty; without: paths that do not.
  PathFilter(std::vector<FacePath> only, std::vector<FacePath> without) : only_(std::move(only)), without_(std::move(without)) {
    std::ranges::sort(only_);
    std::ranges::sort(without_);
  }

  bool lets_all_through() const { return only_.empty() && without_.empty(); }
  bool lets_through(const FacePath& path) const {
    return (only_.empty() || std::ranges::binary_search(only_, path)) && !std::ranges::binary_search(without_, path);
  }
  /// Light that went past the crystal and is diffracted has no path: it counts unless some are asked for.
  bool lets_diffracted_light_through() const { return only_.empty(); }
  /// Faces met from inside after which no light counts any more.
  int last_event() const {
    if (only_.empty()) return std::numeric_limits<int>::max();
    int last = 0;
    for (const FacePath& path : only_) {
      if (path.longer()) return std::numeric_limits<int>::max();
      last = std::max(last, path.length() - 1);
    }
    return last;
  }
  /// Equal for equal filters: for ids of what they make.
  std::string text() const {
    std::string text;
    for (const FacePath& path : only_) text += "+" + path.text();
    for (const FacePath& path : without_) text += "!" + path.text();
    return text;
  }

 private:
  std::vector<FacePath> only_, without_;  // ascending
};

}  // namespace arcus::phase
