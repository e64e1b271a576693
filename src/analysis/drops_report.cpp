// The figures and the page of a comparison of drops (drops_comparison.h).

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "src/analysis/chart.h"
#include "src/analysis/drops_comparison.h"
#include "src/analysis/html_page.h"
#include "src/film/image_file.h"

namespace arcus::render {
namespace {

template <class... Values>
std::string written(const char* format, Values... values) {
  char text[400];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

std::string agreement_text(const char* name, const Agreement& a) {
  return written("%s: chi-square %.1f over %zu places, chance gives %.1f (%+.1f sigma); light of drops over that of the medium %.4f +- %.4f\n", name,
                 a.chi_square, a.places, a.expected, a.sigma, a.mean_ratio, a.mean_ratio_error);
}

Line line_of(const char* label, const DropsComparison& c, const RunMeans& means, const Ink& ink, bool is_dashed) {
  return {label, c.angle_deg, means.mean, means.standard_error, ink, 1.5, is_dashed};
}

LineChart profile_chart(const DropsComparison& c) {
  LineChart chart;
  chart.title = "Luminance around " + c.around;
  chart.subtitle = written("means of %d runs; bands: one standard error", c.runs);
  chart.x_axis.title = "angle from " + c.around + " [°]";
  chart.y_axis = {"Y [W m⁻² sr⁻¹ nm⁻¹]", false, 0.0};
  chart.lines = {line_of("medium, geometric optics", c, c.medium_profile, {0.1, 0.3, 0.8}, false),
                 line_of("explicit drops", c, c.drops_profile, {0.85, 0.2, 0.1}, false),
                 line_of("medium, its own optics", c, c.waves_profile, {0.4, 0.4, 0.4}, true)};
  return chart;
}

LineChart difference_chart(const DropsComparison& c) {
  LineChart chart;
  chart.title = "Explicit drops over the medium";
  chart.subtitle = "ratio of luminances; band: one standard error of both";
  chart.x_axis.title = "angle from " + c.around + " [°]";
  chart.y_axis = {"ratio", false};
  Line ratio{"drops / medium", {}, {}, {}, {0.85, 0.2, 0.1}}, one{"", {}, {}, {}, {0.3, 0.3, 0.3}, 1, true};
  for (std::size_t i = 0; i < c.angle_deg.size(); ++i) {
    const double m = c.medium_profile.mean[i], d = c.drops_profile.mean[i];
    if (!(m > 0)) continue;
    ratio.x.push_back(c.angle_deg[i]);
    ratio.y.push_back(d / m);
    ratio.error.push_back(std::hypot(c.drops_profile.standard_error[i], c.medium_profile.standard_error[i] * d / m) / m);
    one.x.push_back(c.angle_deg[i]);
    one.y.push_back(1);
  }
  chart.lines = {ratio, one};
  return chart;
}

LineChart time_chart(const DropsComparison& c) {
  LineChart chart;
  chart.title = "Time against the number of drops";
  chart.subtitle = written("%lld samples a pixel, building included", c.timed_samples);
  chart.x_axis = {"drops", true};
  chart.y_axis = {"seconds", true};
  Line drops{"explicit drops", {}, {}, {}, {0.85, 0.2, 0.1}}, medium{"medium", {}, {}, {}, {0.1, 0.3, 0.8}, 1.5, true};
  double medium_s = 0;
  for (const TimedRender& t : c.times) {
    if (t.drops == 0) {
      medium_s = t.build_s + t.render_s;
    } else {
      drops.x.push_back(static_cast<double>(t.drops));
      drops.y.push_back(t.build_s + t.render_s);
    }
  }
  medium.x = drops.x;
  medium.y.assign(drops.x.size(), medium_s);
  chart.lines = {drops, medium};
  return chart;
}

}  // namespace

std::string figures_text(const DropsComparison& c) {
  std::string text = written("%lld drops, %d runs, sun of radius %g degrees\n", c.drops, c.runs, c.sun_radius_deg);
  text += written("samples a pixel, in all runs: medium %lld in %.1f s, drops %lld in %.1f s; for the same error drops need %.0f times the medium's time\n",
                  c.medium_samples_per_pixel, c.medium_s, c.samples_per_pixel, c.drops_s, c.time_for_equal_error);
  text += written("optical depth along the camera's rays: medium %.4f, drops %.4f +- %.4f (%zu rays a run)\n", c.depth.medium, c.depth.drops, c.depth.drops_error,
                  c.depth.rays);
  if (!c.around.empty()) text += agreement_text("profile", c.profile_agreement);
  text += agreement_text("blocks", c.block_agreement);
  for (const TimedRender& t : c.times)
    text += t.drops == 0 ? written("time of the medium: %.3f s to build, %.3f s to render\n", t.build_s, t.render_s)
                         : written("time of %lld drops: %.3f s to build, %.3f s to render\n", t.drops, t.build_s, t.render_s);
  return text;
}

std::string html_report(const DropsComparison& c) {
  HtmlPage page("A medium and explicit drops");
  page.add_paragraph(c.scene);
  page.add_preformatted(figures_text(c));
  page.add_heading("Pictures");
  page.add_picture(png_bytes(tone_mapped(c.medium, c.tone)), "the medium, by geometric optics");
  page.add_picture(png_bytes(tone_mapped(c.explicit_drops, c.tone)), "explicit drops, at the same exposure");
  page.add_picture(png_bytes(tone_mapped(c.waves, c.tone)), "the medium, by its own optics");
  if (!c.around.empty()) {
    page.add_heading("Profile");
    page.add_chart(png_of(profile_chart(c)), "luminance of all three");
    page.add_chart(png_of(difference_chart(c)), "ratio");
    std::vector<std::vector<std::string>> rows{{"angle [°]", "medium", "±", "drops", "±", "drops / medium", "own optics", "±"}};
    for (std::size_t i = 0; i < c.angle_deg.size(); ++i) {
      const double m = c.medium_profile.mean[i], d = c.drops_profile.mean[i];
      rows.push_back({written("%.3f", c.angle_deg[i]), written("%.5g", m), written("%.2g", c.medium_profile.standard_error[i]), written("%.5g", d),
                      written("%.2g", c.drops_profile.standard_error[i]), m > 0 ? written("%.4f", d / m) : "", written("%.5g", c.waves_profile.mean[i]),
                      written("%.2g", c.waves_profile.standard_error[i])});
    }
    page.add_table(rows);
  }
  if (c.times.size() > 1) {
    page.add_heading("Time");
    page.add_chart(png_of(time_chart(c)), "seconds against the number of drops");
  }
  return page.text();
}

}  // namespace arcus::render
