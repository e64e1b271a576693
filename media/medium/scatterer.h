#pragma once
// What happens to light that is scattered.

#include "phase/base/spectrum.h"
#include "phase/function/phase_function.h"

namespace arcus::media {

struct Scatterer {
  Spectrum albedo;             ///< share of the extinguished light that is scattered
  phase::PhaseFunction phase;  ///< where it goes
};

}  // namespace arcus::media
