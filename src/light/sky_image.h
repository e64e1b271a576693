#pragma once
// A picture as the light from all around: columns are equally spaced in compass azimuth, clockwise, rows in elevation, as an equirectangular camera
// has them. A pixel's whole solid angle has its radiance, and directions are drawn in proportion to just that (M. Pharr, W. Jakob and
// G. Humphreys, "Physically Based Rendering", 4th ed. 2023, section 12.5, there with interpolation), by an alias table (M. Vose, IEEE
// Trans. Software Eng. 17(9), 1991).

#include <cstdint>
#include <vector>

#include "phase/base/raster.h"
#include "phase/base/three_spectra.h"
#include "phase/base/vec3.h"

namespace arcus::render {

class SkyImage {
 public:
  /// `rgb`: finite shares of the three spectra, 0 or more, above 0 somewhere [W m-2 sr-1 nm-1 in all with the spectra]. `azimuth_deg`: what the
  /// middle shows.
  SkyImage(Raster rgb, ThreeSpectra basis, double azimuth_deg);

  /// Radiance from a direction (unit, from the scene) [W m-2 sr-1 nm-1].
  Spectrum radiance(const Vec3& direction, const Wavelengths& wavelengths) const { return basis_.sum(rgb_.at(column(direction), row(direction)), wavelengths); }
  /// A direction, as likely as the mean of R, G and B there; u, v in [0, 1).
  Vec3 draw(double u, double v) const;
  /// Density of draw() [1/sr].
  double density_per_sr(const Vec3& direction) const { return brightness(rgb_.at(column(direction), row(direction))) / flux_; }

 private:
  /// A pixel takes the part `own` of its share of [0, 1), and another the rest.
  struct Alias {
    float own;
    std::uint32_t other;
  };

  static double brightness(const float* rgb) { return (static_cast<double>(rgb[0]) + rgb[1] + rgb[2]) / 3; }
  int column(const Vec3& direction) const;
  int row(const Vec3& direction) const;
  /// Sine of the elevation of a row's upper edge.
  double upper_sine(int row) const;

  Raster rgb_;
  ThreeSpectra basis_;
  double azimuth_rad_;
  double flux_;  ///< brightness integrated over the sphere
  std::vector<Alias> aliases_;
};

}  // namespace arcus::render
