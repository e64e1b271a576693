#pragma once
// Light on falling crystals by the hundred, everything in columns: how maps of the sky get millions of rays a second, each with an
// orientation of its own. crystal_beam.h is the same one by one.

#include <vector>

#include "phase/crystal/crystal_beam.h"
#include "phase/crystal/orientation_columns.h"

namespace arcus::phase {

/// Memory and tracers for one thread. The population must outlive it.
class CrystalShower {
 public:
  /// events: faces met from inside after which light still in the crystal is given up.
  CrystalShower(const CrystalPopulation& crystals, const CrystalWave& wave, int events);

  /// column_rays rays of these directions (world, unit), each through a crystal drawn without regard to its shadow. size_factor: how
  /// many times as large as the population's each crystal is; it counts in absorption only.
  void trace(const VectorColumns& incoming, const Column& size_factor, RandomColumns& random);

  const CrystalBatch& batch() const { return batch_; }
  const OrientationColumns& orientations() const { return lies_; }
  /// The light that was traced in the crystals' axes.
  const VectorColumns& incoming() const { return incoming_; }
  int events() const { return batch_.events(); }

 private:
  const CrystalPopulation& crystals_;
  float absorption_per_um_;
  std::vector<CrystalPackets> tracers_;  ///< of the population's shapes
  std::size_t shape_ = 0;                ///< the next to be used
  CrystalBatch batch_;
  OrientationColumns lies_;
  VectorColumns incoming_;
};

}  // namespace arcus::phase
