#include "src/analysis/sky_labels.h"

#include <algorithm>
#include <cmath>

#include "phase/base/units.h"

namespace arcus::render {

std::optional<PlacedLabel> LabelPlacer::place(std::span<const Point> points, double width, double height) {
  // Near before far, and at each distance aside before above and below.
  for (const double distance : {9.0, 18.0, 32.0, 50.0})
    for (const Point& point : points)
      for (const int turn : {0, 180, 30, 150, -30, 210, 60, 120, -60, 240, 90, -90}) {
        const double x = point.x + distance * std::cos(radians(turn)), y = point.y - distance * std::sin(radians(turn));
        // The side of the box that faces the point lies there.
        const double share = 0.5 - 0.5 * std::cos(radians(turn));
        const double rise = 0.5 + 0.5 * std::sin(radians(turn));
        const Box box{x - share * width, y - rise * height, x + (1 - share) * width, y + (1 - rise) * height};
        if (box.left < within_.left || box.right > within_.right || box.top < within_.top || box.bottom > within_.bottom) continue;
        if (std::ranges::any_of(taken_, [&](const Box& other) { return box.meets(other); })) continue;
        taken_.push_back(box);
        return PlacedLabel{point, {std::clamp(point.x, box.left, box.right), std::clamp(point.y, box.top, box.bottom)}, box};
      }
  return std::nullopt;
}

}  // namespace arcus::render
