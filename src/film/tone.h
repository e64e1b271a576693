#pragma once
// From a linear picture to what a screen shows: exposure, gamut, highlights, sRGB.
//
// In this order, per pixel:
//  0. for an eye adapted to the night: what rods and cones make of it, see night_seen().
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
#include <optional>
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
  /// Of an eye adapted to the night: how the picture's R, G, B were made. The picture is in W m-2 sr-1 nm-1.
  std::optional<ToRgb> night{};
};

/// Luminance [cd/m2] of what has Y = 1 W m-2 sr-1 nm-1, the mean of the spectral radiance weighted with ybar: 683 lm/W times the integral of ybar,
/// 106.857 nm.
inline constexpr double cd_per_m2_of_y = 683 * 106.857;

/// How much of a colour the cones see, 0 (rods alone, below 0.01 cd/m2) to 1 (cones alone, above 4): a smooth step in the logarithm of the luminance
/// [cd/m2].
double share_of_cones(double luminance_cd_per_m2);

/// What an eye adapted to the night sees of a colour, on a screen: the cones' colour fades into the rods' grey as luminance falls. The rods see V = Y
/// (1.33 (1 + (Y + Z) / X) - 1.68) (G. W. Larson, H. Rushmeier and C. Piatko, "A visibility matching tone reproduction operator for high dynamic
/// range scenes", IEEE TVCG 3, 291, 1997), and their grey has the chromaticity (0.25, 0.25) before a screen whose white is D65 and the luminance
/// 0.4468 V (H. W. Jensen, F. Durand, M. Stark, S. Premoze, J. Dorsey and P. Shirley, "A physically-based night sky model", SIGGRAPH 2001, section 5;
/// hue from H. W. Jensen and others, "Night rendering", University of Utah UUCS-00-016, 2000). `rgb` within the gamut, as to_rgb made it of a
/// radiance [W m-2 sr-1 nm-1]; the result is linear Rec.709 in the same unit. Light above 4 cd/m2 stays what it is.
Rgb night_seen(const Rgb& rgb, const ToRgb& to_rgb);

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
