#pragma once
// What a path meets: built once from the settings, then never changed.

#include <memory>
#include <optional>

#include "media/air/atmosphere.h"
#include "media/medium/medium.h"
#include "src/camera/camera.h"
#include "src/light/sky.h"
#include "src/light/sun.h"
#include "src/shape/surfaces.h"

namespace arcus::render {

struct Scene {
  std::unique_ptr<const media::Medium> medium;  ///< all media as one; may hold none
  Sun sun;
  Sky sky;
  Surfaces surfaces;
  std::optional<media::Atmosphere> air{};  ///< of a clear sky
  std::unique_ptr<const Camera> camera;
};

}  // namespace arcus::render
