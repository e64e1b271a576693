#include "src/analysis/phase_chart.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "phase/base/frame.h"

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

/// Colours with the white of the sun, largest channel 0.8.
Strip strip_of(std::vector<Rgb> colours, const std::vector<double>& angle_deg, std::string label) {
  double most = 0;
  for (const Rgb& c : colours) most = std::max({most, c.r, c.g, c.b});
  for (Rgb& c : colours) c = {c.r * 0.8 / most, c.g * 0.8 / most, c.b * 0.8 / most};
  return {std::move(label), angle_deg, std::move(colours)};
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
  std::vector<Rgb> colours, relative;
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
  // Divided by the luminance around, over 5° to either side: what is left are the rings and bows.
  for (std::size_t i = 0; i < colours.size(); ++i) {
    double sum = 0, count = 0;
    for (std::size_t j = 0; j < colours.size(); ++j) {
      if (std::fabs(settings.angle_deg[j] - settings.angle_deg[i]) > 5) continue;
      const double luminance =
          0.2126 * colours[j].r + 0.7152 * colours[j].g + 0.0722 * colours[j].b;
      sum += std::log(std::max(luminance, 1e-30));
      ++count;
    }
    const double scale = std::exp(-sum / count);
    relative.push_back({colours[i].r * scale, colours[i].g * scale, colours[i].b * scale});
  }
  chart.strips.push_back(
      strip_of(colours, settings.angle_deg, "colour of a thin cloud in sunlight"));
  chart.strips.push_back(
      strip_of(relative, settings.angle_deg, "the same, divided by the brightness within 5°"));
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
