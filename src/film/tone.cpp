#include "src/film/tone.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace arcus::render {
namespace {

constexpr double shoulder_begins = 0.6;

/// Rows of RGB to Y for Rec.709's primaries and white.
double luminance(const Rgb& c) { return 0.21263901 * c.r + 0.71516868 * c.g + 0.07219231 * c.b; }

/// XYZ of D65's white to Rec.709 and back (IEC 61966-2-1).
Rgb screen_rgb(const Xyz& c) {
  return {3.2404542 * c.x - 1.5371385 * c.y - 0.4985314 * c.z, -0.9692660 * c.x + 1.8760108 * c.y + 0.0415560 * c.z,
          0.0556434 * c.x - 0.2040259 * c.y + 1.0572252 * c.z};
}
Xyz screen_xyz(const Rgb& c) {
  return {0.4124564 * c.r + 0.3575761 * c.g + 0.1804375 * c.b, 0.2126729 * c.r + 0.7151522 * c.g + 0.0721750 * c.b,
          0.0193339 * c.r + 0.1191920 * c.g + 0.9503041 * c.b};
}

/// The light itself, before the film adapted it to the screen's white.
Xyz light_of(const Rgb& c, const ToRgb& to_rgb) {
  const auto& m = to_rgb.matrix;
  const auto minor = [&](std::size_t i, std::size_t k) {
    const std::size_t r0 = (i + 1) % 3, r1 = (i + 2) % 3, c0 = (k + 1) % 3, c1 = (k + 2) % 3;
    return m[r0][c0] * m[r1][c1] - m[r0][c1] * m[r1][c0];
  };
  const double determinant = m[0][0] * minor(0, 0) + m[0][1] * minor(0, 1) + m[0][2] * minor(0, 2);
  const auto row = [&](std::size_t k) { return (minor(0, k) * c.r + minor(1, k) * c.g + minor(2, k) * c.b) / determinant; };
  return {row(0), row(1), row(2)};
}

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

double share_of_cones(double luminance_cd_per_m2) {
  if (!(luminance_cd_per_m2 > 0)) return 0;
  const double t = std::clamp((std::log10(luminance_cd_per_m2) + 2) / 2.6, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

Rgb night_seen(const Rgb& rgb, const ToRgb& to_rgb) {
  const Xyz light = light_of(rgb, to_rgb);
  if (!(light.y > 0)) return {};
  const double cones = share_of_cones(light.y * cd_per_m2_of_y);
  if (cones == 1) return rgb;
  // Outside of what real colours are the fit means nothing: rods see 0.1 (deep red) to 20 times (violet) of what cones see.
  const double rods_per_cones = light.x > 0 ? 1.33 * (1 + (light.y + light.z) / light.x) - 1.68 : 20;
  const double rods = light.y * std::clamp(rods_per_cones, 0.1, 20.0);
  const Xyz seen = screen_xyz(rgb);
  const double sum = seen.x + seen.y + seen.z;
  const double x = (1 - cones) * 0.25 + cones * seen.x / sum, y = (1 - cones) * 0.25 + cones * seen.y / sum;
  const double luminance = (1 - cones) * 0.4468 * rods + cones * seen.y;
  return screen_rgb({luminance * x / y, luminance, luminance * (1 - x - y) / y});
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
      Rgb colour = is_colour ? Rgb{scaled(*r), scaled(*g), scaled(*b)}
                             : Rgb{scaled(0), scaled(0), scaled(0)};
      if (settings.night && is_colour) {
        const Rgb seen = night_seen(into_gamut({image.value(x, y, *r), image.value(x, y, *g), image.value(x, y, *b)}), *settings.night);
        colour = {seen.r * scale, seen.g * scale, seen.b * scale};
      }
      const Rgb shown = display_linear(colour);
      for (const double v : {shown.r, shown.g, shown.b}) picture.rgb.push_back(byte_of(v));
    }
  }
  return picture;
}

}  // namespace arcus::render
