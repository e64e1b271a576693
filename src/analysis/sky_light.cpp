#include "src/analysis/sky_light.h"

#include <algorithm>
#include <cmath>

namespace arcus::render {
namespace {

/// XYZ of sunlight times a hat over each node; beyond the outer nodes light is as it is there.
std::vector<Xyz> hats(const std::vector<double>& nm, const Curve& sun) {
  std::vector<Xyz> parts;
  for (std::size_t i = 0; i < nm.size(); ++i)
    parts.push_back(xyz_of([&](double at) {
      double share = 1;
      if (at < nm[i] && i > 0) share = std::max(0.0, (at - nm[i - 1]) / (nm[i] - nm[i - 1]));
      if (at > nm[i] && i + 1 < nm.size()) share = std::max(0.0, (nm[i + 1] - at) / (nm[i + 1] - nm[i]));
      return share * sun(at);
    }));
  return parts;
}

}  // namespace

std::vector<double> luminous_weights(const std::vector<double>& wavelength_nm, const Curve& sun_irradiance) {
  std::vector<double> weights;
  double sum = 0;
  for (const Xyz& part : hats(wavelength_nm, sun_irradiance)) {
    weights.push_back(part.y);
    sum += part.y;
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

void SkyLight::add(const phase::OrientedTable& table, double weight) {
  const std::vector<Xyz> parts = hats(table.wavelength_nm, sun_irradiance_);
  const Xyz white = xyz_of([&](double nm) { return sun_irradiance_(nm); });
  const ToRgb to_rgb = to_rgb_from_white(white);
  // Media are told by their extinction at 550 nm, which for crystals is that of all wavelengths near by.
  std::size_t middle = 0;
  for (std::size_t w = 0; w < table.wavelength_nm.size(); ++w)
    if (std::fabs(table.wavelength_nm[w] - 550) < std::fabs(table.wavelength_nm[middle] - 550)) middle = w;
  const double factor = weight / (table.mean_extinction_cross_section_m2[table.row(0, middle)] * white.y);
  Layer layer{table.elevation_deg.size(), table.azimuth_deg.size(), {}};
  layer.rgb.resize(3 * layer.rows * layer.columns);
  const std::size_t waves = table.wavelength_nm.size();
  for (std::size_t at = 0; at < layer.rows * layer.columns; ++at) {
    Xyz sum;
    for (std::size_t w = 0; w < waves; ++w) sum += parts[w] * static_cast<double>(table.scattering_m2_per_sr[at * waves + w]);
    const Rgb rgb = to_rgb(sum);
    layer.rgb[3 * at] = static_cast<float>(factor * rgb.r);
    layer.rgb[3 * at + 1] = static_cast<float>(factor * rgb.g);
    layer.rgb[3 * at + 2] = static_cast<float>(factor * rgb.b);
  }
  layers_.push_back(std::move(layer));
}

Rgb SkyLight::operator()(double azimuth_deg, double elevation_deg) const {
  const double azimuth = std::fabs(std::remainder(azimuth_deg, 360.0));
  double sum[3] = {};
  for (const Layer& layer : layers_) {
    const double row = std::clamp((elevation_deg + 90) / 180, 0.0, 1.0) * static_cast<double>(layer.rows - 1);
    const double column = azimuth / 180 * static_cast<double>(layer.columns - 1);
    const std::size_t r = std::min(static_cast<std::size_t>(row), layer.rows - 2), c = std::min(static_cast<std::size_t>(column), layer.columns - 2);
    const double up = row - static_cast<double>(r), around = column - static_cast<double>(c);
    const float* at = &layer.rgb[3 * (r * layer.columns + c)];
    const float* above = at + 3 * layer.columns;
    for (int k = 0; k < 3; ++k)
      sum[k] += (1 - up) * ((1 - around) * at[k] + around * at[k + 3]) + up * ((1 - around) * above[k] + around * above[k + 3]);
  }
  return {sum[0], sum[1], sum[2]};
}

}  // namespace arcus::render
