#pragma once
// Cosine series summed at arbitrary angles: a fast Fourier transform onto a uniform grid, and
// interpolation from there.
//
// With coefficients divided by the Fourier transform of a narrow bell (Kaiser & Bessel's) before
// they are summed on a grid of at least 1.5 points per term, a weighted sum over the few grid
// points under the bell gives the function anywhere between: the nonuniform transform of A. Dutt
// and V. Rokhlin, SIAM J. Sci. Comput. 14 (1993) 1368-1393, with the bell of J. A. Fessler and
// B. P. Sutton, IEEE Trans. Signal Process. 51 (2003) 560-574. Its error is local: some 1e-7 of the
// function's largest value within a few grid points, so that a forward peak doesn't spill into the
// dark.

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "phase/particle/instructions.h"
#include "phase/particle/lanes.h"

namespace arcus::phase {

/// A grid of theta = (g + 1/2) pi / points, g = 0 ... points - 1, and what series up to its degree
/// need there.
class CosineGrid {
 public:
  static constexpr int taps = 10;  ///< grid points under the bell

  /// The smallest grid for series of this degree has 2^i or 3 2^i points, at least 32.
  static int points_for(int degree);

  /// angles_rad: where values will be asked for, 0 ... pi.
  CosineGrid(int points, std::span<const double> angles_rad);

  int points() const { return points_; }

  /// Two complex series of eight spheres onto the grid.
  /// series: [j][4][lanes] of degree <= points/1.5 - 1, real and imaginary part of the first and of
  ///   the second, as LegendreToChebyshev gives them: b_j times pi/2, or pi for j = 0.
  /// work: room for 2 x points quantities of eight spheres.
  /// grid: [points + taps][4][2][lanes], of grid_size; `half` (0 or 1) says which eight of sixteen
  ///   spheres are written.
  void sum(int degree, const double* series, double* work, float* grid, int half,
           Instructions instructions) const;

  /// Floats of a grid, values of sixteen spheres mirrored at both ends for interpolation.
  static std::size_t grid_size(int points) {
    return static_cast<std::size_t>(points + taps) * 4 * 2 * lanes;
  }

  /// Index of the first grid row under the bell around each angle, and the weights of the rows:
  /// [angle][taps].
  std::span<const int> first_rows() const { return first_row_; }
  std::span<const float> weights() const { return weights_; }

  struct Tables {
    int points;
    std::vector<double> scale;  // of the coefficients: 2/pi over the bell's transform
    std::vector<std::complex<double>> half_turn;  // exp(i pi k / (2 points)) / 2
    std::vector<std::complex<double>> turn;       // exp(2 pi i k / points)
    std::vector<int> place;  // where the transform leaves the value of grid point g
  };

 private:
  int points_;
  Tables tables_;
  std::vector<int> first_row_;
  std::vector<float> weights_;
};

}  // namespace arcus::phase
