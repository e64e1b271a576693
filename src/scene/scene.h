#pragma once
// What a path meets: built once from the settings, then never changed.

#include <memory>
#include <optional>

#include "media/air/atmosphere.h"
#include "media/air/haze.h"
#include "media/air/sky_table.h"
#include "media/medium/medium.h"
#include "media/space/box.h"
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
  std::optional<media::Atmosphere> air{};              ///< of a clear sky
  std::shared_ptr<const media::Haze> haze{};           ///< in it
  std::unique_ptr<const media::SkyTable> sky_table{};  ///< the light of air outside of the region; none: all air is traced
  media::Box air_region_m{};                           ///< around all that air is lit or shaded by
  std::optional<Material> ground{};                    ///< of the planet, matte; none: black
  std::unique_ptr<const Camera> camera;
};

}  // namespace arcus::render
