#pragma once
// From a series in Legendre polynomials to the same function as a cosine series:
// sum a_n P_n(cos theta) = sum b_j cos(j theta).
//
// The matrix between the coefficients is known in closed form, triangular, and smooth away from its
// diagonal, so that blocks there are interpolated from a few nodes, in a hierarchy of block sizes:
// B. K. Alpert and V. Rokhlin, A fast algorithm for the evaluation of Legendre expansions, SIAM J.
// Sci. Stat. Comput. 12 (1991) 158-179. The cost is linear in the number of terms.

#include <array>
#include <cstddef>
#include <vector>

#include "phase/particle/instructions.h"
#include "phase/particle/lanes.h"

namespace arcus::phase {

/// Lambda(z) = Gamma(z + 1/2) / Gamma(z + 1), z > -1/2, to 1e-14.
double gamma_ratio(double z);

class LegendreToChebyshev {
 public:
  static constexpr int width = 4;   ///< series that are converted together, each of eight spheres
  static constexpr int leaf = 32;   ///< coefficients in the smallest block
  static constexpr int nodes = 12;  ///< interpolation nodes of a block: errors of 1e-10

  /// What is the same for all series.
  struct Tables {
    /// Lambda at whole numbers. toeplitz begins at -2 leaf and is zero for negative arguments.
    std::vector<double> toeplitz, hankel;
    /// Lagrange polynomials of a block's nodes at its coefficients: [node][coefficient], and
    /// transposed.
    std::vector<double> gather, scatter;
    /// The same at the nodes of its left and right half: [half][node][node of the half], and
    /// transposed.
    std::array<std::vector<double>, 2> gather_half, scatter_half;
    /// The matrix between the nodes of block A and those of A + 2 and A + 3, by parity of the
    /// degree and by level (block size leaf 2^level): [A][2][node of A][node of the other].
    std::array<std::vector<std::vector<double>>, 2> far;
  };

  /// Prepares for series up to this degree; memory of about 150 bytes a degree.
  explicit LegendreToChebyshev(int largest_degree);

  /// Room for the arguments of convert(), in quantities of eight spheres.
  static std::size_t series_size(int degree);
  static std::size_t scratch_size(int degree);

  /// legendre: [n][width][lanes], of series_size; zeros are written beyond degree.
  /// chebyshev: [j][width][lanes], of series_size: times 2/pi, or 1/pi for j = 0, these are the
  ///   b_j, right within 1e-10 of the largest. What lies beyond degree is meaningless.
  /// scratch: of scratch_size. The three must not overlap.
  void convert(int degree, double* legendre, double* chebyshev, double* scratch,
               Instructions instructions) const;

 private:
  Tables tables_;
};

}  // namespace arcus::phase
