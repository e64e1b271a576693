#pragma once
// A medium of drops against explicit drops drawn from it: do both show the same? Like is compared with like: the same sun, and the same
// particles by geometric optics in both; the medium's own optics (waves) beside them.

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "src/analysis/profile.h"
#include "src/film/image.h"
#include "src/film/tone.h"
#include "src/render/render.h"
#include "src/scene/build_scene.h"
#include "src/scene/settings.h"

namespace arcus::render {

struct DropsComparisonOptions {
  long long drops = 100000;  ///< explicit drops for each medium
  /// Each with places of the drops and random numbers of its own: errors are from their scatter, so the chance of how drops lie is in
  /// them. At least 4.
  int runs = 16;
  ProfileSettings profile;
  int blocks = 8;                       ///< the picture is divided into so many along its longer edge
  std::vector<long long> timed_counts;  ///< numbers of drops whose time is taken
  BuildOptions build;
  RunOptions run;
  std::function<void(std::string_view)> log;  ///< told what is being done
};

/// Means over the runs, and their standard errors: [place].
struct RunMeans {
  std::vector<double> mean, standard_error;
};

/// How two series of means agree.
struct Agreement {
  std::size_t places = 0;      ///< with light in either
  double chi_square = 0;       ///< sum of squared differences over their variances
  /// What chance alone would give: each square is of a Student's t, whose mean is a little above 1 (errors are from few runs).
  double expected = 0;
  double sigma = 0;            ///< of the normal distribution: how far chi_square is above what chance gives (Wilson and Hilferty 1931)
  double mean_ratio = 0;       ///< of all light, the first over the second ...
  double mean_ratio_error = 0; ///< ... and its standard error
};

/// Of the camera's rays through the medium. Drops take light where they stand; a medium by Beer and Lambert's law.
struct DepthComparison {
  double medium = 0, drops = 0, drops_error = 0;  ///< −ln of the mean transmittance at 550 nm
  std::size_t rays = 0;                           ///< that meet the medium, a run
};

struct TimedRender {
  std::string name;
  long long drops = 0;      ///< 0: a medium
  double build_s = 0, render_s = 0;
};

struct DropsComparison {
  std::string scene;
  double sun_radius_deg = 0;
  long long drops = 0, samples_per_pixel = 0;  ///< of the drops ...
  long long medium_samples_per_pixel = 0;      ///< ... and of the medium, in all runs
  double drops_s = 0, medium_s = 0;            ///< that rendering took, in all runs
  /// How much longer the drops need for the same error: mean over the blocks of squared standard error times seconds, over the medium's.
  double time_for_equal_error = 0;
  int runs = 0;
  Image medium, explicit_drops, waves;  ///< means of the runs: R, G, B, X, Y, Z
  ToneSettings tone;
  std::string around;             ///< what the profile is around; empty: the camera has no directions
  std::vector<double> angle_deg;  ///< of its bins
  RunMeans medium_profile, drops_profile, waves_profile;  ///< luminance Y [W m-2 sr-1 nm-1]
  Agreement profile_agreement;
  RunMeans medium_blocks, drops_blocks;                   ///< luminance Y, row by row
  Agreement block_agreement;
  DepthComparison depth;
  long long timed_samples = 0;  ///< a pixel
  std::vector<TimedRender> times;
};

/// Throws bad_input where the scene has no medium of drops. Where RunOptions::stop_request stops it, so many runs as are done are in it.
DropsComparison compare_drops(const SceneSettings& scene, const DropsComparisonOptions& options);

/// Whether two series of means are the same.
Agreement agreement_of(const std::vector<std::vector<double>>& a, const std::vector<std::vector<double>>& b);

/// The figures for a terminal.
std::string figures_text(const DropsComparison& comparison);
/// One HTML page: pictures, profiles with their errors, figures, times.
std::string html_report(const DropsComparison& comparison);

}  // namespace arcus::render
