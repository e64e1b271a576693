#include "src/scene/colour_basis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "phase/base/error.h"

namespace arcus::render {
namespace {

constexpr std::size_t node_nm = 5, nodes = ThreeSpectra::cells / node_nm + 1;
using Factors = std::vector<double>;  ///< [node]

/// Solves m x = right in place by elimination with pivots; false where the matrix is singular.
bool solve(std::vector<std::vector<double>>& m, std::vector<double>& right) {
  const std::size_t n = right.size();
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (std::fabs(m[i][k]) > std::fabs(m[pivot][k])) pivot = i;
    if (!(std::fabs(m[pivot][k]) > 1e-13)) return false;
    std::swap(m[k], m[pivot]);
    std::swap(right[k], right[pivot]);
    for (std::size_t i = k + 1; i < n; ++i) {
      const double factor = m[i][k] / m[k][k];
      if (factor == 0) continue;
      for (std::size_t j = k; j < n; ++j) m[i][j] -= factor * m[k][j];
      right[i] -= factor * right[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t j = k + 1; j < n; ++j) right[k] -= m[k][j] * right[j];
    right[k] /= m[k][k];
  }
  return true;
}

/// Adds the roughness of the factors from variable `first` on: the matrix of the sum of squared second differences, and a little of the first ones.
void add_roughness(std::vector<std::vector<double>>& m, std::size_t first) {
  const auto add = [&](std::size_t k, std::initializer_list<double> weights, double scale) {
    std::size_t i = k;
    for (const double a : weights) {
      std::size_t j = k;
      for (const double b : weights) m[first + i][first + j++] += scale * a * b;
      ++i;
    }
  };
  for (std::size_t k = 0; k + 2 < nodes; ++k) add(k, {1, -2, 1}, 1);
  for (std::size_t k = 0; k + 1 < nodes; ++k) add(k, {1, -1}, 1e-4);
}

/// What a factor of 1 at a node, linear to 0 at its neighbours, contributes to R, G and B: [colour][node].
using Colours = std::array<std::array<double, nodes>, 3>;

double hat(std::size_t node, std::size_t k) {
  const double away = std::fabs(static_cast<double>(k) - static_cast<double>(node * node_nm)) / static_cast<double>(node_nm);
  return std::max(0.0, 1 - away);
}

Colours colours_of(const ToRgb& to_rgb, const std::vector<double>& white) {
  Colours colours{};
  for (std::size_t node = 0; node < nodes; ++node) {
    const auto rows = [&](std::size_t k) { return k > ThreeSpectra::cells ? 0 : hat(node, k) * white[k]; };
    const double first = static_cast<double>(node * node_nm) - static_cast<double>(node_nm), last = first + 2 * static_cast<double>(node_nm);
    const Rgb rgb = to_rgb(xyz_of([&](double nm) {
      const double place = nm - shortest_wavelength_nm;
      if (place < first || place > last) return 0.0;
      const auto k = static_cast<std::size_t>(place);
      return rows(k) + (rows(k + 1) - rows(k)) * (place - static_cast<double>(k));
    }));
    colours[0][node] = rgb.r, colours[1][node] = rgb.g, colours[2][node] = rgb.b;
  }
  return colours;
}

/// The smoothest factor that makes white of `white`; negative nowhere or the caller gives up.
Factors whitening(const Colours& colours) {
  std::vector<std::vector<double>> m(nodes + 3, std::vector<double>(nodes + 3, 0));
  std::vector<double> right(nodes + 3, 0);
  add_roughness(m, 0);
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t k = 0; k < nodes; ++k) m[nodes + c][k] = m[k][nodes + c] = colours[c][k];
    right[nodes + c] = 1;
  }
  if (!solve(m, right)) return {};
  right.resize(nodes);
  return right;
}

/// Three factors of 0 or more that add up to `sum` and make the primaries; empty where there are none.
std::vector<Factors> primaries(const Colours& colours, const Factors& sum) {
  constexpr std::size_t variables = 3 * nodes, sums = variables, targets = sums + nodes, all = targets + 6;
  // The colours of the third follow from those of the sum.
  std::vector<std::vector<double>> whole(all, std::vector<double>(all, 0));
  std::vector<double> wanted(all, 0);
  for (std::size_t s = 0; s < 3; ++s) add_roughness(whole, s * nodes);
  for (std::size_t k = 0; k < nodes; ++k) {
    for (std::size_t s = 0; s < 3; ++s) whole[sums + k][s * nodes + k] = whole[s * nodes + k][sums + k] = 1;
    wanted[sums + k] = sum[k];
  }
  for (std::size_t s = 0; s < 2; ++s)
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t row = targets + 3 * s + c;
      for (std::size_t k = 0; k < nodes; ++k) whole[row][s * nodes + k] = whole[s * nodes + k][row] = colours[c][k];
      wanted[row] = s == c ? 1 : 0;
    }
  std::vector<bool> is_zero(variables, false);
  for (int round = 0; round < 100; ++round) {
    auto m = whole;
    auto x = wanted;
    for (std::size_t i = 0; i < variables; ++i) {
      if (!is_zero[i]) continue;
      std::fill(m[i].begin(), m[i].end(), 0.0);
      m[i][i] = 1;
      x[i] = 0;
    }
    if (!solve(m, x)) return {};
    bool has_changed = false;
    for (std::size_t i = 0; i < variables; ++i) {
      bool zero = x[i] < -1e-12;
      if (is_zero[i]) {
        double push = 0;  // the multiplier: above 0 where the condition holds the factor up
        for (std::size_t j = 0; j < all; ++j) push += whole[i][j] * x[j];
        zero = push >= 0;
      }
      has_changed |= zero != is_zero[i];
      is_zero[i] = zero;
    }
    if (has_changed) continue;
    std::vector<Factors> result;
    for (std::size_t s = 0; s < 3; ++s) {
      const auto begin = x.begin() + static_cast<std::ptrdiff_t>(s * nodes);
      result.emplace_back(begin, begin + static_cast<std::ptrdiff_t>(nodes));
    }
    return result;
  }
  return {};
}

ThreeSpectra basis(const ToRgb& to_rgb, const std::vector<double>& white) {
  const Colours colours = colours_of(to_rgb, white);
  const Factors sum = whitening(colours);
  std::vector<Factors> factors;
  if (!sum.empty() && *std::min_element(sum.begin(), sum.end()) > 0) factors = primaries(colours, sum);
  if (factors.empty())
    throw bad_input("film.white", "a white under which the primaries of Rec.709 are no colours of light", "auto, D65, equal_energy or 2500 to 20000 K expected for scenes with pictures of the sky");
  std::array<std::vector<double>, 3> values;
  for (std::size_t s = 0; s < 3; ++s) {
    values[s].resize(ThreeSpectra::cells + 1);
    for (std::size_t k = 0; k <= ThreeSpectra::cells; ++k) {
      const std::size_t node = std::min(k / node_nm, nodes - 2);
      const double share = static_cast<double>(k - node * node_nm) / static_cast<double>(node_nm);
      values[s][k] = std::max(0.0, factors[s][node] * (1 - share) + factors[s][node + 1] * share) * white[k];
    }
  }
  return ThreeSpectra(values);
}

}  // namespace

ThreeSpectra light_basis(const ToRgb& to_rgb, const std::function<double(double nm)>& white) {
  std::vector<double> rows;
  for (std::size_t k = 0; k <= ThreeSpectra::cells; ++k) rows.push_back(white(shortest_wavelength_nm + static_cast<double>(k)));
  double sum = 0;
  for (const double row : rows) sum += row;
  for (double& row : rows) row *= static_cast<double>(rows.size()) / sum;  // so that factors are about 1
  return basis(to_rgb, rows);
}

ThreeSpectra reflectance_basis() {
  return basis(to_rgb_from_white(equal_energy_white()), std::vector<double>(ThreeSpectra::cells + 1, 1.0));
}

}  // namespace arcus::render
