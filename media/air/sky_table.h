#pragma once
// Light of a clear sky, tabulated for one sun: by height, how high the sun stands at the place, direction, and wavelength. Light that was scattered once is kept
// without its phase functions, which are asked when the table is read, so that the glow around the sun is as sharp as it is.

#include <memory>
#include <vector>

#include "media/air/sky_source.h"

namespace arcus::media {

class SkyTable {
 public:
  /// For places up to a height and as far from the origin; those beyond are taken as at the end. Takes seconds; haze may be none.
  SkyTable(const Atmosphere& air, std::shared_ptr<const Haze> haze, const SkySettings& settings, double highest_m, double farthest_m);

  /// Radiance that arrives from a direction (unit), the sun's disc left out, for unit irradiance of the sun on a surface that faces it [1/sr].
  Spectrum radiance(const Vec3& position_m, const Vec3& direction, const Wavelengths& wavelengths) const;

 private:
  struct Entry {
    SkyLanes molecules, haze, before;  ///< once by molecules and by haze, over the phase function; all that was scattered before or comes from the ground
  };
  struct Cell {
    std::size_t low;
    float share;  ///< of the next one
  };
  /// Less the optical depth above a height, about: what a height counts as between those that are tabulated, since what is seen upwards goes with it.
  double thinness(double height_m) const;
  std::size_t index(std::size_t height, std::size_t zenith, std::size_t elevation, std::size_t azimuth) const;
  Entry made(const SkySource& source, double height_m, double zenith_rad, double elevation_rad, double azimuth_rad) const;

  Atmosphere air_;
  std::shared_ptr<const Haze> haze_;
  SkyAir optics_;
  SkySettings settings_;
  double scattering_m2_;  // of a molecule, at 550 nm
  std::vector<double> height_m_, thinness_, zenith_rad_;
  std::vector<Entry> values_;
};

}  // namespace arcus::media
