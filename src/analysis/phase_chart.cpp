#include "src/analysis/phase_chart.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "phase/base/frame.h"
#include "src/film/tone.h"

namespace arcus::render {
namespace {

const Vec3 incoming(0, 0, 1);

std::string label_of(double wavelength_nm) {
  char text[40];
  std::snprintf(text, sizeof text, "%g nm", wavelength_nm);
  return text;
}

/// [wavelength][angle] 1/sr: of one size node or between two, four wavelengths at a time.
std::vector<std::vector<double>> values(const phase::Species& species,
                                        const std::vector<double>& wavelength_nm,
                                        const PhaseChartSettings& settings) {
  std::vector<std::vector<double>> result(wavelength_nm.size(),
                                          std::vector<double>(settings.angle_deg.size()));
  const auto size = static_cast<float>(settings.size_um);
  // The nearer of two size nodes.
  const phase::PhaseFunction function = species.phase_function(size, 0.5f);
  const bool with_disc = settings.with_sun_disc && function.includes_sun_disc();
  for (std::size_t first = 0; first < wavelength_nm.size(); first += wavelength_count) {
    Wavelengths four;
    for (std::size_t j = 0; j < wavelength_count; ++j)
      four.nm[j] = static_cast<float>(wavelength_nm[std::min(first + j, wavelength_nm.size() - 1)]);
    for (std::size_t i = 0; i < settings.angle_deg.size(); ++i) {
      const double half = radians(settings.angle_deg[i]) / 2;
      const Vec3 outgoing(2 * std::sin(half) * std::cos(half), 0,
                          1 - 2 * std::sin(half) * std::sin(half));
      const Spectrum value = with_disc ? function.sunlit_value(incoming, outgoing, four)
                                       : function.value(incoming, outgoing, four);
      for (std::size_t j = 0; j < wavelength_count && first + j < wavelength_nm.size(); ++j)
        result[first + j][i] = value[static_cast<int>(j)];
    }
  }
  return result;
}

double luminance_of(const Rgb& c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b; }

Rgb scaled(const Rgb& c, double factor) { return {c.r * factor, c.g * factor, c.b * factor}; }

/// Colours whose luminance, which spans decades, becomes a step of grey for each factor.
std::vector<Rgb> with_logarithmic_luminance(const std::vector<Rgb>& colours) {
  double least = std::numeric_limits<double>::max(), most = 0;
  for (const Rgb& c : colours) {
    least = std::min(least, std::max(luminance_of(c), 1e-30));
    most = std::max(most, luminance_of(c));
  }
  std::vector<Rgb> result;
  for (const Rgb& c : colours) {
    const double luminance = std::max(luminance_of(c), 1e-30);
    const double place = most > least ? std::log(luminance / least) / std::log(most / least) : 1;
    const double grey = 0.15 + 0.75 * place;  // of the eye's scale, whose square or so is the luminance
    result.push_back(display_linear(scaled(c, std::pow(grey, 2.2) / luminance)));
  }
  return result;
}

/// Divided by the luminance around, over 5° to either side: what is left are the rings and bows.
std::vector<Rgb> relative_to_surroundings(const std::vector<Rgb>& colours, const std::vector<double>& angle_deg) {
  constexpr double reach_deg = 5, middle_grey = 0.2;
  std::vector<Rgb> result;
  for (std::size_t i = 0; i < colours.size(); ++i) {
    double sum = 0, count = 0;
    for (std::size_t j = 0; j < colours.size(); ++j) {
      if (std::fabs(angle_deg[j] - angle_deg[i]) > reach_deg) continue;
      sum += std::log(std::max(luminance_of(colours[j]), 1e-30));
      ++count;
    }
    result.push_back(display_linear(scaled(colours[i], middle_grey * std::exp(-sum / count))));
  }
  return result;
}

}  // namespace

std::vector<double> chart_angles_deg(double from_deg, double to_deg) {
  std::vector<double> angles;
  for (double angle = from_deg; angle < to_deg;) {
    angles.push_back(angle);
    const double from_end = std::min(angle, 180 - angle);
    angle += std::min(std::clamp(0.02 * from_end, 0.02, 0.1), (to_deg - from_deg) / 400);
  }
  angles.push_back(to_deg);
  return angles;
}

LineChart phase_chart(const phase::Species& species, const Curve& sun_irradiance,
                      const PhaseChartSettings& settings) {
  LineChart chart;
  chart.title = settings.title;
  chart.subtitle = settings.with_sun_disc ? "averaged over the sun's disc" : "point source";
  chart.x_axis = {.title = "scattering angle [°]"};
  chart.y_axis = {.title = "phase function [1/sr]", .is_logarithmic = true};
  const auto curves = values(species, settings.wavelength_nm, settings);
  for (std::size_t w = 0; w < curves.size(); ++w)
    chart.lines.push_back({label_of(settings.wavelength_nm[w]),
                           settings.angle_deg,
                           curves[w],
                           {},
                           ink_of_wavelength(settings.wavelength_nm[w])});

  std::vector<double> all_nm;
  for (double nm = shortest_wavelength_nm; nm <= longest_wavelength_nm; nm += 5)
    all_nm.push_back(nm);
  const auto spectra = values(species, all_nm, settings);
  const ToRgb to_rgb = to_rgb_from_white(xyz_of([&](double nm) { return sun_irradiance(nm); }));
  std::vector<Rgb> colours;
  const auto size = static_cast<float>(settings.size_um);
  std::vector<double> strength(all_nm.size());
  for (std::size_t w = 0; w < all_nm.size(); ++w) {
    const float nm = static_cast<float>(all_nm[w]);
    const Wavelengths one{{nm, nm, nm, nm}};
    strength[w] = sun_irradiance(all_nm[w]) * species.extinction_ratio(size, one)[0] *
                  species.albedo(size, one)[0];
  }
  for (std::size_t i = 0; i < settings.angle_deg.size(); ++i) {
    const auto spectrum = [&](double nm) {
      const double place = (nm - all_nm[0]) / 5;
      const auto low = std::min(static_cast<std::size_t>(place), all_nm.size() - 2);
      const double share = place - static_cast<double>(low);
      return (1 - share) * spectra[low][i] * strength[low] +
             share * spectra[low + 1][i] * strength[low + 1];
    };
    colours.push_back(to_rgb(xyz_of(spectrum)));
  }
  chart.strips.push_back({"colour of a thin cloud in sunlight, brightness logarithmic", settings.angle_deg,
                          with_logarithmic_luminance(colours)});
  chart.strips.push_back({"the same, divided by the brightness within 5°", settings.angle_deg,
                          relative_to_surroundings(colours, settings.angle_deg)});
  return chart;
}

PolarChart phase_polar_chart(const phase::Species& species, const PhaseChartSettings& settings) {
  PolarChart chart;
  chart.title = settings.title;
  chart.subtitle = "light comes from the left; 0° is straight on";
  chart.radius_axis = {.title = "phase function [1/sr]", .is_logarithmic = true};
  const auto curves = values(species, settings.wavelength_nm, settings);
  for (std::size_t w = 0; w < curves.size(); ++w)
    chart.lines.push_back({label_of(settings.wavelength_nm[w]),
                           settings.angle_deg,
                           curves[w],
                           {},
                           ink_of_wavelength(settings.wavelength_nm[w])});
  return chart;
}

}  // namespace arcus::render
