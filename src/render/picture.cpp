#include "src/render/picture.h"

#include <filesystem>

#include "phase/base/content_hash.h"
#include "phase/base/version.h"
#include "phase/settings/toml_text.h"
#include "src/film/film_file.h"
#include "src/scene/fingerprint.h"
#include "src/scene/picture_metadata.h"

namespace arcus::render {

Xyz sun_colour(const Curve& sun_irradiance) {
  return xyz_of([&](double nm) { return sun_irradiance(nm); });
}

ToRgb to_rgb_of(const SceneSettings& settings, const Xyz& sun) { return to_rgb_from_white(white_of(settings.film.white, sun)); }

ToneSettings tone_of(const SceneSettings& settings, const Xyz& sun) {
  // Under no sun a matte surface under the sky of radiance 1 is the reference.
  ToneSettings tone{settings.film.exposure_ev, sun.y > 0 ? sun.y / pi : 1, {}};
  if (settings.film.adaptation == "night") tone.night = to_rgb_of(settings, sun);
  return tone;
}

void describe(Metadata& metadata, const SceneSettings& settings, double samples_per_pixel, double render_seconds) {
  MakingOf making;
  making.version = version;
  making.scene_text = text_of(settings);
  making.scene_hash = content_hash(making.scene_text);
  making.seed = static_cast<std::uint64_t>(settings.render.seed);
  making.samples_per_pixel = samples_per_pixel;
  making.render_seconds = render_seconds;
  write_making_of(metadata, making);
  write_camera(metadata, settings.camera);
  write_sun(metadata, {settings.sun.azimuth_deg, settings.sun.elevation_deg, settings.sun.angular_radius_deg});
}

Picture render_picture(const SceneSettings& settings, const Scene& scene, std::optional<PixelBox> crop,
                       RunOptions options, const std::string& checkpoint_file) {
  const CameraSettings& camera = settings.camera;
  const PixelBox box = crop.value_or(PixelBox{0, 0, camera.width_px, camera.height_px});
  const Xyz sun = sun_colour(scene.sun.irradiance_curve());
  Film film(camera.width_px, camera.height_px, box, settings.film, to_rgb_of(settings, sun));

  if (!checkpoint_file.empty()) {
    const std::string fingerprint = scene_fingerprint(settings);
    if (std::filesystem::exists(checkpoint_file)) read_film(checkpoint_file, fingerprint, film);
    options.checkpoint = [&checkpoint_file, fingerprint](const Film& now) { write_film(checkpoint_file, now, fingerprint); };
  }
  Picture picture;
  picture.run = render(scene, settings.render, options, film);
  if (!checkpoint_file.empty() && picture.run.is_complete) std::filesystem::remove(checkpoint_file);
  picture.image = film.to_image();
  picture.refused = film.refused();
  picture.tone = tone_of(settings, sun);
  describe(picture.image.metadata, settings, picture.run.progress.samples_done / static_cast<double>(box.pixels()), picture.run.progress.seconds);
  return picture;
}

}  // namespace arcus::render
