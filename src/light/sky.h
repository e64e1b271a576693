#pragma once
// The light that comes from everywhere but the sun.

#include <string>

#include "phase/base/spectrum.h"
#include "phase/base/vec3.h"
#include "phase/base/wavelengths.h"
#include "phase/settings/keys.h"

namespace arcus::render {

struct SkySettings {
  std::string type = "none";  ///< none | constant
  double radiance = 0.1;      ///< of the constant sky, at every wavelength [W m-2 sr-1 nm-1]
};
void list_keys(Keys& keys, SkySettings& sky);

class Sky {
 public:
  explicit Sky(const SkySettings& settings);
  /// Radiance from a direction (unit, from the scene) [W m-2 sr-1 nm-1].
  Spectrum radiance(const Vec3& direction, const Wavelengths& wavelengths) const;

 private:
  float radiance_;
};

}  // namespace arcus::render
