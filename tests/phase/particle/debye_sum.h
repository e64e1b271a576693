#pragma once
// The light of each of Debye's orders by adding all partial waves at every angle: slow, and
// independent of how large drops are computed.

#include <complex>
#include <span>
#include <vector>

namespace arcus::phase {

struct DebyeSum {
  std::vector<std::vector<std::complex<double>>> s1, s2;  ///< [order][angle]
};

/// Orders 0 ... highest of a sphere without absorption.
DebyeSum debye_sum(double size_parameter, double n, int highest,
                   std::span<const double> angles_rad);

}  // namespace arcus::phase
