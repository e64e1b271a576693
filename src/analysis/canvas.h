#pragma once
// A sheet to draw on; its source is the only one that uses Cairo.

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace arcus::render {

/// A colour as a screen takes it: sRGB, each in [0, 1].
struct Ink {
  double r = 0, g = 0, b = 0;
};

struct Point {
  double x = 0, y = 0;
};

struct TextStyle {
  double size = 12;
  Ink ink{0.2, 0.2, 0.2};
  bool is_bold = false;
  double across = 0;  ///< which point of the text lies at the position: 0 left, 0.5 middle, 1 right
  double turned_deg = 0;  ///< counterclockwise
  bool has_halo = false;  ///< a rim, for text over lines
  Ink halo{1, 1, 1};      ///< its colour
};

struct LineStyle {
  Ink ink;
  double width = 1;
  double opacity = 1;
  bool is_dashed = false;
};

/// A white sheet; positions in points from the top left corner, y down. A point is two pixels wide,
/// so that the picture is sharp on dense screens.
class Canvas {
 public:
  Canvas(double width, double height);
  ~Canvas();
  Canvas(Canvas&&) = delete;

  /// A line through points.
  void line(std::span<const Point> points, const LineStyle& style);
  /// A filled polygon.
  void area(std::span<const Point> points, const Ink& ink, double opacity = 1);
  void circle(Point centre, double radius, const LineStyle& style);
  /// Text whose base line begins (see TextStyle::across) at a point. UTF-8.
  void text(std::string_view text, Point at, const TextStyle& style);
  /// A picture of width_px by height_px pixels, [row][column][R G B] of 8 bits, over a rectangle. Its pixels are those of the sheet
  /// where the rectangle is half as many points wide and high and begins at half points.
  void picture(Point at, double width, double height, std::span<const std::uint8_t> rgb, int width_px, int height_px);
  double text_width(std::string_view text, const TextStyle& style) const;
  /// Nothing is drawn outside of the rectangle from now on, until unclip().
  void clip(Point low, Point high);
  void unclip();
  /// The sheet as the bytes of a PNG file. The same drawing gives the same bytes on one machine;
  /// other fonts, other bytes.
  std::string png() const;

 private:
  struct Sheet;
  std::unique_ptr<Sheet> sheet_;
};

}  // namespace arcus::render
