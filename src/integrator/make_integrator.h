#pragma once
// From an integrator's name to the integrator.

#include <atomic>
#include <memory>

#include "src/integrator/integrator.h"
#include "src/scene/scene.h"
#include "src/scene/settings.h"

namespace arcus::render {

/// The scene must outlive it. A photon map takes long to make: nothing where stop_request becomes non-zero before it is there.
std::unique_ptr<const Integrator> make_integrator(const Scene& scene, const RenderSettings& settings, const std::atomic<int>* stop_request = nullptr);

}  // namespace arcus::render
