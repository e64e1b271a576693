#include "phase/crystal/crystal_beam.h"

namespace arcus::phase {

CrystalBeam::CrystalBeam(const CrystalPopulation& crystals, const CrystalWave& wave, int events)
    : crystals_(crystals), wave_(wave), batch_(256, events), incoming_(256), lies_(256) {
  for (const CrystalShape& shape : crystals.shapes()) tracers_.emplace_back(shape);
}

}  // namespace arcus::phase
