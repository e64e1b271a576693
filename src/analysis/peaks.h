#pragma once
// Where a curve has its maxima.

#include <span>
#include <vector>

namespace arcus::render {

struct Peak {
  double position;    ///< of the vertex of a parabola through the top of the peak [unit of x]
  double height;      ///< value of the parabola there
  double prominence;  ///< above the higher of the two valleys that part it from higher ground
};

/// Maxima of a curve given at ascending x, whose prominence is at least `least_share` of the
/// curve's whole range and five times the error of their top (errors may be empty: exact). The
/// parabola is fitted by least squares to the points around the top that stand above it less a
/// quarter of the prominence, at least one on each side. Maxima at the ends of the curve are none.
/// In the order of x.
std::vector<Peak> find_peaks(std::span<const double> x, std::span<const double> y,
                             std::span<const double> errors, double least_share = 0.02);

}  // namespace arcus::render
