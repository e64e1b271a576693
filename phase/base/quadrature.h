#pragma once
// Gauss-Legendre quadrature.

#include <functional>
#include <vector>

namespace arcus {

struct Quadrature {
  std::vector<double> nodes;    ///< in (-1, 1), ascending
  std::vector<double> weights;  ///< positive, sum 2
};

/// Nodes and weights of the n-point rule, exact for polynomials up to degree 2n − 1; n ≥ 1. Newton's method from
/// Tricomi's starting values; accurate to a few units in the last place up to n = 10⁴.
Quadrature gauss_legendre(int n);

/// Integral of f over [a, b] by repeated halving with 15-point rules until the halves agree with the whole within
/// `tolerance` (absolute). f must be finite; depth is limited to 40.
double integrate(const std::function<double(double)>& f, double a, double b, double tolerance);

}  // namespace arcus
