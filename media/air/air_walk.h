#pragma once
// Air as light meets it: its optical depth at a path's wavelengths, and places where the first of them is scattered or absorbed. Both go by quadrature
// of densities alone, so there are no majorants and no null collisions.

#include <array>
#include <optional>

#include "media/air/atmosphere.h"
#include "media/air/haze.h"
#include "phase/base/spectrum.h"
#include "phase/base/wavelengths.h"

namespace arcus::media {

/// Cross sections at four wavelengths.
struct AirOptics {
  /// haze: may be none, as long as there is none in the columns.
  explicit AirOptics(const Wavelengths& wavelengths, const Haze* haze = nullptr);
  /// Of columns; of densities: extinction [1/m].
  Spectrum optical_depth(const AirColumns& columns) const;
  /// That of molecules and ozone alone.
  Spectrum gas_depth(const AirColumns& columns) const;
  /// What of it molecules scatter.
  Spectrum molecular_scattering(const AirColumns& columns) const;
  /// At the first wavelength alone.
  double first_depth(const AirColumns& columns) const {
    return columns.molecules_per_m2 * scattering_m2[0] + columns.ozone_per_m2 * ozone_m2[0] + columns.haze_depth_550 * static_cast<double>(haze_ratio[0]);
  }
  /// The same where the first wavelength has changed places with another.
  AirOptics with_first(int j) const;

  double scattering_m2[wavelength_count], ozone_m2[wavelength_count];
  int haze_modes = 0;
  std::array<Spectrum, Haze::most_modes> mode_ratio;  ///< extinction of each mode of haze over that of all at 550 nm
  Spectrum haze_ratio;                                ///< their sum
};

/// exp(−depth) at each wavelength.
Spectrum transmittance(const Spectrum& optical_depth);
/// The same over that at the first wavelength.
Spectrum transmittance_over_first(const Spectrum& optical_depth);

/// Where light is scattered or absorbed by air.
struct AirCollision {
  double distance_m = 0;  ///< from the ray's origin
  Spectrum optical_depth; ///< from the stretch's begin to there
  AirColumns density;     ///< there
};

/// The place along the ray's stretch where the optical depth at the first wavelength is `depth` > 0; nothing where the whole stretch has less. With
/// an exponentially distributed depth that is where a path of this wavelength collides.
std::optional<AirCollision> air_collision_at(const Atmosphere& air, const Ray& ray, const AirOptics& optics, double depth);

}  // namespace arcus::media
