// The pictures and the page of a comparison (compare.h).

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "src/analysis/chart.h"
#include "src/analysis/compare.h"
#include "src/analysis/html_page.h"
#include "src/analysis/pixel_pairs.h"
#include "src/film/image_file.h"

namespace arcus::render {
namespace {

/// White for 0, through light to full red (positive) or blue (negative) at +-1; equal steps look
/// about equal.
std::array<std::uint8_t, 3> diverging(double value) {
  // In 32 steps to either side, which an eye hardly tells apart: noise in full depth would make the
  // file three times as large.
  const double v = std::round(32 * std::clamp(value, -1.0, 1.0)) / 32, share = std::fabs(v);
  const std::array<double, 3> end =
      v > 0 ? std::array<double, 3>{0.70, 0.02, 0.10} : std::array<double, 3>{0.02, 0.22, 0.62};
  std::array<std::uint8_t, 3> bytes;
  for (std::size_t i = 0; i < 3; ++i)
    bytes[i] =
        static_cast<std::uint8_t>(std::lround(255 * (1 + std::pow(share, 0.7) * (end[i] - 1))));
  return bytes;
}

/// One pixel of colour for each pair; value_of gives what is shown as a share of full colour, or
/// nothing (grey).
template <class ValueOf>
DisplayPicture painted(const Image& a, const Image& b, const std::string& channel,
                       const ValueOf& value_of) {
  DisplayPicture picture{a.box().width(), a.box().height(), {}};
  picture.rgb.reserve(3 * a.box().pixels());
  const PixelPairs pairs(a, b);
  pairs.for_each(pairs.channel(channel), [&](const PixelPair& p) {
    const std::optional<double> value = value_of(p);
    const auto colour = value ? diverging(*value) : std::array<std::uint8_t, 3>{128, 128, 128};
    picture.rgb.insert(picture.rgb.end(), colour.begin(), colour.end());
  });
  return picture;
}

/// A quantile of |a - b|, or of the brightness of b, over the finite pixels; 0 where there is none.
template <class ValueOf>
double quantile(const Image& a, const Image& b, const std::string& channel, double share,
                const ValueOf& value_of) {
  std::vector<double> values;
  const PixelPairs pairs(a, b);
  pairs.for_each(pairs.channel(channel), [&](const PixelPair& p) {
    if (p.is_finite()) values.push_back(value_of(p));
  });
  if (values.empty()) return 0;
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// How often which z occurs, beside the standard normal density.
LineChart z_histogram(const Image& a, const Image& b, const Comparison& comparison) {
  constexpr double widest = 6, step = 0.2;
  constexpr auto bins = static_cast<std::size_t>(2 * widest / step + 0.5);
  LineChart chart;
  chart.title = "Differences over their standard deviation";
  chart.subtitle = "density over the pixels; dashed: what noise alone gives";
  chart.x_axis = {"z = (A − B) / standard deviation", false, -widest, widest};
  chart.y_axis = {"density", false, 0.0};
  chart.width = 720;
  chart.height = 420;
  const PixelPairs pairs(a, b);
  for (const ChannelDifference& c : comparison.channels) {
    if (!c.noise || c.noise->pixels == 0) continue;
    Line line{c.name, {}, std::vector<double>(bins), {}, ink_of_channel(c.name)};
    for (std::size_t i = 0; i < bins; ++i)
      line.x.push_back(-widest + (static_cast<double>(i) + 0.5) * step);
    pairs.for_each(pairs.channel(c.name), [&](const PixelPair& p) {
      const auto z = p.z();
      if (!z) return;
      const double bin = std::clamp((*z + widest) / step, 0.0, static_cast<double>(bins) - 1);
      line.y[static_cast<std::size_t>(bin)] += 1 / (step * static_cast<double>(c.noise->pixels));
    });
    chart.lines.push_back(std::move(line));
  }
  Line normal{"noise alone", {}, {}, {}, {0.3, 0.3, 0.3}, 1.2, true};
  for (double z = -widest; z <= widest; z += 0.05) {
    normal.x.push_back(z);
    normal.y.push_back(std::exp(-0.5 * z * z) / 2.5066282746310002);
  }
  chart.lines.push_back(std::move(normal));
  return chart;
}

}  // namespace

DisplayPicture difference_picture(const Image& a, const Image& b, const std::string& channel,
                                  double full) {
  return painted(a, b, channel, [full](const PixelPair& p) -> std::optional<double> {
    if (!p.is_finite()) return std::nullopt;
    return full > 0 ? (p.a - p.b) / full : 0;
  });
}

DisplayPicture z_picture(const Image& a, const Image& b, const std::string& channel, double full) {
  return painted(a, b, channel, [full](const PixelPair& p) -> std::optional<double> {
    const auto z = p.z();
    return z ? std::optional(*z / full) : std::nullopt;
  });
}

std::string html_report(const Image& a, const Image& b, const Comparison& comparison,
                        std::string_view name_a, std::string_view name_b) {
  const std::string& first = comparison.channels.front().name;
  const std::string shown = b.channel("G") && a.channel("G") ? "G" : first;
  // The exposure that brings all but the brightest half percent of B below the shoulder.
  const double bright = quantile(a, b, shown, 0.995, [](const PixelPair& p) { return p.b; });
  const ToneSettings tone{0, bright > 0 ? bright / 0.6 : 1};
  char number[60];
  HtmlPage page("Comparison");
  page.add_paragraph("A: " + std::string(name_a));
  page.add_paragraph("B: " + std::string(name_b));
  page.add_preformatted(figures_text(comparison));
  page.add_heading("Pictures");
  page.add_picture(png_bytes(tone_mapped(a, tone)), "A");
  page.add_picture(png_bytes(tone_mapped(b, tone)), "B, at the same exposure");
  page.add_heading("Difference");
  for (const ChannelDifference& c : comparison.channels) {
    if (c.name.starts_with("S0.")) continue;  // dozens of nearly equal pictures
    const double full =
        quantile(a, b, c.name, 0.99, [](const PixelPair& p) { return std::fabs(p.a - p.b); });
    const double scale = full > 0 ? full : c.largest;
    std::snprintf(number, sizeof number, "%.3g", scale);
    page.add_picture(png_bytes(difference_picture(a, b, c.name, scale), true),
                     c.name + ": A − B, red where A is brighter, full colour at " + number);
    if (c.noise)
      page.add_picture(png_bytes(z_picture(a, b, c.name), true), c.name + ": z, full colour at 4 standard deviations");
  }
  const bool has_z = std::any_of(comparison.channels.begin(), comparison.channels.end(),
                                 [](const auto& c) { return c.noise && c.noise->pixels > 0; });
  if (has_z) {
    page.add_heading("Against the noise");
    page.add_chart(png_of(z_histogram(a, b, comparison)), "histogram of z");
  }
  return page.text();
}

}  // namespace arcus::render
