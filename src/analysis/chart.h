#pragma once
// Charts as PNG: lines over a linear or logarithmic axis, with strips of colour along it, and polar
// charts.

#include <string>
#include <vector>

#include "src/analysis/axis.h"
#include "src/analysis/canvas.h"
#include "src/film/colour.h"

namespace arcus::render {

/// A curve. Points that the axes have no place for (not finite, not positive on a logarithmic axis)
/// part it.
struct Line {
  std::string label;          ///< in the legend; empty: not there
  std::vector<double> x, y;   ///< as many of both; x ascending, in a polar chart degrees
  std::vector<double> error;  ///< half height of a band around it; empty: none
  Ink ink;
  double width = 1.5;  ///< in points
  bool is_dashed = false;
};

/// A bar of colours along the x axis.
struct Strip {
  std::string label;
  std::vector<double> x;     ///< ascending
  std::vector<Rgb> colours;  ///< linear, shown as tone.h says; between the x they are interpolated
};

/// A place on the x axis with words.
struct Mark {
  double x;
  std::string label;
};

struct LineChart {
  std::string title, subtitle;
  Axis x_axis, y_axis;  ///< the x axis ends where the data do
  std::vector<Line> lines;
  std::vector<Strip> strips;
  std::vector<Mark> marks;
  double width = 960, height = 620;  ///< in points of two pixels
};

/// Curves around a point: the angle x counts counterclockwise from the right, the radius shows y. A
/// curve over 0 to 180 degrees is drawn on both sides, as a phase function is.
struct PolarChart {
  std::string title, subtitle;
  Axis radius_axis;
  std::vector<Line> lines;
  double width = 760, height = 820;
};

/// PNG bytes of a chart.
std::string png_of(const LineChart& chart);
std::string png_of(const PolarChart& chart);

/// Writes a chart as PNG, whole or not at all. Throws cannot() where it cannot be written.
void write_chart(const std::string& path, const LineChart& chart);
void write_chart(const std::string& path, const PolarChart& chart);

/// Inks for the channels of a picture, dark enough for a white ground: red, green and blue for R, G
/// and B, X, Y and Z; the colour of its wavelength for S0.<nm>nm; grey for others.
Ink ink_of_channel(const std::string& name);
/// The colour of light of a wavelength, brought into the gamut and darkened for a white ground.
Ink ink_of_wavelength(double nm);

}  // namespace arcus::render
