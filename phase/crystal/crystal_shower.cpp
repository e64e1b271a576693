#include "phase/crystal/crystal_shower.h"

#include <algorithm>

namespace arcus::phase {

CrystalShower::CrystalShower(const CrystalPopulation& crystals, const CrystalWave& wave, int events)
    : crystals_(crystals), absorption_per_um_(static_cast<float>(wave.absorption_per_um)), batch_(column_rays, events) {
  for (const CrystalShape& shape : crystals.shapes()) tracers_.emplace_back(shape);
  std::ranges::fill(batch_.input(CrystalBatch::input_index), static_cast<float>(wave.n));
}

void CrystalShower::trace(const VectorColumns& incoming, const Column& size_factor, RandomColumns& random) {
  draw_orientations(crystals_.orientations(), random, lies_);
  lies_.to_crystal(incoming, incoming_);
  std::copy_n(incoming_.x.values, column_rays, batch_.input(CrystalBatch::input_x).data());
  std::copy_n(incoming_.y.values, column_rays, batch_.input(CrystalBatch::input_y).data());
  std::copy_n(incoming_.z.values, column_rays, batch_.input(CrystalBatch::input_z).data());
  float* absorption = batch_.input(CrystalBatch::input_absorption).data();
  for (int i = 0; i < column_rays; ++i) absorption[i] = absorption_per_um_ * size_factor[i];
  for (int which = 0; which < 3; ++which)
    random.uniform(batch_.input(CrystalBatch::input_numbers + which).data(), column_rays);
  tracers_[shape_].split(batch_);
  shape_ = (shape_ + 1) % tracers_.size();
}

}  // namespace arcus::phase
