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

// Kaiser & Bessel's bell of `taps` grid steps, for frequencies up to band/2 per step: I0(beta sqrt(1 - (2 u/taps)^2)).
// beta puts the first frequency that aliases, 1 - band/2, on the edge of its main lobe.
const double beta = pi * taps * (1 - band / 2);

// Modified Bessel function I0 by its series.
double bessel_i0(double y) {
  double sum = 1, term = 1;
  for (int k = 1; term > 1e-17 * sum; ++k) {
    term *= y * y / (4.0 * k * k);
    sum += term;
  }
  return sum;
}

double bell(double u) {
  const double t = 2 * u / taps;
  return std::abs(t) >= 1 ? 0 : bessel_i0(beta * std::sqrt(1 - t * t)) / bessel_i0(beta);
}

// Its Fourier transform at a frequency per grid step, |frequency| <= band/2.
double bell_transform(double frequency) {
  const double w = pi * taps * frequency, root = std::sqrt(beta * beta - w * w);
  return taps * std::sinh(root) / root / bessel_i0(beta);
}

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

// Where output k of the transform lies: the passes leave the outputs with k = r modulo the radix in block r.
int place_of(int k, int points) {
  int place = 0, block = points;
  for (const int radix : radices(points)) {
    block /= radix;
    place += k % radix * block;
    k /= radix;
  }
  return place;
}

struct Number {
  Doubles re, im;
};

[[gnu::always_inline]] inline Number load(const Doubles* at) { return {at[0], at[1]}; }

[[gnu::always_inline]] inline void store(Doubles* at, const Number& z) {
  at[0] = z.re;
  at[1] = z.im;
}

[[gnu::always_inline]] inline void store_turned(Doubles* at, const Number& z, const std::complex<double>& turn) {
  at[0] = z.re * turn.real() - rounded(z.im * turn.imag());
  at[1] = z.re * turn.imag() + rounded(z.im * turn.real());
}

// One pass with exp(+2 pi i/radix) over blocks of `block` points: decimation in frequency, in place.
[[gnu::always_inline]] inline void pass4(const Tables& tables, Doubles* data, int count, int block) {
  const int quarter = block / 4, step = tables.points / block;
  const std::complex<double>* turn = tables.turn.data();
  for (int start = 0; start < count; start += block)
    for (int j = 0; j < quarter; ++j) {
      Doubles* at[4];
      for (int i = 0; i < 4; ++i) at[i] = data + 2 * (start + j + i * quarter);
      const Number z0 = load(at[0]), z1 = load(at[1]), z2 = load(at[2]), z3 = load(at[3]);
      const Number sum = {z0.re + z2.re, z0.im + z2.im}, difference = {z0.re - z2.re, z0.im - z2.im};
      const Number odd_sum = {z1.re + z3.re, z1.im + z3.im}, odd_difference = {z1.re - z3.re, z1.im - z3.im};
      store(at[0], {sum.re + odd_sum.re, sum.im + odd_sum.im});
      store_turned(at[1], {difference.re - odd_difference.im, difference.im + odd_difference.re}, turn[j * step]);
      store_turned(at[2], {sum.re - odd_sum.re, sum.im - odd_sum.im}, turn[2 * j * step]);
      store_turned(at[3], {difference.re + odd_difference.im, difference.im - odd_difference.re}, turn[3 * j * step]);
    }
}

[[gnu::always_inline]] inline void pass3(const Tables& tables, Doubles* data) {
  const int third = tables.points / 3;
  const double sine = 0.86602540378443864676;  // of 120 degrees
  for (int j = 0; j < third; ++j) {
    Doubles* at[3];
    for (int i = 0; i < 3; ++i) at[i] = data + 2 * (j + i * third);
    const Number z0 = load(at[0]), z1 = load(at[1]), z2 = load(at[2]);
    const Number sum = {z1.re + z2.re, z1.im + z2.im};
    const Number turned = {rounded(sine * (z2.im - z1.im)), rounded(sine * (z1.re - z2.re))};  // i sin(120) (z1 - z2)
    const Number centre = {z0.re - 0.5 * sum.re, z0.im - 0.5 * sum.im};
    store(at[0], {z0.re + sum.re, z0.im + sum.im});
    store_turned(at[1], {centre.re + turned.re, centre.im + turned.im}, tables.turn[j]);
    store_turned(at[2], {centre.re - turned.re, centre.im - turned.im}, tables.turn[2 * j]);
  }
}

[[gnu::always_inline]] inline void pass2(Doubles* data, int count) {
  for (int j = 0; j < count; j += 2) {
    const Number z0 = load(data + 2 * j), z1 = load(data + 2 * j + 2);
    store(data + 2 * j, {z0.re + z1.re, z0.im + z1.im});
    store(data + 2 * j + 2, {z0.re - z1.re, z0.im - z1.im});
  }
}

// Blocks that stay in the first and second level cache while all their remaining passes run.
constexpr int cached_points = 4096;

[[gnu::always_inline]] inline void transform(const Tables& tables, Doubles* data) {
  int block = tables.points;
  if (block % 3 == 0) {
    pass3(tables, data);
    block /= 3;
  }
  for (; block > cached_points; block /= 4) pass4(tables, data, tables.points, block);
  for (int start = 0; start < tables.points; start += block) {
    int inner = block;
    for (; inner >= 4; inner /= 4) pass4(tables, data + 2 * start, block, inner);
    if (inner == 2) pass2(data + 2 * start, block);
  }
}

// A cosine series of complex coefficients X at theta = (g + 1/2) pi/H is one complex transform of length H:
// with W_0 = X_0, W_k = exp(i pi k/(2 H)) (X_k - i X_{H-k})/2 and v_j = sum of W_k exp(2 pi i j k/H), the values at even g
// are v_{g/2}, at odd g v_{H-1-(g-1)/2}. (J. Makhoul, IEEE Trans. Acoust. Speech Signal Process. 28 (1980) 27-34.)
[[gnu::always_inline]] inline Number coefficient(const Tables& tables, const Doubles* series, int k) {
  const double scale = tables.scale[k];
  return {rounded(scale * series[4 * k]), rounded(scale * series[4 * k + 1])};
}

[[gnu::always_inline]] inline void prepare(const Tables& tables, int degree, const Doubles* series, Doubles* out) {
  const int points = tables.points;
  const Doubles zero = {};
  store(out, coefficient(tables, series, 0));
  for (int k = 1; k < points; ++k) {
    const int mirror = points - k;
    const Number x = k <= degree ? coefficient(tables, series, k) : Number{zero, zero};
    const Number y = mirror <= degree ? coefficient(tables, series, mirror) : Number{zero, zero};
    store_turned(out + 2 * k, {x.re + y.im, x.im - y.re}, tables.half_turn[k]);
  }
}

[[gnu::always_inline]] inline void all(const Tables& tables, int degree, const Doubles* series, Doubles* work,
                                       Floats16* grid, int half) {
  const int points = tables.points;
  Floats8* rows = reinterpret_cast<Floats8*>(grid) + half;
  for (int i = 0; i < 2; ++i) {
    prepare(tables, degree, series + 2 * i, work);
    transform(tables, work);
    for (int g = 0; g < points; ++g) {
      Floats8* row = rows + 8 * (g + taps / 2) + 4 * i;
      const Doubles* value = work + 2 * tables.place[g];
      row[0] = __builtin_convertvector(value[0], Floats8);
      row[2] = __builtin_convertvector(value[1], Floats8);
    }
  }
  // The function is even about 0 and 180 degrees.
  for (int i = 0; i < taps / 2; ++i)
    for (int c = 0; c < 8; c += 2) {
      rows[8 * (taps / 2 - 1 - i) + c] = rows[8 * (taps / 2 + i) + c];
      rows[8 * (taps / 2 + points + i) + c] = rows[8 * (taps / 2 + points - 1 - i) + c];
    }
}

void all_avx2(const Tables& tables, int degree, const Doubles* series, Doubles* work, Floats16* grid, int half) {
  all(tables, degree, series, work, grid, half);
}

[[gnu::target("arch=x86-64-v4")]] void all_avx512(const Tables& tables, int degree, const Doubles* series,
                                                  Doubles* work, Floats16* grid, int half) {
  all(tables, degree, series, work, grid, half);
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
  tables_.points = points;
  for (int k = 0; k < points * band; ++k)
    tables_.scale.push_back((k == 0 ? 1 : 2) / pi / bell_transform(0.5 * k / points));
  for (int k = 0; k < points; ++k) {
    tables_.half_turn.push_back(std::polar(0.5, pi * k / (2.0 * points)));
    tables_.turn.push_back(std::polar(1.0, 2 * pi * k / points));
    const int g = k;
    tables_.place.push_back(place_of(g % 2 ? points - 1 - g / 2 : g / 2, points));
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

void CosineGrid::sum(int degree, const Doubles* series, Doubles* work, Floats16* grid, int half,
                     Instructions instructions) const {
  (instructions == Instructions::avx512 ? all_avx512 : all_avx2)(tables_, degree, series, work, grid, half);
}

}  // namespace arcus::phase
