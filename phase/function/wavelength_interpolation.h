#pragma once
// Phase functions between the wavelength nodes of a scattering table, some 10 nm apart.

#include <span>
#include <vector>

#include "phase/function/feature_tracks.h"
#include "phase/population/scattering_table.h"

namespace arcus::phase {

/// One size of a table as a function of wavelength: a cubic in wavelength through four nodes, of the logarithm of p11
/// (phase functions span many decades and change by factors), along the tracks that bows and rings follow.
class WavelengthInterpolation {
 public:
  /// clip: the forward lobe is clipped first where the table declares a forward fraction. The table is not kept.
  WavelengthInterpolation(const ScatteringTable& table, int size, bool clip);

  /// p11 at the table's angle nodes [1/sr] at a wavelength [nm], taken at the nearest end beyond the table's range. At
  /// a node's wavelength it is the node's own row; elsewhere its integral is 1 only nearly (or, clipped, not at all).
  void evaluate(double wavelength_nm, std::span<float> p11) const;

  const FeatureTracks& tracks() const { return tracks_; }

 private:
  const float* values(int node) const { return values_.data() + node * angle_deg_.size(); }

  std::vector<double> angle_deg_, wavelength_nm_;
  std::vector<float> values_;  // [wavelength][angle]: p11, clipped where asked for
  FeatureTracks tracks_;
  std::vector<float> logs_, slopes_;  // [wavelength][angle]: ln p11, and its derivative by the angle in degrees
  std::vector<bool> has_zeros_;       // [wavelength]: values that have no logarithm
};

}  // namespace arcus::phase
