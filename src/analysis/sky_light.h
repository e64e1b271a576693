#pragma once
// Colours of sunlight that thin clouds of crystals send down from all over the sky.

#include <vector>

#include "phase/base/curve.h"
#include "phase/population/oriented_table.h"
#include "src/film/colour.h"

namespace arcus::render {

class SkyLight {
 public:
  explicit SkyLight(Curve sun_irradiance) : sun_irradiance_(std::move(sun_irradiance)) {}

  /// A cloud more. weight: its optical depth, complete as media have it, over a unit that is the same for all; the table's first
  /// size counts.
  void add(const phase::OrientedTable& table, double weight);

  /// Linear Rec.709 in which the sun is white, in one unit for all directions. azimuth: from the sun's.
  Rgb operator()(double azimuth_deg, double elevation_deg) const;

 private:
  struct Layer {
    std::size_t rows, columns;  ///< elevation from -90 to 90, azimuth from 0 to 180, both at equal steps
    std::vector<float> rgb;     ///< [elevation][azimuth][R G B]
  };

  Curve sun_irradiance_;
  std::vector<Layer> layers_;
};

/// How bright each wavelength node of a spectrum is to the eye in sunlight, linear between nodes; their sum is 1.
std::vector<double> luminous_weights(const std::vector<double>& wavelength_nm, const Curve& sun_irradiance);

}  // namespace arcus::render
