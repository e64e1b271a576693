#include "phase/particle/debye_efficiencies.h"

#include <algorithm>
#include <cmath>

#include "phase/base/quadrature.h"
#include "phase/base/units.h"
#include "phase/particle/drop_rays.h"

namespace arcus::phase {
namespace {

using Complex = std::complex<double>;

/// Scattering efficiency and that times the mean cosine.
struct Sums {
  double power = 0, forwardness = 0;
};

// Orders are incoherent: sums of (l + 1/2) |c_l|^2 and (l + 1) Re c_l c_(l+1)* over x^2 (Bohren &
// Huffman 1983, section 4.5, for large l), c_l twice the Mie coefficient of one order; the orders
// from 1 on are a geometric series.
void add_edge(const PartialWaves& waves, double x, Sums& sums) {
  for (const auto* terms : {&waves.perpendicular, &waves.parallel})
    for (std::size_t i = 0; i + 1 < terms->size(); ++i) {
      const SurfaceTerms &t = (*terms)[i], &next = (*terms)[i + 1];
      const double wave = waves.first + static_cast<double>(i) + 0.5;
      const double inside_power = std::norm(t.passed_through) / (1 - std::norm(t.reflected_inside));
      const Complex outside = (1.0 - t.reflected_outside) * std::conj(1.0 - next.reflected_outside);
      const Complex inside = t.passed_through * std::conj(next.passed_through) /
                             (1.0 - t.reflected_inside * std::conj(next.reflected_inside));
      sums.power += wave / (x * x) * (std::norm(1.0 - t.reflected_outside) + inside_power);
      sums.forwardness += (wave + 0.5) / (x * x) * (outside + inside).real();
    }
}

/// The same below the edge, where c_l is Fresnel's coefficient turned by the ray's deviation from
/// one l to the next.
void add_rays(double n, double absorption, double x, double last_incidence, Sums& sums) {
  static const Quadrature rule = gauss_legendre(64);
  const RaysOfOrder reflected(0, n), passed(1, n);
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    const double incidence = 0.5 * last_incidence * (1 + rule.nodes[i]);
    const double weight =
        0.25 * last_incidence * rule.weights[i] * std::sin(2 * incidence);  // b db
    const auto r = reflected.amplitudes(incidence);
    const double refraction = reflected.refraction_rad(incidence);
    const double left = std::exp(-4 * absorption * x * std::cos(refraction));
    const Complex once = std::polar(left, passed.turned_rad(incidence)),
                  more = std::polar(left, pi - 2 * refraction);
    for (const double amplitude : {r.perpendicular, r.parallel}) {
      const double back = amplitude * amplitude, through = (1 - back) * (1 - back);
      sums.power += weight * (1 + back + through * left / (1 - back * left));
      sums.forwardness += weight * (1 + back * std::cos(reflected.turned_rad(incidence)) +
                                    (through * once / (1.0 - back * more)).real());
    }
  }
}

}  // namespace

SphereEfficiencies debye_efficiencies(double x, Complex m, double forward_amplitude,
                                      const PartialWaves& waves) {
  Sums sums;
  add_edge(waves, x, sums);
  add_rays(m.real(), m.imag(), x, std::asin(std::min(1.0, waves.first / x)), sums);
  SphereEfficiencies q;
  q.extinction = 4 / (x * x) * forward_amplitude;
  // Without absorption the two sums agree within 1e-5; never more out than in.
  q.scattering = m.imag() == 0 ? q.extinction : std::min(sums.power, q.extinction);
  q.asymmetry = sums.forwardness / sums.power;
  return q;
}

}  // namespace arcus::phase
