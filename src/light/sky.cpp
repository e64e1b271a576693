#include "src/light/sky.h"

namespace arcus::render {

void list_keys(Keys& keys, SkySettings& sky) {
  keys.choice("type", sky.type, {"none", "constant"}, "what surrounds the scene");
  if (keys.only_if(sky.type == "constant", "type = constant"))
    keys.number("radiance", sky.radiance, at_least(0), "the same at every wavelength [W m-2 sr-1 nm-1]");
}

Sky::Sky(const SkySettings& settings)
    : radiance_(settings.type == "constant" ? static_cast<float>(settings.radiance) : 0.0f) {}

Spectrum Sky::radiance(const Vec3&, const Wavelengths&) const { return Spectrum::filled(radiance_); }

}  // namespace arcus::render
