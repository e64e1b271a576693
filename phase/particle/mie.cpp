#include "phase/particle/mie.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "phase/base/error.h"
#include "phase/base/units.h"

namespace arcus::phase {
namespace {

// The coefficients are computed with 64 bits of mantissa, as small and large spheres lose digits
// that 53 bits do not have to spare, and with 113 where m is near 1: there a_n and b_n are
// differences of nearly equal numbers, and S2 at 90 degrees is a sum that nearly vanishes, so that
// |m - 1| = 1e-6 costs 14 digits.
using Long = long double;
using Quad = __float128;

// Below this |m - 1| the long type is used, which is ten times slower. Above it, S2 at 90 degrees
// and x = 1e3 keeps nine digits.
constexpr double nearly_matched = 1e-3;

template <typename Number>
void sine_cosine(double angle, Number& sine, Number& cosine) {
  sine = std::sin(Number(angle));
  cosine = std::cos(Number(angle));
}

// The standard library has no sine for this type: Taylor's series about the nearest multiple of
// pi/2.
void sine_cosine(double angle, Quad& sine, Quad& cosine) {
  const Quad half_pi =
      Quad(0x1.921fb54442d18p+0) + Quad(0x1.1a62633145c07p-54) + Quad(-0x1.f1976b7ed8fbcp-110);
  const double quadrant = std::nearbyint(angle / (pi / 2));
  const Quad r = Quad(angle) - Quad(quadrant) * half_pi;
  Quad even = 0, odd = 0, term = 1;
  for (int n = 0; n < 32; n += 2) {  // |r| < 0.8: r^32 / 32! is below 1e-38
    const int sign = n % 4 ? -1 : 1;
    even += sign * term;
    odd += sign * term * r / (n + 1);
    term *= r * r / ((n + 1) * (n + 2));
  }
  const int quarter = static_cast<int>(std::fmod(quadrant, 4.0));
  sine = quarter % 2 ? even : odd;
  cosine = quarter % 2 ? odd : even;
  if (quarter >= 2) sine = -sine;
  if (quarter == 1 || quarter == 2) cosine = -cosine;
}

template <typename Real>
using Complex = std::complex<Real>;

template <typename Real>
Real squared(Complex<Real> z) {
  return z.real() * z.real() + z.imag() * z.imag();
}

// 1 / z without the overflow checks of the library's division; |z| stays far inside the range here.
template <typename Real>
Complex<Real> reciprocal(Complex<Real> z) {
  const Real scale = 1 / squared(z);
  return {z.real() * scale, -z.imag() * scale};
}

// Terms to sum. Beyond n = x the coefficients fall off as exp(-(4/3) y^(3/2)), y = 2^(1/3) (n - x)
// / x^(1/3) (Airy's transition region): 7 x^(1/3) leaves 1e-15.
int series_length(double x) { return static_cast<int>(x + 7 * std::cbrt(x) + 10); }

// rho_n(z) = psi_{n+1}(z) / psi_n(z), n = 0 ... terms, by downward recurrence, stable for every z.
// It starts so far beyond |z| that the arbitrary first value is forgotten to 1e-30 before n < |z|,
// where errors no longer decay (the same estimate as in series_length).
template <typename Real>
std::vector<Complex<Real>> successive_ratio(Complex<Real> z, double size, int terms) {
  const int beyond = static_cast<int>(size + 12 * std::cbrt(size)) + 35;
  const Complex<Real> inverse_z = reciprocal(z);
  std::vector<Complex<Real>> ratio(terms + 1);
  Complex<Real> current = 0;
  for (int n = std::max(terms + 25, beyond); n > 0; --n) {
    current = reciprocal(Real(2 * n + 1) * inverse_z - current);
    if (n <= terms + 1) ratio[n - 1] = current;
  }
  return ratio;
}

// Riccati-Bessel functions psi_n(x) = x j_n(x), n = 0 ... terms. Upward recurrence is stable as
// long as n < x; from there the ratio psi_n / psi_{n-1}, computed downward, takes over.
template <typename Real>
std::vector<Real> riccati_bessel_psi(double x, int terms) {
  std::vector<Real> psi(terms + 1);
  Real before;
  sine_cosine(x, psi[0], before);
  const Real inverse_x = 1 / Real(x);
  int n = 1;
  for (; n < x && n <= terms; ++n) {
    psi[n] = (2 * n - 1) * inverse_x * psi[n - 1] - before;
    before = psi[n - 1];
  }
  std::vector<Real> ratio(terms + 1);
  Real current = 0;
  for (int k = terms + 60; k >= n; --k) {
    current = 1 / ((2 * k + 1) * inverse_x - current);
    if (k <= terms) ratio[k] = current;
  }
  for (; n <= terms; ++n) psi[n] = psi[n - 1] * ratio[n];
  return psi;
}

// One partial wave: a_n or b_n, and its share of the absorption.
template <typename Real>
struct Wave {
  Complex<Real> amplitude;
  Real absorption;  // Re a - |a|^2, without the cancellation
};

// The wave N / (N - iC). Bohren & Huffman eq. 4.88 with psi_n'(z) = (n + 1) psi_n(z) / z -
// psi_{n+1}(z) in it, which leaves no terms that cancel in a small sphere, gives
//   N = h psi_n + psi_{n+1},  C = h chi_n + chi_{n+1},
//   h = (n + 1)/x (1/m^2 - 1) - rho_n(mx)/m  for a_n,  h = -m rho_n(mx)  for b_n.
// As psi_n chi_{n+1} - psi_{n+1} chi_n = 1, Re a = (|N|^2 - Im h) / |N - iC|^2: both terms are
// positive.
template <typename Real>
Wave<Real> partial_wave(Complex<Real> h, Real psi, Real psi_next, Real chi, Real chi_next) {
  const Complex<Real> n = h * psi + psi_next;
  const Complex<Real> c = h * chi + chi_next;
  const Complex<Real> denominator(n.real() + c.imag(), n.imag() - c.real());
  const Real scale = 1 / squared(denominator);
  const Real imaginary = n.real() * c.real() + n.imag() * c.imag();
  return {{(squared(n) - h.imag()) * scale, imaginary * scale}, -h.imag() * scale};
}

template <typename Real>
struct Series {
  std::vector<Complex<Real>> a, b;  // index 0 is not used
  SphereEfficiencies efficiencies;
};

template <typename Real>
Series<Real> mie_series(double size_parameter, std::complex<double> relative_index) {
  const int terms = series_length(size_parameter);
  Series<Real> series;
  series.a.resize(terms + 1);
  series.b.resize(terms + 1);
  if (relative_index == 1.0) return series;

  const Real x = size_parameter;
  const Complex<Real> m(relative_index.real(), relative_index.imag());
  const auto ratio =
      successive_ratio<Real>(m * x, std::abs(relative_index) * size_parameter, terms);
  const auto psi = riccati_bessel_psi<Real>(size_parameter, terms + 1);
  const Complex<Real> inverse_m = reciprocal(m);
  const Complex<Real> contrast =
      (Real(1) - m) * (Real(1) + m) * inverse_m * inverse_m;  // 1/m^2 - 1
  Real sine, chi;
  sine_cosine(size_parameter, sine, chi);
  Real chi_next = chi / x + sine;
  Complex<Real> a_before = 0, b_before = 0, back = 0;
  Real scattering = 0, absorption = 0, asymmetry = 0;
  for (int n = 1; n <= terms; ++n) {
    const Real chi_after = (2 * n + 1) / x * chi_next - chi;
    chi = chi_next;
    chi_next = chi_after;
    const Complex<Real> h_a = (n + 1) / x * contrast - ratio[n] * inverse_m;
    const Complex<Real> h_b = -m * ratio[n];
    const Wave<Real> a = partial_wave(h_a, psi[n], psi[n + 1], chi, chi_next);
    const Wave<Real> b = partial_wave(h_b, psi[n], psi[n + 1], chi, chi_next);
    const Real weight = 2 * n + 1;
    scattering += weight * (squared(a.amplitude) + squared(b.amplitude));
    absorption += weight * (a.absorption + b.absorption);
    const auto product = [](Complex<Real> u, Complex<Real> v) {
      return u.real() * v.real() + u.imag() * v.imag();
    };
    asymmetry += weight / (Real(n) * (n + 1)) * product(a.amplitude, b.amplitude);
    asymmetry += (Real(n) - 1) * (n + 1) / n *
                 (product(a_before, a.amplitude) + product(b_before, b.amplitude));
    back += (n % 2 ? weight : -weight) * (a.amplitude - b.amplitude);
    a_before = series.a[n] = a.amplitude;
    b_before = series.b[n] = b.amplitude;
  }
  const Real x2 = x * x;
  series.efficiencies.scattering = static_cast<double>(2 / x2 * scattering);
  series.efficiencies.extinction = static_cast<double>(2 / x2 * (scattering + absorption));
  series.efficiencies.backscatter = static_cast<double>(squared(back) / x2);
  series.efficiencies.asymmetry =
      scattering > 0 ? static_cast<double>(2 * asymmetry / scattering) : 0.0;
  return series;
}

// What the sums over angles need of a term: (2n + 1)/(n (n + 1)) times a_n and b_n.
template <typename Number>
struct Term {
  Number inverse_n, a_re, a_im, b_re, b_im;
};

template <typename Number, typename Real>
std::vector<Term<Number>> weighted_terms(const Series<Real>& series) {
  std::vector<Term<Number>> terms;
  for (std::size_t n = 1; n < series.a.size(); ++n) {
    const Real weight = Real(2 * n + 1) / (Real(n) * (n + 1));
    const Complex<Real> a = weight * series.a[n], b = weight * series.b[n];
    terms.push_back({Number(1 / Real(n)), Number(a.real()), Number(a.imag()), Number(b.real()),
                     Number(b.imag())});
  }
  return terms;
}

// S1 and S2 at up to `width` angles at once.
// Recurrence for pi_n and tau_n from Wiscombe (1980), eq. 27-29, rewritten for the difference d =
// pi_n - pi_{n-1} and e = 1 - cos(theta), so that nothing cancels near the forward direction.
// Angles beyond 90 degrees use pi_n(-mu) = (-1)^(n+1) pi_n(mu), tau_n(-mu) = (-1)^n tau_n(mu) and
// are as good near the backward direction.
template <typename Number, int width>
void sum_series(std::span<const Term<Number>> terms, std::span<const double> angles_rad,
                std::complex<double>* s1, std::complex<double>* s2) {
  Number versine[width], mirror[width], sign[width];
  Number value[width], difference[width], before[width];
  Number sum[4][width] = {};  // S1, S2: real, imaginary parts
  for (int i = 0; i < width; ++i) {
    const double angle = angles_rad[std::min<std::size_t>(i, angles_rad.size() - 1)];
    const bool backward = angle > pi / 2;
    Number sine, cosine;
    sine_cosine(angle / 2, sine, cosine);
    const Number half_sine = backward ? cosine : sine;
    versine[i] = 2 * half_sine * half_sine;
    mirror[i] = backward ? -1 : 1;
    sign[i] = 1;
    value[i] = 1;
    difference[i] = 1;
    before[i] = 0;
  }
  Number n = 0;
  for (const auto& [inverse_n, a_re, a_im, b_re, b_im] : terms) {
    n += 1;
    for (int i = 0; i < width; ++i) {
      const Number u = versine[i] * value[i];
      const Number t = difference[i] - u;
      const Number pi_n = sign[i] * value[i];
      const Number tau_n = sign[i] * mirror[i] * (n * t - before[i]);
      sum[0][i] += a_re * pi_n + b_re * tau_n;
      sum[1][i] += a_im * pi_n + b_im * tau_n;
      sum[2][i] += a_re * tau_n + b_re * pi_n;
      sum[3][i] += a_im * tau_n + b_im * pi_n;
      difference[i] = t + t * inverse_n - u;
      before[i] = value[i];
      value[i] += difference[i];
      sign[i] *= mirror[i];
    }
  }
  for (std::size_t i = 0; i < angles_rad.size(); ++i) {
    s1[i] = {static_cast<double>(sum[0][i]), static_cast<double>(sum[1][i])};
    s2[i] = {static_cast<double>(sum[2][i]), static_cast<double>(sum[3][i])};
  }
}

// One amplitude nearly vanishes: S2 at 90 degrees of small spheres and of |m - 1| << 1, where the
// series cancels.
bool nearly_vanishes(std::complex<double> s1, std::complex<double> s2) {
  return std::min(std::abs(s1), std::abs(s2)) < 1e-4 * std::max(std::abs(s1), std::abs(s2));
}

template <typename Real>
SphereAmplitudes evaluate(double size_parameter, std::complex<double> relative_index,
                          std::span<const double> angles_rad) {
  const Series<Real> series = mie_series<Real>(size_parameter, relative_index);
  SphereAmplitudes result;
  result.efficiencies = series.efficiencies;
  result.s1.resize(angles_rad.size());
  result.s2.resize(angles_rad.size());
  if (relative_index == 1.0) return result;
  const auto terms = weighted_terms<double>(series);
  constexpr std::size_t group = 8;  // a width that compilers turn into vector code
  for (std::size_t i = 0; i < angles_rad.size(); i += group) {
    const std::size_t count = std::min(group, angles_rad.size() - i);
    sum_series<double, group>(terms, angles_rad.subspan(i, count), &result.s1[i], &result.s2[i]);
  }
  std::vector<Term<Real>> precise_terms;
  for (std::size_t i = 0; i < angles_rad.size(); ++i) {
    if (!nearly_vanishes(result.s1[i], result.s2[i])) continue;
    if (precise_terms.empty()) precise_terms = weighted_terms<Real>(series);
    sum_series<Real, 1>(precise_terms, angles_rad.subspan(i, 1), &result.s1[i], &result.s2[i]);
  }
  return result;
}

void require(bool right, const char* what, double found, const char* expected) {
  if (!right) throw bad_input(what, std::to_string(found), expected);
}

}  // namespace

SphereAmplitudes mie_sphere(double size_parameter, std::complex<double> relative_index,
                            std::span<const double> scattering_angles_rad) {
  const double n = relative_index.real(), k = relative_index.imag();
  // Written so that NaN is refused too.
  require(size_parameter >= 1e-20 && size_parameter <= 1e6, "size parameter of a sphere",
          size_parameter, "must be from 1e-20 to 1e6");
  require(n > 0 && std::isfinite(n), "real part of a relative index", n, "must be above 0");
  require(k >= 0 && std::isfinite(k), "imaginary part of a relative index", k,
          "must be at least 0");
  require(std::abs(relative_index) * size_parameter <= 1e8, "relative index times size parameter",
          std::abs(relative_index) * size_parameter, "must be at most 1e8");
  for (const double angle : scattering_angles_rad)
    require(angle >= 0 && angle <= pi * (1 + 1e-15), "scattering angle", angle,
            "must be from 0 to pi (radians)");

  return std::abs(relative_index - 1.0) < nearly_matched
             ? evaluate<Quad>(size_parameter, relative_index, scattering_angles_rad)
             : evaluate<Long>(size_parameter, relative_index, scattering_angles_rad);
}

}  // namespace arcus::phase
