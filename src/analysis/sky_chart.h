#pragma once
// The sky as a fisheye lens sees it: zenith in the middle, horizon as the rim, the sun's side below.

#include <string>
#include <vector>

#include "src/analysis/sky_light.h"

namespace arcus::render {

struct SkyPoint {
  double azimuth_deg;  ///< from the sun's, clockwise
  double elevation_deg;
};

struct SkyLabel {
  std::string text;
  std::vector<SkyPoint> points;  ///< it stands beside one of them, the first that has room
};

enum class SkyProjection { equidistant, equal_area };

struct SkyChart {
  std::string title, subtitle;
  double sun_elevation_deg = 0, sun_angular_radius_deg = 0.2666;
  bool has_lower_half = false;  ///< beside the upper one: the nadir in the middle, the sun's side above
  SkyProjection projection = SkyProjection::equidistant;
  /// Brightness is shown by its logarithm, over so many decades down from that which a thousandth of the sky exceeds; over fewer
  /// where nearly all of the sky is brighter than their end.
  double decades = 3.5;
  double exposure_ev = 0;       ///< brighter by 2^ev
  std::vector<SkyLabel> labels;
  bool has_marks = true;        ///< circles of elevation, the sun's place and words
  int size_px = 1000;           ///< width of a half of the sky with its margin
};

/// PNG bytes.
std::string png_of(const SkyChart& chart, const SkyLight& light);
/// Writes it whole or not at all. Throws cannot() where it cannot be written.
void write_chart(const std::string& path, const SkyChart& chart, const SkyLight& light);

}  // namespace arcus::render
