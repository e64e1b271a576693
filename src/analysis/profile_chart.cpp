#include "src/analysis/profile_chart.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace arcus::render {
namespace {

/// The channels that are drawn: R, G, B before X, Y, Z before all.
std::vector<const ProfileChannel*> drawn(const Profile& profile) {
  for (const auto& names :
       {std::vector<const char*>{"R", "G", "B"}, std::vector<const char*>{"X", "Y", "Z"}}) {
    std::vector<const ProfileChannel*> found;
    for (const char* name : names)
      if (const ProfileChannel* channel = profile.channel(name)) found.push_back(channel);
    if (found.size() == names.size()) return found;
  }
  std::vector<const ProfileChannel*> all;
  for (const ProfileChannel& channel : profile.channels) all.push_back(&channel);
  return all;
}

std::string number(const char* format, double value) {
  char text[60];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

/// What a tenth of the values are below: the least of them would be a matter of noise.
double tenth_percentile(std::vector<double> values) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 10);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Colours along the angle, scaled so that the brightest is a bright white.
Strip strip_of(const Profile& profile, const std::vector<const ProfileChannel*>& rgb,
               bool subtracts_background) {
  double background[3] = {}, most = 0;
  for (std::size_t c = 0; c < 3; ++c)
    if (subtracts_background) background[c] = tenth_percentile(rgb[c]->mean);
  for (std::size_t c = 0; c < 3; ++c)
    for (const double v : rgb[c]->mean) most = std::max(most, v - background[c]);
  Strip strip{
      subtracts_background
          ? "the same with the background subtracted: what a tenth of the angles are below, in each channel"
          : "colours as the picture has them",
      profile.angle_deg,
      {}};
  const double scale = most > 0 ? 0.8 / most : 1;
  for (std::size_t i = 0; i < profile.angle_deg.size(); ++i)
    strip.colours.push_back({(rgb[0]->mean[i] - background[0]) * scale,
                             (rgb[1]->mean[i] - background[1]) * scale,
                             (rgb[2]->mean[i] - background[2]) * scale});
  strip.x.front() -= 0.5 * profile.bin_deg;  // the bins' outer ends
  strip.x.back() += 0.5 * profile.bin_deg;
  return strip;
}

}  // namespace

std::vector<Peak> peaks_of(const Profile& profile, const ProfileChannel& channel) {
  return find_peaks(profile.angle_deg, channel.mean, channel.standard_error);
}

std::string peaks_text(const Profile& profile) {
  std::string text;
  for (const ProfileChannel* channel : drawn(profile)) {
    for (const Peak& peak : peaks_of(profile, *channel)) {
      text += "peak of " + channel->name + " at " + number("%.3f", peak.position) +
              " degrees from " + profile.around;
      if (profile.scattering == Profile::Scattering::supplement)
        text += " (scattering angle " + number("%.3f", 180 - peak.position) + ")";
      text += ": " + number("%.4g", peak.height) + ", " + number("%.3g", peak.prominence) +
              " above its surroundings\n";
    }
  }
  return text;
}

LineChart chart_of(const Profile& profile, const std::string& picture_name, bool is_logarithmic) {
  LineChart chart;
  chart.title = "Mean radiance around " + profile.around;
  chart.subtitle = picture_name + " · bins of " + number("%g", profile.bin_deg) +
                   "° · bands: one standard error";
  chart.x_axis.title = "angle from " + profile.around + " [°]";
  chart.x_axis.low = profile.angle_deg.front() - 0.5 * profile.bin_deg;
  chart.x_axis.high = profile.angle_deg.back() + 0.5 * profile.bin_deg;
  chart.y_axis = {"mean radiance [W m⁻² sr⁻¹ nm⁻¹]", is_logarithmic};
  const auto channels = drawn(profile);
  struct Found {
    Peak peak;
    const ProfileChannel* channel;
  };
  std::vector<Found> found;
  for (const ProfileChannel* channel : channels) {
    chart.lines.push_back({channel->name, profile.angle_deg, channel->mean, channel->standard_error,
                           ink_of_channel(channel->name)});
    for (const Peak& peak : peaks_of(profile, *channel)) found.push_back({peak, channel});
  }
  // More words than this would cover the curves.
  constexpr std::size_t most_marks = 9;
  std::stable_sort(found.begin(), found.end(), [](const Found& a, const Found& b) {
    return a.peak.prominence > b.peak.prominence;
  });
  found.resize(std::min(found.size(), most_marks));
  std::sort(found.begin(), found.end(),
            [](const Found& a, const Found& b) { return a.peak.position < b.peak.position; });
  for (const Found& f : found)
    chart.marks.push_back(
        {f.peak.position, f.channel->name + " " + number("%.2f°", f.peak.position)});
  if (channels.size() == 3 && channels[0]->name == "R") {
    chart.strips.push_back(strip_of(profile, channels, false));
    chart.strips.push_back(strip_of(profile, channels, true));
  }
  return chart;
}

}  // namespace arcus::render
