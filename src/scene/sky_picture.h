#pragma once
// The sky that a scene's picture shows: read, checked, and turned into spectra under the white that the scene's own picture is shown with.

#include <memory>

#include "phase/base/curve.h"
#include "src/light/sky_image.h"
#include "src/scene/settings.h"

namespace arcus::render {

/// Nothing where the sky is no picture. `sun_irradiance`: what film.white = "auto" stands for. Throws bad_input: no such picture, another shape
/// than 2:1, values below 0 or not finite, no light in it.
std::shared_ptr<const SkyImage> read_sky_picture(const SceneSettings& scene, const Curve& sun_irradiance);

}  // namespace arcus::render
