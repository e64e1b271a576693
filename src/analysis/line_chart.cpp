#include <algorithm>
#include <cmath>

#include "src/analysis/chart.h"
#include "src/analysis/chart_parts.h"
#include "src/film/tone.h"

namespace arcus::render {
namespace {

constexpr double strip_height = 34, strip_label_height = 20, tick_length = 5;

Ink shown(const Rgb& colour) {
  const Rgb c = display_linear(colour);
  return {srgb_encoded(c.r), srgb_encoded(c.g), srgb_encoded(c.b)};
}

Rgb interpolated(const Strip& strip, double x) {
  const auto above = std::upper_bound(strip.x.begin(), strip.x.end(), x);
  if (above == strip.x.begin()) return strip.colours.front();
  if (above == strip.x.end()) return strip.colours.back();
  const auto i = static_cast<std::size_t>(above - strip.x.begin());
  const double t = (x - strip.x[i - 1]) / (strip.x[i] - strip.x[i - 1]);
  const Rgb &a = strip.colours[i - 1], &b = strip.colours[i];
  return {a.r + t * (b.r - a.r), a.g + t * (b.g - a.g), a.b + t * (b.b - a.b)};
}

std::vector<double> all_x(const LineChart& chart) {
  std::vector<double> values;
  for (const Line& line : chart.lines) values.insert(values.end(), line.x.begin(), line.x.end());
  if (values.empty())
    for (const Strip& strip : chart.strips)
      values.insert(values.end(), strip.x.begin(), strip.x.end());
  return values;
}

/// y of all lines within the range of x, error bands included.
std::vector<double> all_y(const LineChart& chart, const Scale& x_scale) {
  std::vector<double> values;
  for (const Line& line : chart.lines) {
    for (std::size_t i = 0; i < line.x.size(); ++i) {
      if (line.x[i] < x_scale.low() || line.x[i] > x_scale.high()) continue;
      values.push_back(line.y[i]);
      // A band that dips to 0 must not stretch a logarithmic axis.
      if (line.error.empty() || !std::isfinite(line.error[i]) || chart.y_axis.is_logarithmic)
        continue;
      values.push_back(line.y[i] - line.error[i]);
      values.push_back(line.y[i] + line.error[i]);
    }
  }
  return values;
}

/// The chart while it is drawn: where things are.
class Drawing {
 public:
  explicit Drawing(const LineChart& chart)
      : chart_(chart),
        canvas_(chart.width, chart.height),
        x_scale_(chart.x_axis, all_x(chart), true),
        y_scale_(chart.y_axis, all_y(chart, x_scale_), false) {
    const double heading =
        draw_heading(canvas_, chart.width, chart.title, chart.subtitle, chart.lines);
    top_ = heading + 8;
    bottom_ = chart.height - 52 -
              static_cast<double>(chart.strips.size()) * (strip_height + strip_label_height);
    y_ticks_ = y_scale_.ticks(std::max(2, static_cast<int>((bottom_ - top_) / 48)));
    double widest = 0;
    for (const Tick& tick : y_ticks_)
      widest = std::max(widest, canvas_.text_width(tick.label, tick_style()));
    left_ = 20 + (chart.y_axis.title.empty() ? 0 : 22) + widest + tick_length + 6;
    right_ = chart.width - 28;
    place_marks();
    x_ticks_ = x_scale_.ticks(std::max(2, static_cast<int>((right_ - left_) / 80)));
  }

  std::string png() {
    if (!chart_.lines.empty()) {
      draw_grid();
      draw_lines();
      draw_marks();
      draw_frame();
    }
    draw_strips();
    draw_x_labels();
    return canvas_.png();
  }

 private:
  struct PlacedMark {
    double x, middle;
    std::size_t row;
    std::string label;
  };
  static constexpr double mark_row = 15;

  static TextStyle mark_style() { return {10.5, grey_ink, false, 0.5, 0, true}; }
  static TextStyle tick_style() { return {11.5, dark_ink}; }
  double x_of(double position) const { return left_ + position * (right_ - left_); }
  double y_of(double position) const { return bottom_ - position * (bottom_ - top_); }

  std::optional<Point> place(double x, double y) const {
    const auto px = x_scale_.position(x), py = y_scale_.position(y);
    if (!px || !py) return std::nullopt;
    // Far outside is as good as outside, and keeps the coordinates small.
    return Point{x_of(std::clamp(*px, -10.0, 11.0)), y_of(std::clamp(*py, -10.0, 11.0))};
  }

  void straight(Point a, Point b, const LineStyle& style) {
    const Point ends[] = {a, b};
    canvas_.line(ends, style);
  }

  void draw_grid() {
    for (const Tick& tick : x_ticks_)
      straight({x_of(*x_scale_.position(tick.value)), top_},
               {x_of(*x_scale_.position(tick.value)), bottom_},
               {grid_ink, tick.label.empty() ? 0.4 : 0.9, 1, false});
    for (const Tick& tick : y_ticks_)
      straight({left_, y_of(*y_scale_.position(tick.value))},
               {right_, y_of(*y_scale_.position(tick.value))},
               {grid_ink, tick.label.empty() ? 0.4 : 0.9, 1, false});
  }

  void draw_lines() {
    canvas_.clip({left_, top_}, {right_, bottom_});
    for (const Line& line : chart_.lines)
      if (!line.error.empty()) draw_band(line);
    for (const Line& line : chart_.lines)
      draw_parted(canvas_, line, [this](double x, double y) { return place(x, y); });
    canvas_.unclip();
  }

  void draw_band(const Line& line) {
    std::vector<Point> upper, lower;
    for (std::size_t i = 0; i < line.x.size(); ++i) {
      double low = line.y[i] - line.error[i];
      if (y_scale_.is_logarithmic()) low = std::max(low, y_scale_.low() * 1e-3);
      const auto a = place(line.x[i], line.y[i] + line.error[i]), b = place(line.x[i], low);
      if (!a || !b) continue;
      upper.push_back(*a);
      lower.push_back(*b);
    }
    upper.insert(upper.end(), lower.rbegin(), lower.rend());
    if (upper.size() > 3) canvas_.area(upper, line.ink, 0.18);
  }

  /// Gives the marks their words above the frame, in as many rows as they need so as not to touch,
  /// and lowers the frame.
  void place_marks() {
    std::vector<double> row_ends;
    for (const Mark& mark : chart_.marks) {
      const auto position = x_scale_.position(mark.x);
      if (!position || *position < 0 || *position > 1) continue;
      const double x = x_of(*position), half = 0.5 * canvas_.text_width(mark.label, mark_style());
      const double middle = std::clamp(x, left_ + half, right_ - half);
      std::size_t row = 0;
      while (row < row_ends.size() && row_ends[row] > middle - half) ++row;
      if (row == row_ends.size()) row_ends.push_back(0);
      row_ends[row] = middle + half + 8;
      marks_.push_back({x, middle, row, mark.label});
    }
    top_ += mark_row * static_cast<double>(row_ends.size());
  }

  void draw_marks() {
    for (const PlacedMark& mark : marks_) {
      const double base = top_ - 5 - mark_row * static_cast<double>(mark.row);
      straight({mark.x, base + 2}, {mark.x, bottom_}, {grey_ink, 0.8, 0.8, true});
    }
    for (const PlacedMark& mark : marks_)
      canvas_.text(mark.label, {mark.middle, top_ - 5 - mark_row * static_cast<double>(mark.row)},
                   mark_style());
  }

  void draw_frame() {
    const LineStyle frame{grey_ink, 1, 1, false};
    const Point corners[] = {
        {left_, top_}, {right_, top_}, {right_, bottom_}, {left_, bottom_}, {left_, top_}};
    canvas_.line(corners, frame);
    TextStyle style = tick_style();
    style.across = 1;
    for (const Tick& tick : y_ticks_) {
      const double y = y_of(*y_scale_.position(tick.value));
      straight({left_ - (tick.label.empty() ? 3 : tick_length), y}, {left_, y}, frame);
      canvas_.text(tick.label, {left_ - tick_length - 4, y + 4}, style);
    }
    for (const Tick& tick : x_ticks_) {
      const double x = x_of(*x_scale_.position(tick.value));
      straight({x, bottom_}, {x, bottom_ + (tick.label.empty() ? 3 : tick_length)}, frame);
    }
    canvas_.text(chart_.y_axis.title, {28, 0.5 * (top_ + bottom_)},
                 {12.5, dark_ink, false, 0.5, 90});
  }

  void draw_strips() {
    double y = chart_.lines.empty() ? top_ : bottom_;
    for (const Strip& strip : chart_.strips) {
      canvas_.text(strip.label, {left_, y + strip_label_height - 4}, {10.5, grey_ink});
      const double begin = y + strip_label_height, end = begin + strip_height;
      const auto low = x_scale_.position(strip.x.front()), high = x_scale_.position(strip.x.back());
      constexpr double step = 0.5;  // one pixel
      const double first = x_of(std::clamp(low.value_or(0), 0.0, 1.0)),
                   last = x_of(std::clamp(high.value_or(1), 0.0, 1.0));
      for (double x = first; x < last; x += step) {
        const double share = (x + 0.5 * step - left_) / (right_ - left_);
        const double value =
            x_scale_.is_logarithmic()
                ? x_scale_.low() * std::pow(x_scale_.high() / x_scale_.low(), share)
                : x_scale_.low() + share * (x_scale_.high() - x_scale_.low());
        const double until =
            std::min(x + 2 * step, last);  // overlaps its neighbour: no seam shines through
        const Point corners[] = {{x, begin}, {until, begin}, {until, end}, {x, end}};
        canvas_.area(corners, shown(interpolated(strip, value)));
      }
      y = end;
    }
    labels_y_ = y;
  }

  void draw_x_labels() {
    TextStyle style = tick_style();
    style.across = 0.5;
    for (const Tick& tick : x_ticks_)
      canvas_.text(tick.label, {x_of(*x_scale_.position(tick.value)), labels_y_ + tick_length + 14},
                   style);
    canvas_.text(chart_.x_axis.title, {0.5 * (left_ + right_), labels_y_ + tick_length + 34},
                 {12.5, dark_ink, false, 0.5});
  }

  const LineChart& chart_;
  Canvas canvas_;
  Scale x_scale_, y_scale_;
  std::vector<Tick> x_ticks_, y_ticks_;
  std::vector<PlacedMark> marks_;
  double left_ = 0, right_ = 0, top_ = 0, bottom_ = 0, labels_y_ = 0;
};

}  // namespace

std::string png_of(const LineChart& chart) { return Drawing(chart).png(); }

}  // namespace arcus::render
