#include "src/analysis/sky_chart.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "phase/base/units.h"
#include "phase/base/whole_file.h"
#include "phase/settings/number_text.h"
#include "src/analysis/canvas.h"
#include "src/analysis/sky_labels.h"
#include "src/film/tone.h"

namespace arcus::render {
namespace {

constexpr Ink night{0.055, 0.06, 0.075}, word_ink{0.93, 0.93, 0.95}, faint_ink{0.62, 0.64, 0.70}, label_ink{1, 0.93, 0.72};
constexpr double margin = 22, heading = 44;  // points

/// A half of the sky within a circle.
struct Disc {
  Point centre;
  double radius;
  bool is_lower;
  SkyProjection projection;

  /// Distance from the middle over the radius, by that from the zenith or nadir.
  double share_of(double from_middle_deg) const {
    if (projection == SkyProjection::equidistant) return from_middle_deg / 90;
    return std::sin(radians(from_middle_deg) / 2) / std::sin(radians(45));
  }
  double from_middle_deg(double share) const {
    if (projection == SkyProjection::equidistant) return 90 * share;
    return 2 * degrees(std::asin(share * std::sin(radians(45))));
  }
  bool has(const SkyPoint& p) const { return is_lower ? p.elevation_deg < 0 : p.elevation_deg >= 0; }
  Point at(const SkyPoint& p) const {
    const double r = radius * share_of(90 - std::fabs(p.elevation_deg)), a = radians(p.azimuth_deg);
    return {centre.x + r * std::sin(a), centre.y + (is_lower ? -r : r) * std::cos(a)};
  }
  /// x to the right and y down from the middle, over the radius; within 1 of it.
  SkyPoint seen_at(double x, double y) const {
    const double up = 90 - from_middle_deg(std::min(1.0, std::hypot(x, y)));
    return {degrees(std::atan2(x, is_lower ? -y : y)), is_lower ? -up : up};
  }
};

double luminance_of(const Rgb& c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b; }

/// The colours of a disc's square, mean of two by two points a pixel; negative where the circle ends.
std::vector<Rgb> colours_of(const Disc& disc, const SkyLight& light, int side_px) {
  std::vector<Rgb> colours(static_cast<std::size_t>(side_px) * static_cast<std::size_t>(side_px), Rgb{-1, -1, -1});
  for (int row = 0; row < side_px; ++row)
    for (int column = 0; column < side_px; ++column) {
      const auto place = [&](double pixel) { return 2 * pixel / side_px - 1; };
      if (std::hypot(place(row + 0.5), place(column + 0.5)) > 1) continue;
      Rgb sum;
      for (const double down : {0.25, 0.75})
        for (const double right : {0.25, 0.75}) {
          const SkyPoint p = disc.seen_at(place(column + right), place(row + down));
          const Rgb c = light(p.azimuth_deg, p.elevation_deg);
          sum = {sum.r + c.r / 4, sum.g + c.g / 4, sum.b + c.b / 4};
        }
      colours[static_cast<std::size_t>(row) * static_cast<std::size_t>(side_px) + static_cast<std::size_t>(column)] = sum;
    }
  return colours;
}

/// What black and bright white stand for.
struct Range {
  double most = 1, decades = 1;

  /// 0 for black ... 1 for what is bright, or above.
  double place_of(double luminance) const { return luminance > 0 ? std::max(0.0, 1 + std::log10(luminance / most) / decades) : 0; }
};

Range range_of(const std::vector<std::vector<Rgb>>& discs, const SkyChart& chart) {
  std::vector<double> all;
  for (const auto& colours : discs)
    for (const Rgb& c : colours)
      if (c.r != -1) all.push_back(luminance_of(c));
  Range range;
  range.decades = chart.decades;
  const auto exceeded_by = [&](double share) {
    const auto at = all.begin() + static_cast<std::ptrdiff_t>(static_cast<double>(all.size() - 1) * (1 - share));
    std::nth_element(all.begin(), at, all.end());
    return *at;
  };
  if (all.empty() || !(*std::ranges::max_element(all) > 0)) return range;
  // Of light in few places, the brightest.
  range.most = exceeded_by(0.001) > 0 ? exceeded_by(0.001) : *std::ranges::max_element(all);
  // A sky that is bright all over would be grey in grey.
  const double least = 0.6 * exceeded_by(0.98);
  if (least > 0) range.decades = std::clamp(std::log10(range.most / least), std::min(0.5, chart.decades), chart.decades);
  range.most /= std::exp2(chart.exposure_ev);
  return range;
}

std::vector<std::uint8_t> shown(const std::vector<Rgb>& colours, const Range& range) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(3 * colours.size());
  for (const Rgb& c : colours) {
    Rgb linear{night.r, night.g, night.b};
    if (c.r == -1) {
      for (const double v : {linear.r, linear.g, linear.b}) bytes.push_back(static_cast<std::uint8_t>(std::lround(255 * v)));
      continue;
    }
    const double luminance = luminance_of(c);
    const double place = range.place_of(luminance);
    // Steps of the logarithm become steps of the eye's scale, whose square or so is the luminance.
    const double factor = place > 0 ? 0.8 * std::pow(place, 2.2) / luminance : 0;
    linear = display_linear({c.r * factor, c.g * factor, c.b * factor});
    for (const double v : {linear.r, linear.g, linear.b}) bytes.push_back(static_cast<std::uint8_t>(std::lround(255 * srgb_encoded(v))));
  }
  return bytes;
}

void draw_marks(Canvas& canvas, const Disc& disc, const SkyChart& chart) {
  for (int elevation = 10; elevation < 90; elevation += 10) {
    const bool is_strong = elevation % 30 == 0;
    canvas.circle(disc.centre, disc.radius * disc.share_of(90 - elevation), {word_ink, 0.5, is_strong ? 0.30 : 0.12, false});
  }
  canvas.circle(disc.centre, disc.radius, {faint_ink, 1, 1, false});
  for (int elevation = 30; elevation <= 60; elevation += 30) {
    const double signed_elevation = disc.is_lower ? -elevation : elevation;
    const Point at = disc.at({135, signed_elevation});
    canvas.text(number_text(signed_elevation) + "°", {at.x, at.y + 3}, {7.5, faint_ink, false, 0.5, 0, true, {0, 0, 0}});
  }
  for (int azimuth = -150; azimuth <= 180; azimuth += 30) {
    const Point in = disc.at({static_cast<double>(azimuth), 0});
    const double x = (in.x - disc.centre.x) / disc.radius, y = (in.y - disc.centre.y) / disc.radius;
    const Point ends[] = {in, {disc.centre.x + x * (disc.radius + 3), disc.centre.y + y * (disc.radius + 3)}};
    canvas.line(ends, {faint_ink, 0.8, 1, false});
    canvas.text(std::to_string(std::abs(azimuth)) + "°",
                {disc.centre.x + x * (disc.radius + 11), disc.centre.y + y * (disc.radius + 11) + 3}, {7.5, faint_ink, false, 0.5});
  }
  const SkyPoint sun{0, chart.sun_elevation_deg};
  if (disc.has(sun)) {
    const Point at = disc.at(sun);
    canvas.circle(at, 3.5, {{0, 0, 0}, 2, 0.7, false});
    canvas.circle(at, 3.5, {{1, 0.85, 0.2}, 1.1, 1, false});
  }
}

/// Whether there is light that the picture shows within a degree.
bool is_lit(const SkyPoint& p, const SkyLight& light, const Range& range) {
  for (const double up : {-1.0, -0.5, 0.0, 0.5, 1.0})
    for (const double aside : {-1.0, -0.5, 0.0, 0.5, 1.0})
      if (range.place_of(luminance_of(light(p.azimuth_deg + aside, std::clamp(p.elevation_deg + up, -90.0, 90.0)))) > 0.1) return true;
  return false;
}

void draw_labels(Canvas& canvas, const Disc& disc, const SkyChart& chart, const SkyLight& light, const Range& range) {
  constexpr double size = 8.5;
  const TextStyle style{size, label_ink, false, 0, 0, true, {0, 0, 0}};
  LabelPlacer placer({disc.centre.x - disc.radius, disc.centre.y - disc.radius, disc.centre.x + disc.radius, disc.centre.y + disc.radius});
  if (const SkyPoint sun{0, chart.sun_elevation_deg}; disc.has(sun)) {
    const Point at = disc.at(sun);
    placer.block({at.x - 5, at.y - 5, at.x + 5, at.y + 5});
  }
  // No word covers what another one names.
  for (const SkyLabel& label : chart.labels)
    for (const SkyPoint& p : label.points)
      if (disc.has(p) && &p == &label.points.front()) {
        const Point at = disc.at(p);
        placer.block({at.x - 3, at.y - 3, at.x + 3, at.y + 3});
      }
  for (const SkyLabel& label : chart.labels) {
    std::vector<Point> points;
    for (const SkyPoint& p : label.points)
      if (disc.has(p) && is_lit(p, light, range)) points.push_back(disc.at(p));
    const auto placed = placer.place(points, canvas.text_width(label.text, style) + 4, size + 3);
    if (!placed) continue;
    const Point leader[] = {placed->point, placed->corner};
    canvas.line(leader, {{0, 0, 0}, 2.2, 0.6, false});
    canvas.line(leader, {label_ink, 0.8, 0.9, false});
    canvas.text(label.text, {placed->box.left + 2, placed->box.bottom - 3}, style);
  }
}

}  // namespace

std::string png_of(const SkyChart& chart, const SkyLight& light) {
  const double side = 0.5 * chart.size_px, top = chart.has_marks ? heading : 0, edge = chart.has_marks ? margin : 0;
  const double width = chart.has_lower_half ? 2 * side : side;
  Canvas canvas(width, side + top);
  const Point sheet[] = {{0, 0}, {width, 0}, {width, side + top}, {0, side + top}};
  canvas.area(sheet, night);
  std::vector<Disc> discs;
  std::vector<std::vector<Rgb>> colours;
  for (int half = 0; half < (chart.has_lower_half ? 2 : 1); ++half)
    discs.push_back({{side * (0.5 + half), top + 0.5 * side}, 0.5 * side - edge, half == 1, chart.projection});
  const int side_px = static_cast<int>(2 * 2 * discs.front().radius);
  for (const Disc& disc : discs) colours.push_back(colours_of(disc, light, side_px));
  const Range range = range_of(colours, chart);
  for (std::size_t i = 0; i < discs.size(); ++i) {
    const Disc& disc = discs[i];
    canvas.picture({disc.centre.x - disc.radius, disc.centre.y - disc.radius}, 2 * disc.radius, 2 * disc.radius,
                   shown(colours[i], range), side_px, side_px);
    if (!chart.has_marks) continue;
    draw_marks(canvas, disc, chart);
    draw_labels(canvas, disc, chart, light, range);
  }
  if (chart.has_marks) {
    canvas.text(chart.title, {14, 20}, {13, word_ink, true});
    char decades[60];
    std::snprintf(decades, sizeof decades, "; brightness logarithmic, %.1f decades", range.decades);
    canvas.text(chart.subtitle + decades, {14, 36}, {9, faint_ink});
  }
  return canvas.png();
}

void write_chart(const std::string& path, const SkyChart& chart, const SkyLight& light) { write_whole_file(path, png_of(chart, light)); }

}  // namespace arcus::render
