#include "phase/particle/legendre_to_chebyshev.h"

#include <algorithm>
#include <cmath>

#include "phase/base/units.h"

namespace arcus::phase {
namespace {

constexpr int leaf = LegendreToChebyshev::leaf, nodes = LegendreToChebyshev::nodes,
              width = LegendreToChebyshev::width;
using Tables = LegendreToChebyshev::Tables;

// Even and odd degrees don't mix. In either, n = 2 b + parity and j = 2 a + parity with
//   b_j = 2/pi sum over b >= a of Lambda(b - a) Lambda(b + a + parity) a_n      (Alpert & Rokhlin
//   eq. 2.19)
// and half for j = 0. "Coefficient" below is a or b.
int leaf_count(int degree) { return degree / (2 * leaf) + 1; }

// Blocks at a level of twice the size each.
int block_count(int leaves, int level) { return (leaves + (1 << level) - 1) >> level; }

// Levels on which some block has another that isn't its neighbour.
int level_count(int leaves) {
  int levels = 0;
  while (block_count(leaves, levels) > 2) ++levels;
  return levels;
}

// Chebyshev nodes in (-1, 1).
double node(int i) { return std::cos(pi * (i + 0.5) / nodes); }

// The Lagrange polynomial of node i at t.
double lagrange(int i, double t) {
  double product = 1;
  for (int j = 0; j < nodes; ++j)
    if (j != i) product *= (t - node(j)) / (node(i) - node(j));
  return product;
}

// What registers hold: tiles of four rows by this many columns of vectors. The sums are the same
// for any tile.
template <typename Width>
constexpr int tile_columns = Width::parts == 1 ? 4 : 2;

// Vectors in a row of coefficients.
template <typename Width>
constexpr int vectors = width* Width::parts;

// out (+)= matrix in, with matrix [rows][lead] and in, out [row][vectors] at strides in vectors.
template <typename Width, bool add>
[[gnu::always_inline]] inline void multiply(const double* matrix, int lead, int rows, int depth,
                                            const typename Width::Doubles* in, int in_stride,
                                            typename Width::Doubles* out, int out_stride) {
  using Doubles = typename Width::Doubles;
  constexpr int columns = tile_columns<Width>;
  for (int row = 0; row < rows; row += 4)
    for (int column = 0; column < vectors<Width>; column += columns) {
      Doubles sum[4][columns];
      for (int r = 0; r < 4; ++r)
        for (int c = 0; c < columns; ++c)
          sum[r][c] = add ? out[(row + r) * out_stride + column + c] : Doubles{};
      const double* factors = matrix + row * lead;
      const Doubles* from = in + column;
      for (int d = 0; d < depth; ++d) {
        for (int r = 0; r < 4; ++r) {
          const auto factor = filled<Doubles>(factors[r * lead + d]);
          for (int c = 0; c < columns; ++c) add_product(sum[r][c], factor, from[c]);
        }
        from += in_stride;
      }
      for (int r = 0; r < 4; ++r)
        for (int c = 0; c < columns; ++c) out[(row + r) * out_stride + column + c] = sum[r][c];
    }
}

// The part of the matrix next to the diagonal: leaf A with leaves A and A + 1, entry by entry.
template <typename Width>
[[gnu::always_inline]] inline void near_field(const Tables& tables, int parity, int a, int leaves,
                                              const typename Width::Doubles* in,
                                              typename Width::Doubles* out) {
  const int depth = a + 1 < leaves ? 2 * leaf : leaf;
  constexpr int stride = 2 * vectors<Width>;
  alignas(64) double matrix[leaf][2 * leaf];
  for (int row = 0; row < leaf; ++row) {
    const double* toeplitz = &tables.toeplitz[2 * leaf - row];
    const double* hankel = &tables.hankel[2 * a * leaf + row + parity];
    for (int i = 0; i < 2 * leaf; ++i) matrix[row][i] = toeplitz[i] * hankel[i];
  }
  for (int row = 0; row < leaf; row += 4)  // rows from here on have zeros before column `row`
    multiply<Width, true>(&matrix[row][row], 2 * leaf, 4, depth - row, in + row * stride, stride,
                          out + row * stride, stride);
}

// One parity. Sources go up the hierarchy as values at the nodes of ever larger blocks; from there
// to the nodes of the blocks that are far, yet not so far that a larger pair of blocks has dealt
// with them; and down again.
template <typename Width>
[[gnu::always_inline]] inline void convert_parity(const Tables& tables, int parity, int leaves,
                                                  const typename Width::Doubles* in,
                                                  typename Width::Doubles* out,
                                                  typename Width::Doubles* scratch) {
  using Doubles = typename Width::Doubles;
  constexpr int width = vectors<Width>, block = nodes * width;  // vectors at the nodes of a block
  constexpr int stride = 2 * width;
  const int levels = level_count(leaves);
  // Sources of all levels one after another, then targets.
  int first_block[32], blocks = 0;
  for (int level = 0; level <= levels; ++level) {
    first_block[level] = blocks;
    blocks += block_count(leaves, level);
  }
  Doubles* sources = scratch;
  Doubles* targets = scratch + static_cast<std::ptrdiff_t>(blocks) * block;

  for (int a = 0; a < leaves && levels > 0; ++a)
    multiply<Width, false>(tables.gather.data(), leaf, nodes, leaf, in + a * leaf * stride, stride,
                           sources + a * block, width);
  for (int level = 1; level < levels; ++level) {
    const Doubles* halves = sources + first_block[level - 1] * block;
    const int count = block_count(leaves, level - 1);
    for (int a = 0; a < block_count(leaves, level); ++a) {
      Doubles* parent = sources + (first_block[level] + a) * block;
      multiply<Width, false>(tables.gather_half[0].data(), nodes, nodes, nodes,
                             halves + 2 * a * block, width, parent, width);
      if (2 * a + 1 < count)
        multiply<Width, true>(tables.gather_half[1].data(), nodes, nodes, nodes,
                              halves + (2 * a + 1) * block, width, parent, width);
    }
  }
  for (int level = levels - 1; level >= 0; --level) {
    const int count = block_count(leaves, level);
    const double* far = tables.far[parity][level].data();
    for (int a = 0; a < count; ++a) {
      Doubles* target = targets + (first_block[level] + a) * block;
      if (level + 1 < levels)
        multiply<Width, false>(tables.scatter_half[a % 2].data(), nodes, nodes, nodes,
                               targets + (first_block[level + 1] + a / 2) * block, width, target,
                               width);
      else
        for (int i = 0; i < block; ++i) target[i] = Doubles{};
      for (int step = 2; step <= (a % 2 ? 2 : 3) && a + step < count; ++step)
        multiply<Width, true>(far + (2 * a + step - 2) * nodes * nodes, nodes, nodes, nodes,
                              sources + (first_block[level] + a + step) * block, width, target,
                              width);
    }
  }
  for (int a = 0; a < leaves; ++a) {
    Doubles* rows = out + a * leaf * stride;
    if (levels > 0)
      multiply<Width, false>(tables.scatter.data(), nodes, leaf, nodes, targets + a * block, width,
                             rows, stride);
    else
      for (int i = 0; i < leaf; ++i)
        for (int c = 0; c < width; ++c) rows[i * stride + c] = Doubles{};
    near_field<Width>(tables, parity, a, leaves, in + a * leaf * stride, rows);
  }
}

template <typename Width>
[[gnu::always_inline]] inline void convert_all(const Tables& tables, int degree, double* legendre,
                                               double* chebyshev, double* scratch) {
  using Doubles = typename Width::Doubles;
  constexpr int width = vectors<Width>;
  const int leaves = leaf_count(degree);
  Doubles* in = reinterpret_cast<Doubles*>(legendre);
  for (int i = (degree + 1) * width; i < 2 * leaf * leaves * width; ++i) in[i] = Doubles{};
  for (int parity = 0; parity < 2; ++parity)
    convert_parity<Width>(tables, parity, leaves, in + parity * width,
                          reinterpret_cast<Doubles*>(chebyshev) + parity * width,
                          reinterpret_cast<Doubles*>(scratch));
}

void convert_avx2(const Tables& tables, int degree, double* legendre, double* chebyshev,
                  double* scratch) {
  convert_all<Narrow>(tables, degree, legendre, chebyshev, scratch);
}

[[gnu::target("arch=x86-64-v4")]] void convert_avx512(const Tables& tables, int degree,
                                                      double* legendre, double* chebyshev,
                                                      double* scratch) {
  convert_all<Wide>(tables, degree, legendre, chebyshev, scratch);
}

}  // namespace

double gamma_ratio(double z) {
  // Far from the pole at -1/2 by Lambda(z) = Lambda(z + 1) (z + 1)/(z + 1/2); there the asymptotic
  // series in z + 1/4 (Tricomi & Erdelyi 1951; F. W. J. Olver, Asymptotics and Special Functions,
  // 1974, section 4.5).
  double factor = 1;
  for (; z < 20; z += 1) factor *= (z + 1) / (z + 0.5);
  const double s = z + 0.25, t = 1 / (s * s);
  return factor / std::sqrt(s) *
         (1 +
          t * (-1.0 / 64 + t * (21.0 / 8192 + t * (-671.0 / 524288 + t * (180323.0 / 134217728)))));
}

std::size_t LegendreToChebyshev::series_size(int degree) {
  return static_cast<std::size_t>(leaf_count(degree)) * 2 * leaf * width;
}

std::size_t LegendreToChebyshev::scratch_size(int degree) {
  std::size_t blocks = 0;
  const int leaves = leaf_count(degree);
  for (int level = 0; level <= level_count(leaves); ++level) blocks += block_count(leaves, level);
  return 2 * blocks * nodes * width;
}

LegendreToChebyshev::LegendreToChebyshev(int largest_degree) {
  const int leaves = leaf_count(largest_degree), count = leaves * leaf;
  tables_.toeplitz.resize(4 * leaf);
  for (int i = 0; i < 2 * leaf; ++i) tables_.toeplitz[2 * leaf + i] = gamma_ratio(i);
  tables_.hankel.resize(2 * count + 2 * leaf + 1);
  for (std::size_t i = 0; i < tables_.hankel.size(); ++i) tables_.hankel[i] = gamma_ratio(i);

  // A block of size L that begins at coefficient s stands for the interval from s - 1/2 to s + L -
  // 1/2.
  tables_.gather.resize(nodes * leaf);
  tables_.scatter.resize(nodes * leaf);
  for (int i = 0; i < nodes; ++i)
    for (int j = 0; j < leaf; ++j)
      tables_.gather[i * leaf + j] = tables_.scatter[j * nodes + i] =
          lagrange(i, (2 * j + 1.0) / leaf - 1);
  for (int half = 0; half < 2; ++half) {
    tables_.gather_half[half].resize(nodes * nodes);
    tables_.scatter_half[half].resize(nodes * nodes);
    for (int i = 0; i < nodes; ++i)
      for (int j = 0; j < nodes; ++j)
        tables_.gather_half[half][i * nodes + j] = tables_.scatter_half[half][j * nodes + i] =
            lagrange(i, (node(j) + (half ? 1 : -1)) / 2);
  }
  for (int parity = 0; parity < 2; ++parity)
    for (int level = 0; level < level_count(leaves); ++level) {
      const int blocks = block_count(leaves, level);
      const double size = leaf << level;
      auto& far =
          tables_.far[parity].emplace_back(static_cast<std::size_t>(blocks) * 2 * nodes * nodes);
      for (int a = 0; a < blocks; ++a)
        for (int step = 2; step <= 3 && a + step < blocks; ++step)
          for (int i = 0; i < nodes; ++i)
            for (int j = 0; j < nodes; ++j) {
              const double target = size * (a + (node(i) + 1) / 2) - 0.5;
              const double source = size * (a + step + (node(j) + 1) / 2) - 0.5;
              far[((2 * a + step - 2) * nodes + i) * nodes + j] =
                  gamma_ratio(source - target) * gamma_ratio(source + target + parity);
            }
    }
}

void LegendreToChebyshev::convert(int degree, double* legendre, double* chebyshev, double* scratch,
                                  Instructions instructions) const {
  (instructions == Instructions::avx512 ? convert_avx512 : convert_avx2)(tables_, degree, legendre,
                                                                         chebyshev, scratch);
}

}  // namespace arcus::phase
