#include "src/analysis/chart_parts.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "phase/base/whole_file.h"
#include "src/film/tone.h"

namespace arcus::render {

double draw_heading(Canvas& canvas, double width, const std::string& title,
                    const std::string& subtitle, std::span<const Line> lines) {
  constexpr double margin = 20, row = 18, swatch = 24, gap = 8, between = 22;
  double y = 14;
  if (!title.empty()) {
    // A long title is set smaller rather than cut.
    TextStyle style{16, dark_ink, true};
    const double room = width - 2 * margin, wanted = canvas.text_width(title, style);
    if (wanted > room) style.size = std::max(9.0, style.size * room / wanted);
    canvas.text(title, {margin, y += 16}, style);
    y += 4;
  }
  if (!subtitle.empty()) {
    TextStyle style{11.5, grey_ink};
    const double room = width - 2 * margin, wanted = canvas.text_width(subtitle, style);
    if (wanted > room) style.size = std::max(7.0, style.size * room / wanted);
    canvas.text(subtitle, {margin, y += 15}, style);
    y += 3;
  }
  const TextStyle style{12, dark_ink};
  double x = margin;
  bool is_begun = false;
  for (const Line& line : lines) {
    if (line.label.empty()) continue;
    const double needed = swatch + gap + canvas.text_width(line.label, style);
    if (!is_begun || x + needed > width - margin) {
      x = margin;
      y += is_begun ? row : 22;
      is_begun = true;
    }
    const Point ends[] = {{x, y - 4}, {x + swatch, y - 4}};
    canvas.line(ends, {line.ink, std::max(2.0, line.width), 1, line.is_dashed});
    canvas.text(line.label, {x + swatch + gap, y}, style);
    x += needed + between;
  }
  return y + 10;
}

Ink ink_of_wavelength(double nm) {
  // A narrow line has the colour of the matching functions there. Clipped rather than mixed with
  // grey as pictures are: a mixed red is pink.
  Rgb c = to_rgb_from_white(equal_energy_white())(
      xyz_of([nm](double at) { return std::fabs(at - nm) < 2.5 ? 1.0 : 0.0; }));
  c = {std::max(c.r, 0.0), std::max(c.g, 0.0), std::max(c.b, 0.0)};
  const double most = std::max({c.r, c.g, c.b});
  if (!(most > 0)) return grey_ink;
  // Fully bright yellow and green are hard to see on white: a limit on luminance. The ends of the
  // spectrum, where the hue hardly changes, are told apart by darkness.
  const double luminance = 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
  const double ends = nm < 440 ? 1 - (440 - nm) / 80 : nm > 630 ? 1 - (nm - 630) / 180 : 1;
  const double scale = std::min(0.9 / most, 0.28 / luminance) * std::clamp(ends, 0.12, 1.0);
  return {srgb_encoded(c.r * scale), srgb_encoded(c.g * scale), srgb_encoded(c.b * scale)};
}

Ink ink_of_channel(const std::string& name) {
  const std::string last =
      name.substr(name.find_last_of('.') == std::string::npos ? 0 : name.find_last_of('.') + 1);
  if (last == "R" || last == "X") return {0.83, 0.15, 0.13};
  if (last == "G" || last == "Y") return {0.09, 0.55, 0.20};
  if (last == "B" || last == "Z") return {0.15, 0.33, 0.80};
  if (name.starts_with("S0.")) return ink_of_wavelength(std::strtod(name.c_str() + 3, nullptr));
  return grey_ink;
}

void write_chart(const std::string& path, const LineChart& chart) {
  write_whole_file(path, png_of(chart));
}

void write_chart(const std::string& path, const PolarChart& chart) {
  write_whole_file(path, png_of(chart));
}

}  // namespace arcus::render
