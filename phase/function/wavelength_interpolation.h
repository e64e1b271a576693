#pragma once
// From the wavelength nodes of a scattering table, some 10 nm apart, to a fine uniform grid.

#include <vector>

#include "phase/population/scattering_table.h"

namespace arcus::phase {

/// Phase functions on a uniform wavelength grid.
struct FineRows {
  int wavelength_count = 0;  ///< at least 2
  double first_wavelength_nm = 0, step_nm = 0;
  std::vector<float> value_per_sr;  ///< [size][angle][wavelength], wavelength fastest; integral over the sphere 1
};

/// Interpolates p11 to a grid of about the given step [nm] over the table's range. The forward lobe is clipped first
/// where `clip` and the table declares a forward fraction. A table of one wavelength gives two equal nodes.
FineRows interpolate_wavelengths(const ScatteringTable& table, bool clip, double step_nm);

}  // namespace arcus::phase
