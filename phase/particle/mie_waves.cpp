#include "phase/particle/mie_waves.h"

#include <algorithm>
#include <cmath>

namespace arcus::phase {
namespace {

// Complex numbers, of as many spheres as a vector holds.
template <typename Width>
struct Pair {
  typename Width::Doubles re, im;
};

// Rows of four numbers of eight spheres each, seen as vectors that hold all of them or a half.
template <typename Width>
struct Rows {
  using Doubles = typename Width::Doubles;

  [[gnu::always_inline]] Doubles& at(int n, int i) const {
    return first[(4 * n + i) * Width::parts];
  }
  [[gnu::always_inline]] Pair<Width> pair(int n, int i) const { return {at(n, i), at(n, i + 1)}; }
  [[gnu::always_inline]] void store(int n, int i, const Pair<Width>& z) const {
    at(n, i) = z.re;
    at(n, i + 1) = z.im;
  }

  Doubles* first;
};

// What is needed of the relative index; computed where only one machine code exists.
struct Index {
  explicit Index(std::complex<double> index)
      : m(index), inverse_m(1.0 / m), contrast((1.0 - m) * (1.0 + m) * inverse_m * inverse_m) {}
  std::complex<double> m, inverse_m, contrast;  // contrast: 1/m^2 - 1
};

template <typename Width>
[[gnu::always_inline]] inline Pair<Width> times(const Pair<Width>& z,
                                                const std::complex<double>& factor) {
  return {z.re * factor.real() - z.im * factor.imag(), z.re * factor.imag() + z.im * factor.real()};
}

// Re(u v*).
template <typename Width>
[[gnu::always_inline]] inline typename Width::Doubles product(const Pair<Width>& u,
                                                              const Pair<Width>& v) {
  return u.re * v.re + u.im * v.im;
}

template <typename Width>
[[gnu::always_inline]] inline Pair<Width> reciprocal(const Pair<Width>& z) {
  const auto scale = 1 / product(z, z);
  return {z.re * scale, -z.im * scale};
}

// rho_n(mx) = psi_{n+1}/psi_n (complex) into rows[n][0 .. 1] and psi_n(x)/psi_{n-1}(x) (real) into
// rows[n][2], downward, n = 1 ... terms. See mie.cpp, successive_ratio and riccati_bessel_psi, for
// why and from where; the arbitrary first values are forgotten to 1e-12.
template <typename Width>
[[gnu::always_inline]] inline void downward(const Pair<Width>& inverse_z,
                                            const typename Width::Doubles& inverse_x,
                                            double largest_z, int terms, const Rows<Width>& rows) {
  using Doubles = typename Width::Doubles;
  const int beyond = static_cast<int>(largest_z + 6 * std::cbrt(largest_z)) + 20;
  Pair<Width> rho = {Doubles{}, Doubles{}};
  Doubles ratio = {};
  for (int n = std::max(beyond, terms + 15); n > 0; --n) {
    const double odd = 2 * n + 1;
    if (n <= terms) rows.store(n, 0, rho);
    rho = reciprocal<Width>({odd * inverse_z.re - rho.re, odd * inverse_z.im - rho.im});
    if (n > terms + 15) continue;
    ratio = 1 / (odd * inverse_x - ratio);
    if (n <= terms) rows.at(n, 2) = ratio;
  }
}

// Amplitude of a wave and its absorption: mie.cpp, partial_wave.
template <typename Width>
[[gnu::always_inline]] inline void partial_wave(const Pair<Width>& h,
                                                const typename Width::Doubles& psi,
                                                const typename Width::Doubles& psi_next,
                                                const typename Width::Doubles& chi,
                                                const typename Width::Doubles& chi_next,
                                                Pair<Width>& amplitude,
                                                typename Width::Doubles& absorption) {
  const Pair<Width> n = {h.re * psi + psi_next, h.im * psi};
  const Pair<Width> c = {h.re * chi + chi_next, h.im * chi};
  const Pair<Width> denominator = {n.re + c.im, n.im - c.re};
  const auto scale = 1 / product(denominator, denominator);
  amplitude.re = (product(n, n) - h.im) * scale;
  amplitude.im = product(n, c) * scale;
  absorption = -h.im * scale;
}

// a_n and b_n upward into rows[n][0 .. 3], n = 1 ... terms, and the efficiencies. A sphere that
// needs fewer terms than its neighbours has zeros from there on: its chi_n may overflow.
template <typename Width>
[[gnu::always_inline]] inline void upward(const double* size_parameters, const Index& index,
                                          const typename Width::Doubles& x,
                                          const typename Width::Doubles& inverse_x,
                                          std::span<const double> inverse, int terms,
                                          const Rows<Width>& rows,
                                          SphereEfficiencies* efficiencies) {
  using Doubles = typename Width::Doubles;
  const Doubles zero = {}, one = zero + 1;
  Doubles psi_before, psi = zero, chi_before, chi = zero, last = zero;
  for (int i = 0; i < lanes / Width::parts; ++i) {
    psi[i] = std::sin(size_parameters[i]);
    chi[i] = std::cos(size_parameters[i]);
    last[i] = mie_block_terms(size_parameters[i]);
  }
  // psi_1 and chi_1 from orders -1 and 0.
  psi_before = psi;
  psi = one > x ? psi * rows.at(1, 2) : psi * inverse_x - chi;
  chi_before = chi;
  chi = chi * inverse_x + psi_before;
  Pair<Width> a_before = {zero, zero}, b_before = {zero, zero}, back = {zero, zero};
  Doubles scattering = zero, absorption = zero, asymmetry = zero;
  for (int n = 1; n <= terms; ++n) {
    const Pair<Width> rho = rows.pair(n, 0);
    const Doubles odd_over_x = (2.0 * n + 1) * inverse_x;
    const Doubles upward_psi = odd_over_x * psi - psi_before;
    Doubles psi_next = upward_psi;
    if (n < terms) psi_next = (n + 1) * one > x ? psi * rows.at(n + 1, 2) : upward_psi;
    const Doubles chi_next = odd_over_x * chi - chi_before;
    const Doubles electric = (n + 1.0) * inverse_x;
    const Pair<Width> rho_over_m = times(rho, index.inverse_m), m_rho = times(rho, index.m);
    const Pair<Width> h_a = {index.contrast.real() * electric - rho_over_m.re,
                             index.contrast.imag() * electric - rho_over_m.im};
    const Pair<Width> h_b = {-m_rho.re, -m_rho.im};
    Pair<Width> a, b;
    Doubles lost_a, lost_b;
    partial_wave(h_a, psi, psi_next, chi, chi_next, a, lost_a);
    partial_wave(h_b, psi, psi_next, chi, chi_next, b, lost_b);
    const auto ended = n * one > last;
    a.re = ended ? zero : a.re;
    a.im = ended ? zero : a.im;
    b.re = ended ? zero : b.re;
    b.im = ended ? zero : b.im;
    const Doubles lost = ended ? zero : lost_a + lost_b;

    const double weight = 2.0 * n + 1;
    scattering += weight * (product(a, a) + product(b, b));
    absorption += weight * lost;
    asymmetry += weight * inverse[n] * inverse[n + 1] * product(a, b);
    asymmetry += (n - 1.0) * (n + 1) * inverse[n] * (product(a_before, a) + product(b_before, b));
    const double sign = n % 2 ? weight : -weight;
    back.re += sign * (a.re - b.re);
    back.im += sign * (a.im - b.im);
    rows.store(n, 0, a);
    rows.store(n, 2, b);
    a_before = a;
    b_before = b;
    psi_before = psi;
    psi = psi_next;
    chi_before = chi;
    chi = chi_next;
  }
  const Doubles extinction = scattering + absorption, backscatter = product(back, back);
  for (int i = 0; i < lanes / Width::parts; ++i) {
    const double per_area = 2 / (x[i] * x[i]);
    efficiencies[i].scattering = per_area * scattering[i];
    efficiencies[i].extinction = per_area * extinction[i];
    efficiencies[i].backscatter = per_area / 2 * backscatter[i];
    efficiencies[i].asymmetry = scattering[i] > 0 ? 2 * asymmetry[i] / scattering[i] : 0.0;
  }
}

// From a_n, b_n in rows[n] to the Legendre coefficients of S1 and S2, in place. With c_n = (2n +
// 1)/(n (n + 1)),
//   pi_n = P_n' = sum of (2k + 1) P_k over k = n - 1, n - 3, ...,   tau_n = n (n + 1) P_n -
//   cos(theta) pi_n
// (Bohren & Huffman section 4.3.1 and the recurrence of P_n) turn sum c_n (a_n pi_n + b_n tau_n)
// into
//   sum of (2k + 1) [A_k + b_k k/(k + 1) - B_{k+1}] P_k,   A_k = c_{k+1} a_{k+1} + c_{k+3} a_{k+3}
//   + ...
template <typename Width>
[[gnu::always_inline]] inline void to_legendre(std::span<const double> inverse, int terms,
                                               const Rows<Width>& rows) {
  using Doubles = typename Width::Doubles;
  const Doubles zero = {};
  Doubles following[4] = {zero, zero, zero, zero};  // a, b of k + 1
  Doubles sum[4] = {zero, zero, zero, zero};        // A, B of k + 2
  Doubles sum_after[4] = {zero, zero, zero, zero};  // A, B of k + 1
  for (int k = terms; k >= 0; --k) {
    const double weight = (2.0 * k + 3) * inverse[k + 1] * inverse[k + 2];
    const double share = k * inverse[k + 1], odd = 2.0 * k + 1;
    Doubles next[4], wave[4];
    for (int i = 0; i < 4; ++i) {
      next[i] = sum[i] + weight * following[i];
      wave[i] = k > 0 ? rows.at(k, i) : zero;
    }
    for (int i = 0; i < 4; ++i)
      rows.at(k, i) = odd * (next[i] + share * wave[i ^ 2] - sum_after[i ^ 2]);
    for (int i = 0; i < 4; ++i) {
      sum[i] = sum_after[i];
      sum_after[i] = next[i];
      following[i] = wave[i];
    }
  }
}

template <typename Width>
[[gnu::always_inline]] inline void all(const EightSpheres& spheres, const Index& index,
                                       std::span<const double> inverse, double largest_z, int terms,
                                       double* coefficients, SphereEfficiencies* efficiencies) {
  using Doubles = typename Width::Doubles;
  for (int part = 0; part < Width::parts; ++part) {
    const int first = part * lanes / Width::parts;
    const Rows<Width> rows = {reinterpret_cast<Doubles*>(coefficients) + part};
    Doubles x = {};
    for (int i = 0; i < lanes / Width::parts; ++i) x[i] = spheres.size_parameter[first + i];
    const Doubles inverse_x = 1 / x;
    const Pair<Width> inverse_z = {index.inverse_m.real() * inverse_x,
                                   index.inverse_m.imag() * inverse_x};
    downward<Width>(inverse_z, inverse_x, largest_z, terms, rows);
    upward<Width>(spheres.size_parameter + first, index, x, inverse_x, inverse, terms, rows,
                  efficiencies + first);
    to_legendre<Width>(inverse, terms, rows);
  }
}

[[gnu::target("arch=x86-64-v4")]] void all_avx512(const EightSpheres& spheres, const Index& index,
                                                  std::span<const double> inverse, double largest_z,
                                                  int terms, double* coefficients,
                                                  SphereEfficiencies* efficiencies) {
  all<Wide>(spheres, index, inverse, largest_z, terms, coefficients, efficiencies);
}

void all_avx2(const EightSpheres& spheres, const Index& index, std::span<const double> inverse,
              double largest_z, int terms, double* coefficients, SphereEfficiencies* efficiencies) {
  all<Narrow>(spheres, index, inverse, largest_z, terms, coefficients, efficiencies);
}

}  // namespace

// See series_length in mie.cpp; 5.5 x^(1/3) leaves 3e-11.
int mie_block_terms(double size_parameter) {
  return static_cast<int>(size_parameter + 5.5 * std::cbrt(size_parameter)) + 8;
}

int EightSpheres::terms() const {
  return mie_block_terms(*std::max_element(size_parameter, size_parameter + lanes));
}

void legendre_coefficients(const EightSpheres& spheres, std::span<const double> inverse,
                           double* coefficients, SphereEfficiencies* efficiencies,
                           Instructions instructions) {
  const double largest = *std::max_element(spheres.size_parameter, spheres.size_parameter + lanes);
  const double largest_z = largest * std::abs(spheres.relative_index);
  (instructions == Instructions::avx512 ? all_avx512 : all_avx2)(
      spheres, Index(spheres.relative_index), inverse, largest_z, spheres.terms(), coefficients,
      efficiencies);
}

}  // namespace arcus::phase
