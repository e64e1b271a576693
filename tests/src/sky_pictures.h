#pragma once
// Skies that are pictures, for tests, without files.

#include <algorithm>
#include <memory>

#include "src/light/sky.h"

namespace arcus::render {

/// Three spectra of a third each: grey pixels have their value at every wavelength.
inline ThreeSpectra flat_basis() {
  const std::vector<double> third(ThreeSpectra::cells + 1, 1.0 / 3);
  return ThreeSpectra({third, third, third});
}

/// Grey, from its pixels: radiance(column, row).
template <class Radiance>
Raster sky_raster(int height, const Radiance& radiance) {
  Raster raster{2 * height, height, 3, {}};
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < 2 * height; ++column) raster.values.insert(raster.values.end(), 3, static_cast<float>(radiance(column, row)));
  return raster;
}

inline Sky sky_of(const Raster& raster, double azimuth_deg = 0) {
  return Sky({.type = "image"}, Curve({550}, {1}, ""), std::make_shared<const SkyImage>(raster, flat_basis(), azimuth_deg));
}

/// Irradiance of a sky of grey pixels on a level surface, in closed form [W m-2 nm-1].
inline double irradiance_of(const Raster& raster) {
  double sum = 0;
  for (int row = 0; row < raster.height / 2; ++row) {
    const double upper = std::cos(pi * row / raster.height), lower = std::cos(pi * (row + 1) / raster.height);
    for (int column = 0; column < raster.width; ++column)
      sum += static_cast<double>(raster.at(column, row)[0]) * 0.5 * (upper * upper - lower * lower) * 2 * pi / raster.width;
  }
  return sum;
}

}  // namespace arcus::render
