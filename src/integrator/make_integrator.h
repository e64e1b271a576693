#pragma once
// From an integrator's name to the integrator.

#include <memory>

#include "src/integrator/integrator.h"
#include "src/scene/scene.h"
#include "src/scene/settings.h"

namespace arcus::render {

/// The scene must outlive it.
std::unique_ptr<const Integrator> make_integrator(const Scene& scene, const RenderSettings& settings);

}  // namespace arcus::render
