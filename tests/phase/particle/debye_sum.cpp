#include "tests/phase/particle/debye_sum.h"

#include <cmath>

#include "phase/particle/partial_waves.h"

namespace arcus::phase {

DebyeSum debye_sum(double x, double n, int highest, std::span<const double> angles_rad) {
  const int last = static_cast<int>(x + 6 * std::cbrt(x) + 2);
  const PartialWaves waves = partial_waves(x, n, 1, last);
  const auto orders = static_cast<std::size_t>(highest) + 1;
  DebyeSum sum;
  sum.s1.assign(orders, std::vector<std::complex<double>>(angles_rad.size()));
  sum.s2 = sum.s1;
  // Coefficients a_l and b_l of every order.
  std::vector<std::vector<std::complex<double>>> a(orders), b(orders);
  for (std::size_t i = 0; i < waves.perpendicular.size(); ++i) {
    const SurfaceTerms &s = waves.perpendicular[i], &p = waves.parallel[i];
    b[0].push_back(0.5 * (1.0 - s.reflected_outside));
    a[0].push_back(0.5 * (1.0 - p.reflected_outside));
    std::complex<double> through_s = s.passed_through, through_p = p.passed_through;
    for (std::size_t order = 1; order < orders; ++order) {
      b[order].push_back(-0.5 * through_s);
      a[order].push_back(-0.5 * through_p);
      through_s *= s.reflected_inside;
      through_p *= p.reflected_inside;
    }
  }
  for (std::size_t angle = 0; angle < angles_rad.size(); ++angle) {
    const double mu = std::cos(angles_rad[angle]);
    double before = 0, pi_l = 1;  // Bohren & Huffman 1983, equation 4.47
    for (int l = 1; l <= last; ++l) {
      const double tau = l * mu * pi_l - (l + 1) * before, weight = (2.0 * l + 1) / (l * (l + 1.0));
      const auto i = static_cast<std::size_t>(l - 1);
      for (std::size_t order = 0; order < orders; ++order) {
        sum.s1[order][angle] += weight * (a[order][i] * pi_l + b[order][i] * tau);
        sum.s2[order][angle] += weight * (a[order][i] * tau + b[order][i] * pi_l);
      }
      const double next = ((2 * l + 1) * mu * pi_l - (l + 1) * before) / l;
      before = pi_l;
      pi_l = next;
    }
  }
  return sum;
}

}  // namespace arcus::phase
