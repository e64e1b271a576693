#include "src/film/tone.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace arcus::render {
namespace {

constexpr double shoulder_begins = 0.6;

/// Rows of RGB to Y for Rec.709's primaries and white.
double luminance(const Rgb& c) { return 0.21263901 * c.r + 0.71516868 * c.g + 0.07219231 * c.b; }

double with_shoulder(double v) {
  if (v <= shoulder_begins) return v;
  const double t = (v - shoulder_begins) / (1 - shoulder_begins);
  return shoulder_begins + (1 - shoulder_begins) * t / (1 + t);
}

std::uint8_t byte_of(double linear) {
  return static_cast<std::uint8_t>(std::lround(255 * srgb_encoded(std::clamp(linear, 0.0, 1.0))));
}

}  // namespace

Rgb into_gamut(const Rgb& c) {
  const double grey = luminance(c);
  if (!(grey > 0)) return {};
  const double least = std::min({c.r, c.g, c.b});
  if (least >= 0) return c;
  const double kept = grey / (grey - least);
  const auto mixed = [&](double v) { return std::max(0.0, grey + kept * (v - grey)); };
  return {mixed(c.r), mixed(c.g), mixed(c.b)};
}

Rgb display_linear(const Rgb& scaled) {
  if (!std::isfinite(scaled.r) || !std::isfinite(scaled.g) || !std::isfinite(scaled.b)) return {};
  const Rgb c = into_gamut(scaled);
  const double most = std::max({c.r, c.g, c.b});
  if (most <= shoulder_begins) return c;
  const double factor = with_shoulder(most) / most;
  return {c.r * factor, c.g * factor, c.b * factor};
}

double srgb_encoded(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

DisplayPicture tone_mapped(const Image& image, const ToneSettings& settings) {
  assert(settings.reference_radiance > 0 && !image.channel_names().empty());
  const auto r = image.channel("R"), g = image.channel("G"), b = image.channel("B");
  const bool is_colour = r && g && b;
  const double scale = std::exp2(settings.exposure_ev) / settings.reference_radiance;
  const PixelBox& box = image.box();
  DisplayPicture picture{box.width(), box.height(), {}};
  picture.rgb.reserve(3 * box.pixels());
  for (int y = box.y0; y < box.y1; ++y) {
    for (int x = box.x0; x < box.x1; ++x) {
      const auto scaled = [&](std::size_t channel) { return image.value(x, y, channel) * scale; };
      const Rgb colour = is_colour ? Rgb{scaled(*r), scaled(*g), scaled(*b)}
                                   : Rgb{scaled(0), scaled(0), scaled(0)};
      const Rgb shown = display_linear(colour);
      for (const double v : {shown.r, shown.g, shown.b}) picture.rgb.push_back(byte_of(v));
    }
  }
  return picture;
}

}  // namespace arcus::render
