#pragma once
// From a scene's settings to the finished picture with its metadata.

#include <optional>
#include <string>

#include "src/film/image.h"
#include "src/film/tone.h"
#include "src/render/render.h"
#include "src/scene/build_scene.h"
#include "src/scene/settings.h"

namespace arcus::render {

/// The sun's light as a colour, by which the film's `white = "auto"` and the brightness of the PNG go.
Xyz sun_colour(const Curve& sun_irradiance);

/// How a film of this scene turns its sums into RGB.
ToRgb to_rgb_of(const SceneSettings& settings, const Xyz& sun);

/// How the PNG shows it.
ToneSettings tone_of(const SceneSettings& settings, const Xyz& sun);

/// Writes into the picture's metadata what it shows and how it was made. samples_per_pixel: those that were made, on average.
void describe(Metadata& metadata, const SceneSettings& settings, double samples_per_pixel, double render_seconds);

struct Picture {
  Image image;          ///< channels as the settings ask for, and metadata
  ToneSettings tone;    ///< for the PNG: exposure 0 shows a white matte surface that faces the sun as a bright white
  RunResult run;
  RefusedSamples refused;
};

/// Renders `crop` of the scene, or all of it. A run that is stopped gives what is done. With the name of a checkpoint file it goes
/// on from that, where there is one, writes it every RunOptions::checkpoint_s and when stopped, and deletes it when all is done.
/// Throws Fault::mismatch where the file is of another scene, Fault::incomplete where it is damaged.
Picture render_picture(const SceneSettings& settings, const Scene& scene, std::optional<PixelBox> crop,
                       RunOptions options, const std::string& checkpoint_file = "");

}  // namespace arcus::render
