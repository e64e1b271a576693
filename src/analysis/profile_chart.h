#pragma once
// A profile as a chart: curves with their errors, peaks, and the colours along the angle.

#include <string>
#include <vector>

#include "src/analysis/chart.h"
#include "src/analysis/peaks.h"
#include "src/analysis/profile.h"

namespace arcus::render {

/// Peaks of one channel of a profile; see find_peaks.
std::vector<Peak> peaks_of(const Profile& profile, const ProfileChannel& channel);

/// A line for each peak of R, G and B (of all channels where there is no R): channel, angle,
/// scattering angle where there is one, value. For a terminal; empty where there is no peak.
std::string peaks_text(const Profile& profile);

/// R, G and B (or X, Y and Z, or all channels) with bands of one standard error, the most prominent
/// peaks, and strips with the colours: as the picture shows them at one exposure, and with the
/// background subtracted.
LineChart chart_of(const Profile& profile, const std::string& picture_name, bool is_logarithmic);

}  // namespace arcus::render
