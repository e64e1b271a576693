#pragma once
// The light that comes from everywhere but the sun.

#include <string>

#include "media/air/atmosphere.h"
#include "media/air/haze.h"
#include "phase/base/curve.h"
#include "phase/base/spectrum.h"
#include "phase/base/vec3.h"
#include "phase/base/wavelengths.h"
#include "phase/settings/keys.h"

namespace arcus::render {

struct SkySettings {
  std::string type = "none";  ///< none | constant | clear
  double radiance = 0.1;      ///< of the constant sky, at 550 nm and with a flat spectrum everywhere [W m-2 sr-1 nm-1]
  std::string spectrum = "flat";  ///< flat | sun: in proportion to the sun's | rayleigh: that times λ⁻⁴
  // Of the clear sky:
  std::string method = "table";  ///< table | traced
  media::AirSettings air;        ///< its haze comes from here:
  media::HazeSettings haze;
  double ground_albedo = 0.15;   ///< of the planet
};
void list_keys(Keys& keys, SkySettings& sky);
/// The air of a clear sky, haze included.
media::AirSettings air_of(const SkySettings& sky);

class Sky {
 public:
  /// sun_irradiance: the sun's spectrum, for skies of its colour; a sun without light at 550 nm makes that black.
  Sky(const SkySettings& settings, const Curve& sun_irradiance);
  /// Radiance from a direction (unit, from the scene) [W m-2 sr-1 nm-1].
  Spectrum radiance(const Vec3& direction, const Wavelengths& wavelengths) const;
  bool is_dark() const { return radiance_ == 0; }

 private:
  float radiance_;
  Curve relative_;  // to 550 nm; empty: flat
  bool is_flat_, is_blue_;
};

}  // namespace arcus::render
