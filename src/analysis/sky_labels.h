#pragma once
// Places for words beside points of a picture, so that none covers another.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "src/analysis/canvas.h"

namespace arcus::render {

/// A box; y down.
struct Box {
  double left, top, right, bottom;
  bool meets(const Box& o) const { return left < o.right && o.left < right && top < o.bottom && o.top < bottom; }
};

struct PlacedLabel {
  Point point;    ///< what it belongs to
  Point corner;   ///< nearest point of its box: the end of a leader
  Box box;
};

class LabelPlacer {
 public:
  /// Words stay within a circle's square.
  explicit LabelPlacer(const Box& within) : within_(within) {}
  /// Nothing may lie there.
  void block(const Box& box) { taken_.push_back(box); }
  /// The best place for a word of that size: at the first of its points, near it, where there is room. None where there is none.
  std::optional<PlacedLabel> place(std::span<const Point> points, double width, double height);

 private:
  Box within_;
  std::vector<Box> taken_;
};

}  // namespace arcus::render
