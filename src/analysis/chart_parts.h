#pragma once
// What line charts and polar charts have in common: headings and legends.

#include <span>
#include <string>

#include "src/analysis/canvas.h"
#include "src/analysis/chart.h"

namespace arcus::render {

inline constexpr Ink dark_ink{0.15, 0.15, 0.17}, grey_ink{0.42, 0.42, 0.45},
    grid_ink{0.88, 0.88, 0.90};

/// Draws title, subtitle and the legend of the lines that have a label, in rows that fit the width.
/// Gives the height that is used.
double draw_heading(Canvas& canvas, double width, const std::string& title,
                    const std::string& subtitle, std::span<const Line> lines);

/// Draws a line through what has a place, parted where there is none.
template <class PlaceOf>
void draw_parted(Canvas& canvas, const Line& line, const PlaceOf& place_of) {
  std::vector<Point> part;
  const LineStyle style{line.ink, line.width, 1, line.is_dashed};
  for (std::size_t i = 0; i <= line.x.size(); ++i) {
    const auto place = i < line.x.size() ? place_of(line.x[i], line.y[i]) : std::nullopt;
    if (place) {
      part.push_back(*place);
      continue;
    }
    if (part.size() > 1) canvas.line(part, style);
    part.clear();
  }
}

}  // namespace arcus::render
