#include "src/integrator/sample_points.h"

#include <bit>

namespace arcus::render {
namespace {

constexpr int dimensions = 5;
using Directions = std::array<std::array<std::uint32_t, 32>, dimensions>;

/// Direction numbers from the primitive polynomials and initial numbers of Joe and Kuo ("Constructing Sobol Sequences
/// with Better Two-Dimensional Projections", SIAM J. Sci. Comput. 30, 2008): degree, coefficients a, initial m.
constexpr Directions sobol_directions() {
  struct Polynomial {
    int degree;
    std::uint32_t a;
    std::array<std::uint32_t, 3> m;
  };
  constexpr std::array<Polynomial, dimensions - 1> polynomials{
      {{1, 0, {1, 0, 0}}, {2, 1, {1, 3, 0}}, {3, 1, {1, 3, 1}}, {3, 2, {1, 1, 1}}}};
  Directions v{};
  for (int k = 0; k < 32; ++k) v[0][static_cast<std::size_t>(k)] = 1u << (31 - k);
  for (std::size_t d = 1; d < dimensions; ++d) {
    const Polynomial& p = polynomials[d - 1];
    for (int k = 0; k < 32; ++k) {
      const auto i = static_cast<std::size_t>(k);
      if (k < p.degree) {
        v[d][i] = p.m[i] << (31 - k);
        continue;
      }
      std::uint32_t value = v[d][i - static_cast<std::size_t>(p.degree)] >> p.degree;
      value ^= v[d][i - static_cast<std::size_t>(p.degree)];
      for (int j = 1; j < p.degree; ++j)
        if ((p.a >> (p.degree - 1 - j)) & 1u) value ^= v[d][i - static_cast<std::size_t>(j)];
      v[d][i] = value;
    }
  }
  return v;
}

/// What each value of each byte of an index brings: a number is four look-ups.
using ByteTables = std::array<std::array<std::array<std::uint32_t, 256>, 4>, dimensions>;
constexpr ByteTables byte_tables() {
  constexpr Directions directions = sobol_directions();
  ByteTables tables{};
  for (std::size_t d = 0; d < dimensions; ++d)
    for (std::size_t byte = 0; byte < 4; ++byte)
      for (std::size_t value = 1; value < 256; ++value) {
        // The value without its lowest bit, and that bit.
        const auto lowest = static_cast<std::size_t>(std::countr_zero(value));
        tables[d][byte][value] = tables[d][byte][value & (value - 1)] ^ directions[d][8 * byte + lowest];
      }
  return tables;
}
constexpr ByteTables tables = byte_tables();

std::uint32_t reversed(std::uint32_t x) {
  x = __builtin_bswap32(x);
  x = ((x & 0x0f0f0f0fu) << 4) | ((x >> 4) & 0x0f0f0f0fu);
  x = ((x & 0x33333333u) << 2) | ((x >> 2) & 0x33333333u);
  return ((x & 0x55555555u) << 1) | ((x >> 1) & 0x55555555u);
}

/// Owen scrambling of a number whose bits are reversed: every bit is flipped by a hash of the bits below it.
std::uint32_t scrambled_reversed(std::uint32_t x, std::uint32_t seed) {
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1u;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return x;
}

std::uint64_t mixed(std::uint64_t x) {  // the finaliser of SplitMix64 (Steele, Lea and Flood, OOPSLA 2014)
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

}  // namespace

FirstNumbers first_numbers(std::uint64_t seed, std::uint64_t pixel, std::uint32_t sample) {
  std::uint64_t hash = mixed(mixed(seed) ^ pixel);
  // The order of the samples is shuffled too, so that pixels are independent.
  const std::uint32_t index =
      reversed(scrambled_reversed(reversed(sample), static_cast<std::uint32_t>(hash)));
  std::array<double, dimensions> u{};
  for (std::size_t d = 0; d < dimensions; ++d) {
    hash = mixed(hash);
    const auto& of = tables[d];
    std::uint32_t x = of[0][index & 255u] ^ of[1][index >> 8 & 255u] ^ of[2][index >> 16 & 255u] ^ of[3][index >> 24];
    x = reversed(scrambled_reversed(reversed(x), static_cast<std::uint32_t>(hash)));
    u[d] = x * 0x1p-32;
  }
  return {u[0], u[1], u[2], u[3], u[4]};
}

}  // namespace arcus::render
