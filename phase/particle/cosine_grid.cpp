#include "phase/particle/cosine_grid.h"

#include <algorithm>
#include <cmath>

#include "phase/base/units.h"

namespace arcus::phase {
namespace {

constexpr int taps = CosineGrid::taps;
using Tables = CosineGrid::Tables;

// Largest degree that a grid serves, as a share of its points.
constexpr double band = 2.0 / 3;

// Kaiser & Bessel's bell over `taps` grid steps, I0(beta sqrt(1 - (2 u/taps)^2)) / I0(beta), for
// frequencies up to band/2 per step.
class Bell {
 public:
  Bell() {
    // I0(y) = sum of (y^2/4)^k / k!^2; as a polynomial in 1 - (2 u/taps)^2.
    double sum = 0, term = 1;
    for (int k = 0; k < degree; ++k) {
      coefficient_[k] = term;
      sum += term;
      term *= beta * beta / (4.0 * (k + 1) * (k + 1));
    }
    for (double& coefficient : coefficient_) coefficient /= sum;
    centre_ = sum;
  }

  double operator()(double u) const {
    const double s = 1 - 4 * u * u / (taps * taps);
    if (s <= 0) return 0;
    double sum = 0;
    for (int k = degree - 1; k >= 0; --k) sum = sum * s + coefficient_[k];
    return sum;
  }

  // Its Fourier transform at a frequency per step, |frequency| <= band/2.
  double transform(double frequency) const {
    const double w = pi * taps * frequency, root = std::sqrt(beta * beta - w * w);
    return taps * std::sinh(root) / root / centre_;
  }

 private:
  // Puts the first frequency that aliases, 1 - band/2, on the edge of the transform's main lobe.
  static constexpr double beta = pi * taps * (1 - band / 2);
  static constexpr int degree = 48;  // leaves 1e-17
  double coefficient_[degree], centre_;
};

// The radices of the passes of the transform, from blocks of all points downward.
std::vector<int> radices(int points) {
  std::vector<int> result;
  if (points % 3 == 0) {
    result.push_back(3);
    points /= 3;
  }
  for (; points % 4 == 0; points /= 4) result.push_back(4);
  if (points == 2) result.push_back(2);
  return result;
}

// Where output k of the transform lies: the passes leave the outputs with k = r modulo the radix in
// block r.
int place_of(int k, int points, const std::vector<int>& radices) {
  int place = 0, block = points;
  for (const int radix : radices) {
    block /= radix;
    place += k % radix * block;
    k /= radix;
  }
  return place;
}

template <typename Width>
struct Number {
  typename Width::Doubles re, im;
};

// Complex numbers of eight spheres, seen as vectors that hold all of them or a half.
template <typename Width>
struct Numbers {
  using Doubles = typename Width::Doubles;

  [[gnu::always_inline]] Number<Width> load(int k) const {
    return {first[2 * k * Width::parts], first[(2 * k + 1) * Width::parts]};
  }
  [[gnu::always_inline]] void store(int k, const Number<Width>& z) const {
    first[2 * k * Width::parts] = z.re;
    first[(2 * k + 1) * Width::parts] = z.im;
  }
  [[gnu::always_inline]] void store_turned(int k, const Number<Width>& z,
                                           const std::complex<double>& turn) const {
    store(k, {z.re * turn.real() - z.im * turn.imag(), z.re * turn.imag() + z.im * turn.real()});
  }
  Numbers from(int k) const { return {first + 2 * k * Width::parts}; }

  Doubles* first;
};

// One pass with exp(+2 pi i/4) over blocks of `block` numbers: decimation in frequency, in place.
template <typename Width>
[[gnu::always_inline]] inline void pass4(const Tables& tables, const Numbers<Width>& data,
                                         int count, int block) {
  const int quarter = block / 4, step = tables.points / block;
  const std::complex<double>* turn = tables.turn.data();
  for (int start = 0; start < count; start += block)
    for (int j = 0; j < quarter; ++j) {
      const int k = start + j;
      const auto z0 = data.load(k), z1 = data.load(k + quarter);
      const auto z2 = data.load(k + 2 * quarter), z3 = data.load(k + 3 * quarter);
      const Number<Width> even = {z0.re + z2.re, z0.im + z2.im},
                          even_less = {z0.re - z2.re, z0.im - z2.im};
      const Number<Width> odd = {z1.re + z3.re, z1.im + z3.im},
                          odd_less = {z1.re - z3.re, z1.im - z3.im};
      data.store(k, {even.re + odd.re, even.im + odd.im});
      data.store_turned(k + quarter, {even_less.re - odd_less.im, even_less.im + odd_less.re},
                        turn[j * step]);
      data.store_turned(k + 2 * quarter, {even.re - odd.re, even.im - odd.im}, turn[2 * j * step]);
      data.store_turned(k + 3 * quarter, {even_less.re + odd_less.im, even_less.im - odd_less.re},
                        turn[3 * j * step]);
    }
}

template <typename Width>
[[gnu::always_inline]] inline void pass3(const Tables& tables, const Numbers<Width>& data) {
  const int third = tables.points / 3;
  const double sine = 0.86602540378443864676;  // of 120 degrees
  for (int k = 0; k < third; ++k) {
    const auto z0 = data.load(k), z1 = data.load(k + third), z2 = data.load(k + 2 * third);
    const Number<Width> sum = {z1.re + z2.re, z1.im + z2.im};
    const Number<Width> turned = {sine * (z2.im - z1.im), sine * (z1.re - z2.re)};
    const Number<Width> centre = {z0.re - 0.5 * sum.re, z0.im - 0.5 * sum.im};
    data.store(k, {z0.re + sum.re, z0.im + sum.im});
    data.store_turned(k + third, {centre.re + turned.re, centre.im + turned.im}, tables.turn[k]);
    data.store_turned(k + 2 * third, {centre.re - turned.re, centre.im - turned.im},
                      tables.turn[2 * k]);
  }
}

template <typename Width>
[[gnu::always_inline]] inline void pass2(const Numbers<Width>& data, int count) {
  for (int k = 0; k < count; k += 2) {
    const auto z0 = data.load(k), z1 = data.load(k + 1);
    data.store(k, {z0.re + z1.re, z0.im + z1.im});
    data.store(k + 1, {z0.re - z1.re, z0.im - z1.im});
  }
}

// Blocks that stay in the second level cache while all their remaining passes run.
constexpr int cached_points = 4096;

template <typename Width>
[[gnu::always_inline]] inline void transform(const Tables& tables, const Numbers<Width>& data) {
  int block = tables.points;
  if (block % 3 == 0) {
    pass3(tables, data);
    block /= 3;
  }
  for (; block > cached_points; block /= 4) pass4(tables, data, tables.points, block);
  for (int start = 0; start < tables.points; start += block) {
    int inner = block;
    for (; inner >= 4; inner /= 4) pass4(tables, data.from(start), block, inner);
    if (inner == 2) pass2(data.from(start), block);
  }
}

template <typename Width>
[[gnu::always_inline]] inline Number<Width> coefficient(const Tables& tables,
                                                        const typename Width::Doubles* series,
                                                        int k) {
  const double scale = tables.scale[k];
  return {scale * series[4 * k * Width::parts], scale * series[(4 * k + 1) * Width::parts]};
}

// A cosine series of complex coefficients X at theta = (g + 1/2) pi/H is one complex transform of
// length H: with W_0 = X_0, W_k = exp(i pi k/(2 H)) (X_k - i X_{H-k})/2 and v_j = sum of W_k exp(2
// pi i j k/H), the values at even g are v_{g/2}, at odd g v_{H-1-(g-1)/2}. (J. Makhoul, IEEE Trans.
// Acoust. Speech Signal Process. 28 (1980) 27-34.)
template <typename Width>
[[gnu::always_inline]] inline void prepare(const Tables& tables, int degree,
                                           const typename Width::Doubles* series,
                                           const Numbers<Width>& out) {
  const int points = tables.points;
  const typename Width::Doubles zero = {};
  out.store(0, coefficient<Width>(tables, series, 0));
  for (int k = 1; k < points; ++k) {
    const int mirror = points - k;
    const auto x = k <= degree ? coefficient<Width>(tables, series, k) : Number<Width>{zero, zero};
    const auto y =
        mirror <= degree ? coefficient<Width>(tables, series, mirror) : Number<Width>{zero, zero};
    out.store_turned(k, {x.re + y.im, x.im - y.re}, tables.half_turn[k]);
  }
}

template <typename Width>
[[gnu::always_inline]] inline void all(const Tables& tables, int degree, const double* series,
                                       double* work, float* grid, int half) {
  using Doubles = typename Width::Doubles;
  using Floats = typename Width::Floats;
  constexpr int parts = Width::parts, margin = taps / 2;
  constexpr int number = 2 * parts,
                row = 4 * number;  // Floats of a number of 16 spheres, and of four of them
  const int points = tables.points;
  for (int part = 0; part < parts; ++part) {
    Floats* rows = reinterpret_cast<Floats*>(grid) + half * parts + part;
    for (int i = 0; i < 2; ++i) {
      const Numbers<Width> data = {reinterpret_cast<Doubles*>(work) + part};
      prepare<Width>(tables, degree,
                     reinterpret_cast<const Doubles*>(series) + 2 * i * parts + part, data);
      transform(tables, data);
      for (int g = 0; g < points; ++g) {
        const auto value = data.load(tables.place[g]);
        Floats* to = rows + (g + margin) * row + 2 * i * number;
        to[0] = __builtin_convertvector(value.re, Floats);
        to[number] = __builtin_convertvector(value.im, Floats);
      }
    }
    // The function is even about 0 and 180 degrees.
    for (int i = 0; i < margin; ++i)
      for (int c = 0; c < row; c += number) {
        rows[(margin - 1 - i) * row + c] = rows[(margin + i) * row + c];
        rows[(margin + points + i) * row + c] = rows[(margin + points - 1 - i) * row + c];
      }
  }
}

void all_avx2(const Tables& tables, int degree, const double* series, double* work, float* grid,
              int half) {
  all<Narrow>(tables, degree, series, work, grid, half);
}

[[gnu::target("arch=x86-64-v4")]] void all_avx512(const Tables& tables, int degree,
                                                  const double* series, double* work, float* grid,
                                                  int half) {
  all<Wide>(tables, degree, series, work, grid, half);
}

}  // namespace

int CosineGrid::points_for(int degree) {
  const double least = (degree + 1) / band;
  for (int points = 32;; points *= 2) {
    if (points >= least) return points;
    if (points + points / 2 >= least) return points + points / 2;
  }
}

CosineGrid::CosineGrid(int points, std::span<const double> angles_rad) : points_(points) {
  const Bell bell;
  const std::vector<int> passes = radices(points);
  tables_.points = points;
  for (int k = 0; k < points * band; ++k)
    tables_.scale.push_back((k == 0 ? 1 : 2) / pi / bell.transform(0.5 * k / points));
  for (int i = 0; i < points; ++i) {
    tables_.half_turn.push_back(std::polar(0.5, pi * i / (2.0 * points)));
    tables_.turn.push_back(std::polar(1.0, 2 * pi * i / points));
    tables_.place.push_back(place_of(i % 2 ? points - 1 - i / 2 : i / 2, points, passes));
  }
  for (const double angle : angles_rad) {
    const double position = angle * points / pi - 0.5;
    const int before = static_cast<int>(std::floor(position));
    // Row taps/2 is grid point 0; the bell covers taps/2 points on either side.
    first_row_.push_back(before + 1);
    for (int i = 0; i < taps; ++i)
      weights_.push_back(static_cast<float>(bell(position - (before - taps / 2 + 1 + i))));
  }
}

void CosineGrid::sum(int degree, const double* series, double* work, float* grid, int half,
                     Instructions instructions) const {
  (instructions == Instructions::avx512 ? all_avx512 : all_avx2)(tables_, degree, series, work,
                                                                 grid, half);
}

}  // namespace arcus::phase
