#pragma once
// Draws the radii of single drops from a population.

#include <vector>

#include "phase/population/sizes.h"

namespace arcus::phase {

class SizeDraw {
 public:
  /// All but a millionth of the drops' cross-section is within reach of a draw. Drops so small that they bring less are never drawn, so the
  /// number of those that are refers to the rest: see drawn_mean_square_um2.
  explicit SizeDraw(const Sizes& sizes);

  /// Radius [µm] for u in [0, 1), distributed as the number of drops: its cumulative is a polygon of 4096 equal steps of ln r.
  double radius_um(double u) const;
  /// Mean r² of what is drawn [µm²].
  double drawn_mean_square_um2() const { return mean_square_um2_; }

 private:
  std::vector<double> radius_um_, cumulative_;  // one entry: one size
  double mean_square_um2_;
};

}  // namespace arcus::phase
