#include "src/scene/sky_picture.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "phase/base/error.h"
#include "phase/settings/number_text.h"
#include "phase/settings/toml_text.h"
#include "src/film/image_file.h"
#include "src/scene/colour_basis.h"

namespace arcus::render {
namespace {

/// In proportion to the light of a Planck radiator [any unit].
double planck(double nm, double temperature_k) {
  constexpr double second_radiation_constant_nm_k = 1.438776877e7;  // hc/k, CODATA 2018
  return std::pow(560 / nm, 5) / std::expm1(second_radiation_constant_nm_k / (nm * temperature_k));
}

/// So that the scene's picture shows the sky's own numbers: light that it shows as white has the sun's spectrum, or the radiator's, where that is its white.
ThreeSpectra basis_for(const SceneSettings& scene, const Curve& sun_irradiance) {
  const Xyz sun = xyz_of([&](double nm) { return sun_irradiance(nm); });
  const ToRgb to_rgb = to_rgb_from_white(white_of(scene.film.white, sun));
  if (scene.film.white == "auto" && sun.y > 0) return light_basis(to_rgb, [&](double nm) { return sun_irradiance(nm); });
  const double temperature_k = std::strtod(scene.film.white.c_str(), nullptr);  // 0 for words; white_of has looked at it
  return light_basis(to_rgb, [&](double nm) { return temperature_k > 0 ? planck(nm, temperature_k) : 1.0; });
}

}  // namespace

std::shared_ptr<const SkyImage> read_sky_picture(const SceneSettings& scene, const Curve& sun_irradiance) {
  const SkySettings& sky = scene.sky;
  if (sky.type != "image") return nullptr;
  const std::string where = scene.path + ": sky.file", path = path_from(scene.folder, sky.file), place = where + ": " + path;
  Raster rgb = read_colours(path, where);
  if (rgb.width != 2 * rgb.height)
    throw bad_input(place, std::to_string(rgb.width) + " x " + std::to_string(rgb.height) + " pixels", "twice as wide as high expected: the whole sphere, equirectangular");
  std::size_t below = 0, first = 0;
  double most = 0;
  for (std::size_t i = 0; i < rgb.values.size(); ++i) {
    float& value = rgb.values[i];
    if (value < 0) {
      if (below++ == 0) first = i;
      if (sky.clips_negative) value = 0;
    }
    value *= static_cast<float>(sky.scale);
    most = std::max(most, static_cast<double>(value));
  }
  if (below > 0 && !sky.clips_negative) {
    const auto width = static_cast<std::size_t>(rgb.width);
    throw bad_input(place, std::to_string(below) + " negative values, the first in column " + std::to_string(first / 3 % width) + ", row " + std::to_string(first / 3 / width),
                    "light of 0 or more expected", "They come from noise and from colours beyond Rec.709; to count them as 0: sky.clips_negative = true");
  }
  if (!(most > 0)) throw bad_input(place, "no light", "a picture that is not black all over expected", "For a black sky: sky.type = \"none\"");
  if (!(most < 1e30)) throw bad_input(place, "values up to " + number_text(most) + " with the scale", "less than 1e30 expected");
  return std::make_shared<const SkyImage>(std::move(rgb), basis_for(scene, sun_irradiance), sky.azimuth_deg);
}

}  // namespace arcus::render
