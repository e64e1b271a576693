#pragma once
// From a linear picture to what a screen shows: exposure, gamut, highlights, sRGB.
//
// In this order, per pixel:
//  1. scale: RGB / reference radiance x 2^exposure_ev. The caller gives the reference, usually that
//  of a white matte
//     surface that faces the sun, E / pi: then exposure 0 shows such a surface as a bright white,
//     like a photograph with the exposure for a sunlit scene.
//  2. gamut: a colour outside of Rec.709 has a negative channel (spectral colours of a bow do). It
//  is mixed with the
//     grey of the same luminance just until no channel is negative, so luminance and, as far as the
//     gamut reaches, hue stay and only saturation is lost. A colour without positive luminance is
//     black.
//  3. highlights: all channels are multiplied with one factor, that which takes the largest of
//  them, v, to v up to
//     0.6 and beyond it to 0.6 + 0.4 t / (1 + t), t = (v - 0.6) / 0.4: continuous with its slope,
//     below 1 for any light, and without a change of hue. The reference itself becomes 0.8.
//  4. the sRGB curve of IEC 61966-2-1 and rounding to 8 bits.

#include <cstdint>
#include <vector>

#include "src/film/colour.h"
#include "src/film/image.h"

namespace arcus::render {

/// A picture as a screen takes it: 8-bit sRGB.
struct DisplayPicture {
  int width_px = 0, height_px = 0;
  std::vector<std::uint8_t> rgb;  ///< [row][column][R G B]
};

struct ToneSettings {
  double exposure_ev = 0;
  /// Shown as a bright white at exposure 0 [unit of the picture]; above 0.
  double reference_radiance = 1;
};

/// Steps 2 and 3: linear display values in [0, 1] of a scaled colour. Not finite: black.
Rgb display_linear(const Rgb& scaled);
/// Step 2 alone: the nearest colour of the same luminance without a negative channel.
Rgb into_gamut(const Rgb& colour);
/// The sRGB curve for a value in [0, 1].
double srgb_encoded(double linear);

/// The picture's box as a screen shows it, from channels R, G, B (all the first channel where there
/// is no R).
DisplayPicture tone_mapped(const Image& image, const ToneSettings& settings);

}  // namespace arcus::render
