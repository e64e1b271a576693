#include "src/light/sky.h"

#include "phase/optics/air.h"

namespace arcus::render {

void list_keys(Keys& keys, SkySettings& sky) {
  keys.choice("type", sky.type, {"none", "constant", "clear", "image"}, "what surrounds the scene; image: a picture of the whole sphere; clear: the air of a round planet, which scatters the sun's light, dims all that is seen through it, and ends on matte ground at z = 0 where no surface is");
  if (keys.only_if(sky.type == "constant", "type = constant")) {
    keys.number("radiance", sky.radiance, at_least(0), "the same in all directions, at 550 nm [W m-2 sr-1 nm-1]");
    keys.choice("spectrum", sky.spectrum, {"flat", "sun", "rayleigh"},
                "flat: the same at every wavelength; sun: in proportion to the sun's, as light from grey clouds; rayleigh: the "
                "sun's times the inverse fourth power of the wavelength, a plain blue");
  }
  if (keys.only_if(sky.type == "clear", "type = clear")) {
    keys.choice("method", sky.method, {"table", "traced"},
                "table: air is traced where media and surfaces are, or their shadows may fall, and its light from farther away is tabulated before (within 3 %); traced, and with table where scene or camera reach higher than 20 km: all of it, without bias, slowly");
    keys.choice("haze", sky.haze.type, {"none", "continental", "maritime", "desert"}, "particles in the air besides: mixtures of OPAC at a relative humidity of 80 %");
    if (keys.only_if(sky.haze.type != "none", "haze other than none")) {
      keys.number("haze_optical_depth", sky.haze.optical_depth, between(0, 5), "of the haze at 550 nm, straight up from z = 0: 0.05 very clear, 0.1 clear, 0.3 hazy");
      keys.number("haze_visibility_m", sky.haze.visibility_m, between(0, 300000), "how far one sees at z = 0, in place of the optical depth; 0: the optical depth holds [m]");
      keys.number("haze_scale_height_m", sky.haze.scale_height_m, between(100, 20000), "haze thins to 1/e over this height [m]");
    }
    keys.number("ground_albedo", sky.ground_albedo, between(0, 1), "share of the light that the planet's ground returns");
    keys.number("pressure_hpa", sky.air.pressure_hpa, between(0, 2000), "at z = 0: how much air there is");
    keys.number("ozone_dobson_units", sky.air.ozone_dobson_units, between(0, 1000), "ozone between 10 and 40 km: 250 in the tropics, 300 to 450 elsewhere; it keeps the dusk blue");
    keys.number("planet_radius_m", sky.air.planet_radius_m, between(1e5, 1e12), "the planet's centre is so far below the origin; very large: flat layers");
  }
  if (keys.only_if(sky.type == "image", "type = image")) {
    keys.text("file", sky.file, "equirectangular picture, twice as wide as high, relative to the scene file: EXR or another kind; linear Rec.709 R, G, B as Arcus writes them [W m-2 sr-1 nm-1]; whole numbers are sRGB, 1 at the most");
    if (sky.file.empty() && !keys.documents()) keys.refuse("file", "nothing", "the name of a picture expected");
    keys.number("scale", sky.scale, above(0), "multiplies the values");
    keys.number("azimuth_deg", sky.azimuth_deg, any(), "compass azimuth that the middle of the picture shows; to the right of it, clockwise: camera.azimuth_deg of a picture by the camera equirectangular");
    keys.flag("clips_negative", sky.clips_negative, "values below 0, of colours beyond Rec.709 or of noise, count as 0; otherwise they are refused");
  }
}

media::AirSettings air_of(const SkySettings& sky) {
  media::AirSettings air = sky.air;
  if (sky.haze.type == "none") return air;
  air.haze_scale_height_m = sky.haze.scale_height_m;
  air.haze_depth_550 = media::haze_depth_550(sky.haze, phase::air_molecules_per_m3_at_sea_level * air.pressure_hpa / 1013.25);
  return air;
}

Sky::Sky(const SkySettings& settings, const Curve& sun_irradiance, std::shared_ptr<const SkyImage> image)
    : radiance_(settings.type == "constant" ? static_cast<float>(settings.radiance) : 0.0f),
      is_flat_(settings.spectrum == "flat"),
      is_blue_(settings.spectrum == "rayleigh"),
      image_(std::move(image)) {
  if (is_flat_) return;
  std::vector<double> values = sun_irradiance.y();
  const double at_550 = sun_irradiance(550);
  for (double& value : values) value = at_550 > 0 ? value / at_550 : 0;
  relative_ = Curve(sun_irradiance.x(), std::move(values), "sky.spectrum");
}

Spectrum Sky::radiance(const Vec3& direction, const Wavelengths& wavelengths) const {
  if (image_) return image_->radiance(direction, wavelengths);
  if (is_flat_ || radiance_ == 0) return Spectrum::filled(radiance_);
  Spectrum result;
  for (int i = 0; i < wavelength_count; ++i) {
    const double ratio = 550.0 / wavelengths[i];
    result[i] = radiance_ * static_cast<float>(relative_(wavelengths[i]) * (is_blue_ ? ratio * ratio * ratio * ratio : 1));
  }
  return result;
}

}  // namespace arcus::render
