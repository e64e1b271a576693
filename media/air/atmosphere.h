#pragma once
// The air around a scene: layers of a round planet whose densities depend on height alone. What lies along a straight ray is found in closed forms,
// once for all wavelengths: columns of molecules, which scatter, of ozone, which absorbs, and of haze, which does both.
//
// z = 0 of the scene's world is sea level under its origin; the planet's centre lies straight below.

#include <optional>

#include "media/space/ray.h"

namespace arcus::media {

struct Flight;

struct AirSettings {
  double planet_radius_m = 6371000;
  double molecule_scale_height_m = 8434.5;  ///< pressure over density and gravity at 15 °C: the column has the weight of 1013.25 hPa
  double pressure_hpa = 1013.25;            ///< at z = 0
  double ozone_dobson_units = 300;          ///< between 10 and 40 km, most at 25 km
  double haze_depth_550 = 0;                ///< optical depth straight up at 550 nm
  double haze_scale_height_m = 1200;
  double top_m = 120000;                    ///< nothing lies above: 0.7 millionths of the molecules, and no light that counts
};

/// What lies along a stretch of a ray.
struct AirColumns {
  double molecules_per_m2 = 0;
  double ozone_per_m2 = 0;
  double haze_depth_550 = 0;  ///< optical depth at 550 nm

  AirColumns& operator+=(const AirColumns& other) {
    molecules_per_m2 += other.molecules_per_m2;
    ozone_per_m2 += other.ozone_per_m2;
    haze_depth_550 += other.haze_depth_550;
    return *this;
  }
};

class Atmosphere {
 public:
  explicit Atmosphere(const AirSettings& settings);

  const AirSettings& settings() const { return settings_; }
  /// Height of a point above sea level; precise to micrometres near the scene [m].
  double height_m(const Vec3& position_m) const;
  /// Densities at a height [1/m³; haze: extinction at 550 nm, 1/m]: an AirColumns for each metre.
  AirColumns density(double height_m) const;
  /// Sum along the stretch from ray.nearest_m to ray.farthest_m, which may be endless: to a millionth. What is below sea level counts with the
  /// density there.
  AirColumns columns(const Ray& ray) const;
  /// The ray's stretch as far as there is air; ends before it begins where there is none.
  Ray clipped(const Ray& ray) const;
  /// Where a ray meets the sea-level sphere, the first time [m]: at once where it goes down from below; infinity where it does not.
  double distance_to_sea_level_m(const Ray& ray) const;
  /// Optical depth of columns, at a wavelength: molecules and ozone; haze at its own ratio to 550 nm.
  static double optical_depth(const AirColumns& columns, double wavelength_nm, double haze_ratio = 1);

 private:
  double ozone_per_m3(double height_m) const;
  /// columns() in closed form, where the stretch lies below the ozone and its height changes by less than the densities' scale heights;
  std::optional<AirColumns> short_columns(const Ray& ray) const;
  /// by Chapman's function, where it lies above sea level; begin and end: as of the flight's start, below top_m;
  std::optional<AirColumns> long_columns(const Flight& flight, double begin, double end) const;
  /// and of any stretch.
  AirColumns columns_by_quadrature(const Flight& flight, double begin, double end) const;

  AirSettings settings_;
  double molecules_per_m3_, haze_per_m_, most_ozone_per_m3_;
  bool is_thin_;  ///< all scale heights are far below the planet's radius, as the closed forms ask
};

}  // namespace arcus::media
