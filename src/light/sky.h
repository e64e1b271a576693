#pragma once
// The light that comes from everywhere but the sun.

#include <memory>
#include <optional>
#include <string>

#include "media/air/atmosphere.h"
#include "media/air/haze.h"
#include "phase/base/curve.h"
#include "phase/base/spectrum.h"
#include "phase/base/vec3.h"
#include "phase/base/wavelengths.h"
#include "phase/settings/keys.h"
#include "src/light/sky_image.h"

namespace arcus::render {

struct SkySettings {
  std::string type = "none";  ///< none | constant | clear | image
  double radiance = 0.1;      ///< of the constant sky, at 550 nm and with a flat spectrum everywhere [W m-2 sr-1 nm-1]
  std::string spectrum = "flat";  ///< flat | sun: in proportion to the sun's | rayleigh: that times λ⁻⁴
  // Of the clear sky:
  std::string method = "table";  ///< table | traced
  media::AirSettings air;        ///< its haze comes from here:
  media::HazeSettings haze;
  double ground_albedo = 0.15;   ///< of the planet
  // Of a picture:
  std::string file;           ///< the picture, relative to the scene file
  double scale = 1;           ///< multiplies its values
  double azimuth_deg = 0;     ///< compass azimuth that its middle shows
  bool clips_negative = false;  ///< its values below 0 count as 0
};
void list_keys(Keys& keys, SkySettings& sky);
/// The air of a clear sky, haze included.
media::AirSettings air_of(const SkySettings& sky);

class Sky {
 public:
  /// sun_irradiance: the sun's spectrum, for skies of its colour; a sun without light at 550 nm makes that black.
  /// image: of a sky that is a picture.
  Sky(const SkySettings& settings, const Curve& sun_irradiance, std::shared_ptr<const SkyImage> image = nullptr);
  /// Radiance from a direction (unit, from the scene) [W m-2 sr-1 nm-1].
  Spectrum radiance(const Vec3& direction, const Wavelengths& wavelengths) const;
  bool is_dark() const { return radiance_ == 0 && !image_; }
  bool is_image() const { return image_ != nullptr; }

  /// Whether it has bright places that are asked for their light as the sun is. All else is found by paths that leave the scene, which serves as well where
  /// light is much the same all around.
  bool is_asked() const { return image_ && image_->is_asked(); }
  /// A direction to ask, or nothing: light/sky_image.h. Where it is asked; u, v in [0, 1).
  std::optional<Vec3> draw(double u, double v) const { return image_->draw(u, v); }
  /// Density of draw() [1/sr], less than 1 in all; 0 where it is not asked.
  double density_per_sr(const Vec3& direction) const { return image_ ? image_->density_per_sr(direction) : 0; }

 private:
  float radiance_;
  Curve relative_;  // to 550 nm; empty: flat
  bool is_flat_, is_blue_;
  std::shared_ptr<const SkyImage> image_;
};

}  // namespace arcus::render
