#pragma once
// Mean radiance against the angle from a point of the sky: what makes a picture measurable. Needs a
// picture whose metadata say where its pixels look (src/scene/picture_metadata.h).

#include <optional>
#include <string>
#include <vector>

#include "phase/base/vec3.h"
#include "src/film/image.h"

namespace arcus::render {

struct ProfileSettings {
  /// sun | antisolar | zenith, or "AZIMUTH,ELEVATION" in degrees.
  std::string around = "antisolar";
  /// Width of a bin; 0: about the angle of a pixel, as 1, 2 or 5 times a power of ten.
  double bin_deg = 0;
  double from_deg = 0;  ///< angles below are left out
  double to_deg = 180;  ///< angles above are left out
  /// Only directions whose position angle about the centre is between these, counted through
  /// increasing angles (350 to 10 is a sector of 20 degrees). Position angle 0 points from the
  /// centre to the zenith and 90 to the right, as seen by who faces the centre; about the zenith or
  /// nadir it is the compass azimuth. Equal modulo 360: all.
  double sector_from_deg = 0;
  double sector_to_deg = 360;
};

/// One channel of a profile; [bin].
struct ProfileChannel {
  std::string name;
  std::vector<double> mean;            ///< over the solid angle of the bin that is on the picture
  std::vector<double> standard_error;  ///< of that mean
  /// The standard error is from the picture's channel variance.<name>; otherwise from the scatter
  /// of the pixels in a bin, which counts real differences along a ring as noise.
  bool error_is_from_variance = false;
};

struct Profile {
  std::string around;  ///< in words
  Vec3 centre;         ///< unit vector
  double bin_deg = 0;
  /// How the scattering angle follows from the angle of the profile: angle (about the sun), 180 -
  /// angle (about the antisolar point), or not at all.
  enum class Scattering { none, angle, supplement } scattering = Scattering::none;
  std::vector<double> angle_deg;         ///< centres of the bins that have pixels, ascending
  std::vector<double> solid_angle_sr;    ///< of each that is on the picture
  std::vector<double> pixels;            ///< number of pixels in each, parts counted as parts
  std::vector<ProfileChannel> channels;  ///< all of the picture but variance.*

  const ProfileChannel* channel(std::string_view name) const;
};

/// Measures a picture. `where` names it in messages. Pixels are divided into squares no larger than
/// half a bin (but not into more than 16 x 16), so a ring is found to a small part of a pixel.
/// Pixels with a value that is not finite, or only partly within a fisheye's circle, are left out.
/// Throws bad_input: metadata missing, an orthographic camera (all pixels look the same way), a
/// point that is no direction, no pixel in the range.
Profile measure_profile(const Image& image, const ProfileSettings& settings,
                        std::string_view where);

/// The profile as CSV: lines of # with what it is, a line of names, a row a bin. Columns:
/// angle_deg, where it has one scattering_angle_deg, solid_angle_sr, pixels, then each channel and
/// its standard error.
std::string csv_of(const Profile& profile, std::string_view picture_name);

}  // namespace arcus::render
