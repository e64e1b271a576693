#pragma once
// What a population of oriented crystals does to light, as plain arrays: the memory image of the NetCDF file. How much it stops
// depends on how high the light comes from; where sunlight goes is a map of the sky for one elevation of the sun.

#include <cstddef>
#include <string>
#include <vector>

namespace arcus::phase {

struct OrientedTable {
  std::vector<double> size_um;        ///< ascending, at least one: mean maximum dimension
  std::vector<double> wavelength_nm;  ///< ascending, at least one: in vacuum

  // Extinction, by |sine of the elevation| of the light's direction, linear between.
  std::vector<double> sine_elevation;  ///< ascending from 0 to 1
  // [size][wavelength][sine_elevation], the last fastest
  std::vector<double> extinction_cross_section_m2;  ///< mean of a crystal, complete (diffraction included)
  std::vector<double> forward_fraction;             ///< share of it that goes straight on and is in no map; below 1
  // [size][wavelength], wavelength fastest
  std::vector<double> mean_extinction_cross_section_m2;  ///< over all directions of light, complete
  std::vector<double> albedo;  ///< share of what is stopped (less the forward fraction) that is scattered: mean over all directions

  // The map: sunlight of the disc, limb-darkened, scattered once.
  double sun_elevation_deg = 0, sun_angular_radius_deg = 0;
  std::vector<double> elevation_deg;  ///< ascending from −90 to 90: where a viewer sees the light, opposite to its travel
  std::vector<double> azimuth_deg;    ///< ascending from 0 (the sun's) to 180; the other half is its mirror image
  /// Differential scattering cross-section, mean over a cell's neighbourhood [m2/sr], without what goes straight on:
  /// [size][elevation][azimuth][wavelength], wavelength fastest. At the nodes; bilinear between. Nine binary digits.
  std::vector<float> scattering_m2_per_sr;
  /// Standard error over value of the sum over wavelengths: [size][elevation][azimuth]. That of one is about the square root of
  /// their number larger.
  std::vector<float> relative_error;

  std::size_t row(std::size_t size, std::size_t wavelength) const { return size * wavelength_nm.size() + wavelength; }
  std::size_t cell(std::size_t size, std::size_t elevation, std::size_t azimuth) const {
    return (size * elevation_deg.size() + elevation) * azimuth_deg.size() + azimuth;
  }
};

/// Throws bad_input with `where` unless the table is one that can be rendered.
void check_table(const OrientedTable& table, const std::string& where);

}  // namespace arcus::phase
