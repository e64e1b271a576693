#pragma once
// Do draws follow their density? Pearson's chi-square over cells of nearly equal probability.

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace arcus::statistics {

/// Counts draws in cells: IntervalCells, SphereCells, or anything with size(), probabilities(),
/// find(point) and name(cell). Keeps a reference to the cells.
template <class Cells>
class Tally {
 public:
  explicit Tally(const Cells& cells) : cells_(cells), counts_(cells.size()) {}
  explicit Tally(const Cells&& temporary) = delete;
  template <class Point>
  void add(const Point& point) {
    if (const auto cell = cells_.find(point))
      ++counts_[*cell];
    else
      ++outside_;
  }
  const Cells& cells() const { return cells_; }
  std::span<const std::int64_t> counts() const { return counts_; }
  std::int64_t outside() const { return outside_; }  ///< draws that lie in no cell

 private:
  const Cells& cells_;
  std::vector<std::int64_t> counts_;
  std::int64_t outside_ = 0;
};

/// Cells that expect fewer draws than this are pooled: below it Pearson's statistic is not
/// chi-square.
inline constexpr double least_expected = 20;

/// Compares counts with probabilities. Accepts when the p-value is at least Šidák's share of the
/// test's budget among its `comparisons`. Rejects outright: draws outside of all cells or in a cell
/// of probability 0; probabilities that do not sum to 1 within 1e-4 (the density is not normalised,
/// or the cells missed a peak); fewer than 2 cells after pooling. A rejection names the p-value,
/// the number of cells, the three worst of them, the seed, and a CSV of all cells.
testing::AssertionResult chi_square(std::span<const std::int64_t> counts, std::int64_t outside,
                                    std::span<const double> probabilities,
                                    const std::function<std::string(std::size_t)>& name_of_cell,
                                    int comparisons = 1);

template <class Cells>
testing::AssertionResult chi_square(const Tally<Cells>& tally, int comparisons = 1) {
  return chi_square(
      tally.counts(), tally.outside(), tally.cells().probabilities(),
      [&](std::size_t cell) { return tally.cells().name(cell); }, comparisons);
}

/// Probability that chi-square with the given degrees of freedom ≥ 1 exceeds x ≥ 0.
double chi_square_p(double x, double degrees);

}  // namespace arcus::statistics
