#pragma once
// How two pictures of the same thing differ: error figures, differences against their noise, a
// report to look at.

#include <optional>
#include <string>
#include <vector>

#include "src/film/image.h"
#include "src/film/tone.h"

namespace arcus::render {

/// Differences against their noise, from the variance channels of both pictures. z of a pixel is
/// its difference over the standard deviation of the difference.
struct NoiseFigures {
  double rms_z = 0;              ///< 1 where the noise explains the differences
  double share_beyond_3 = 0;     ///< of the pixels with |z| > 3; 0.0027 for normal noise
  double mean_difference_z = 0;  ///< the mean difference over its standard error
  std::size_t pixels = 0;        ///< with a known variance above 0; the others do not count here
};

/// One channel of both pictures; differences are a - b.
struct ChannelDifference {
  std::string name;
  double mean_a = 0, mean_b = 0;
  double mean_difference = 0;
  double rmse = 0;          ///< root of the mean squared difference
  double relative_mse = 0;  ///< mean of (a - b)² / (b² + m²/1000), m = mean_b: b is the reference
  double largest = 0;       ///< largest |a - b| ...
  int largest_x = 0, largest_y = 0;   ///< ... and where
  std::optional<NoiseFigures> noise;  ///< where both pictures have the variance of this channel
};

struct Comparison {
  std::vector<ChannelDifference>
      channels;                ///< those that both have, without the variances, in the order of a
  std::size_t pixels = 0;      ///< compared
  std::size_t not_finite = 0;  ///< pixels left out because a value of either is not finite
  std::vector<std::string> only_a, only_b;  ///< channels that the other does not have
  bool is_equal = false;  ///< all compared values are the same, and none was left out
};

/// Compares two pictures of equal box. Throws Error (mismatch) where size or box differ or no
/// channel is common. The names are for messages.
Comparison compare(const Image& a, const Image& b, std::string_view name_a,
                   std::string_view name_b);

/// The figures as a table for a terminal.
std::string figures_text(const Comparison& comparison);

/// The signed difference of a channel: red where a is brighter, blue where b is, white for none;
/// full colour at `full` and beyond. Grey where a value is not finite.
DisplayPicture difference_picture(const Image& a, const Image& b, const std::string& channel,
                                  double full);
/// The same of z; grey also where the variance is not known.
DisplayPicture z_picture(const Image& a, const Image& b, const std::string& channel,
                         double full = 4);

/// One HTML page without any other file: figures, both pictures with the same exposure, difference,
/// z, histogram of z.
std::string html_report(const Image& a, const Image& b, const Comparison& comparison,
                        std::string_view name_a, std::string_view name_b);

}  // namespace arcus::render
