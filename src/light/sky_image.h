#pragma once
// A picture as the light from all around: columns are equally spaced in compass azimuth, clockwise, rows in elevation, as an equirectangular camera
// has them. A pixel's whole solid angle has its radiance.
//
// Its bright places are asked for their light. Directions are drawn in proportion to what is brighter there than twice the mean: what is no
// brighter is found as well by paths that go their own way, at no cost (after O. Karlík et al., "MIS Compensation", ACM Trans. Graphics 38(6),
// 2019, who leave out the mean; twice the mean is what an even sky over black ground has). By an alias table (M. Vose, IEEE Trans. Software
// Eng. 17(9), 1991) over pixels (M. Pharr, W. Jakob and G. Humphreys, "Physically Based Rendering", 4th ed. 2023, section 12.5).

#include <algorithm>
#include <cstdint>
#include <optional>
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
  /// Whether any of it is worth asking.
  bool is_asked() const { return share_asked_ > 0; }
  /// A direction to ask, as likely as the mean of R, G and B there exceeds twice that of the sphere; otherwise nothing, as often as light is no such excess.
  /// u, v in [0, 1).
  std::optional<Vec3> draw(double u, double v) const;
  /// Density of draw() [1/sr]; less than 1 in all.
  double density_per_sr(const Vec3& direction) const { return excess(rgb_.at(column(direction), row(direction))) / flux_; }

 private:
  /// A pixel takes the part `own` of its share of [0, 1), and another the rest.
  struct Alias {
    float own;
    std::uint32_t other;
  };

  static double brightness(const float* rgb) { return (static_cast<double>(rgb[0]) + rgb[1] + rgb[2]) / 3; }
  double excess(const float* rgb) const { return std::max(0.0, brightness(rgb) - plain_); }
  int column(const Vec3& direction) const;
  int row(const Vec3& direction) const;
  /// Sine of the elevation of a row's upper edge.
  double upper_sine(int row) const;

  Raster rgb_;
  ThreeSpectra basis_;
  double azimuth_rad_;
  double flux_ = 0;         ///< brightness integrated over the sphere
  double plain_ = 0;        ///< brightness that is left to the paths
  double share_asked_ = 0;  ///< of the flux
  std::vector<Alias> aliases_;
};

}  // namespace arcus::render
