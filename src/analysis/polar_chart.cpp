#include <algorithm>
#include <cmath>

#include "phase/base/units.h"
#include "src/analysis/chart.h"
#include "src/analysis/chart_parts.h"

namespace arcus::render {

std::string png_of(const PolarChart& chart) {
  Canvas canvas(chart.width, chart.height);
  const double top = draw_heading(canvas, chart.width, chart.title, chart.subtitle, chart.lines);
  std::vector<double> values;
  for (const Line& line : chart.lines) values.insert(values.end(), line.y.begin(), line.y.end());
  const Scale scale(chart.radius_axis, values, false);
  const double radius = 0.5 * std::min(chart.width - 90, chart.height - top - 80);
  const Point centre{0.5 * chart.width, top + 24 + radius};
  const auto point = [&](double angle_deg, double share) {
    return Point{centre.x + share * radius * std::cos(radians(angle_deg)),
                 centre.y - share * radius * std::sin(radians(angle_deg))};
  };

  for (int angle = 0; angle < 360; angle += 30) {
    const Point ends[] = {centre, point(angle, 1)};
    canvas.line(ends, {grid_ink, 0.9, 1, false});
    const int shown = angle > 180 ? 360 - angle : angle;
    const Point at = point(angle, 1 + 14 / radius);
    canvas.text(std::to_string(shown) + "°", {at.x, at.y + 4},
                {11.5, dark_ink, false, 0.5 - 0.5 * std::cos(radians(angle))});
  }
  const std::vector<Tick> ticks = scale.ticks(std::max(2, static_cast<int>(radius / 45)));
  for (const Tick& tick : ticks) {
    const double share = *scale.position(tick.value);
    if (share > 0 && !tick.label.empty())
      canvas.circle(centre, share * radius, {grid_ink, 0.9, 1, false});
  }
  canvas.circle(centre, radius, {grey_ink, 1, 1, false});

  for (const Line& line : chart.lines) {
    const bool is_half = line.x.empty() || *std::max_element(line.x.begin(), line.x.end()) <= 180;
    for (const double side : {1.0, -1.0}) {
      draw_parted(canvas, line, [&](double angle_deg, double value) -> std::optional<Point> {
        const auto share = scale.position(value);
        if (!share) return std::nullopt;
        return point(side * angle_deg, std::clamp(*share, 0.0, 1.0));
      });
      if (!is_half) break;
    }
  }
  for (const Tick& tick : ticks) {
    const double share = *scale.position(tick.value);
    if (tick.label.empty() || share <= 0.02) continue;
    const Point at = point(75, share);
    canvas.text(tick.label, {at.x, at.y + 4}, {10.5, grey_ink, false, 0.5, 0, true});
  }
  canvas.text(chart.radius_axis.title, {centre.x, centre.y + radius + 44},
              {12.5, dark_ink, false, 0.5});
  return canvas.png();
}

}  // namespace arcus::render
