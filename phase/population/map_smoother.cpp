#include "phase/population/map_smoother.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "phase/base/units.h"

namespace arcus::phase {
namespace {

/// Half widths of windows in steps of elevation, half an octave apart.
constexpr std::array half_widths{0, 1, 2, 3, 4, 6, 8, 11, 16, 23, 32, 45, 64, 91, 128};
constexpr double largest_half_width_deg = 8;
/// Intervals of so many standard errors to both sides are asked whether they meet.
constexpr double confidence = 2.0;
/// From so many deposits, counted as equally heavy ones, it is seen how heavy they are.
constexpr double usual_deposits = 16;

/// Sums over rectangles of cells of the whole sky, from those of its half.
class AreaSums {
 public:
  AreaSums(const SkyGrid& grid, std::span<const float> light)
      : steps_(grid.steps()), width_(grid.row() + 1), sums_(width_ * (grid.row() + 1)) {
    for (std::size_t row = 0; row < grid.row(); ++row) {
      double along = 0;
      for (std::size_t column = 0; column < grid.row(); ++column) {
        along += light[row * grid.row() + column] / SkyGrid::images(static_cast<int>(column), steps_);
        sums_[(row + 1) * width_ + column + 1] = sums_[row * width_ + column + 1] + along;
      }
    }
  }

  /// Rows first to before end, columns within reach of `column` to both sides; all of a row if reach >= steps.
  double around(int first, int end, int column, int reach) const {
    const double sum = any_around(first, end, column, reach);
    // Differences of sums over half the sky: less is what rounding leaves of nothing.
    return sum > 1e-12 * sums_.back() ? sum : 0;
  }

 private:
  double any_around(int first, int end, int column, int reach) const {
    if (reach >= steps_) return 2 * strip(first, end, 0, steps_ + 1) - strip(first, end, 0, 1) - strip(first, end, steps_, steps_ + 1);
    const int low = column - reach, high = column + reach;
    double sum = strip(first, end, std::max(low, 0), std::min(high, steps_) + 1);
    // Beyond the sun's vertical plane, in front and behind, is the mirror image.
    if (low < 0) sum += strip(first, end, 1, 1 - low);
    if (high > steps_) sum += strip(first, end, 2 * steps_ - high, steps_);
    return sum;
  }
  double strip(int first, int end, int from, int to) const {
    const double *above = &sums_[static_cast<std::size_t>(end) * width_], *below = &sums_[static_cast<std::size_t>(first) * width_];
    return (above[to] - above[from]) - (below[to] - below[from]);
  }

  int steps_;
  std::size_t width_;
  std::vector<double> sums_;  ///< of rows and columns below, as if the sky had but this half
};

struct Window {
  int first, end, reach;
  double sr;
};

/// Windows around the nodes of one row, as wide as they are high.
class Windows {
 public:
  Windows(const SkyGrid& grid, const std::vector<double>& band_sr, int row) {
    const int steps = grid.steps();
    // Of the middle of what a pole's cell has.
    const double level = row == 0 || row == steps ? std::sin(0.25 * grid.step_rad()) : std::cos(radians(grid.elevation_deg(row)));
    for (const int half : half_widths) {
      if (half > 0 && half * grid.step_rad() > radians(largest_half_width_deg)) break;
      Window w;
      w.first = std::max(0, row - half);
      w.end = std::min(steps, row + half) + 1;
      w.reach = static_cast<int>(std::min(static_cast<double>(steps), (half + 0.5) / level));
      const double columns = w.reach >= steps ? 2 * steps : 2 * w.reach + 1;
      w.sr = columns * (band_sr[static_cast<std::size_t>(w.end)] - band_sr[static_cast<std::size_t>(w.first)]);
      list_.push_back(w);
    }
  }
  int count() const { return static_cast<int>(list_.size()); }
  const Window& operator[](int level) const { return list_[static_cast<std::size_t>(level)]; }

 private:
  std::vector<Window> list_;
};

template <class Action>
void for_each_row(int rows, const Action& action) {
  tbb::parallel_for(0, rows, [&](int row) { action(row); });
}

}  // namespace

MapSmoother::MapSmoother(const SkyGrid& grid, std::span<const float> light, std::span<const float> squares, double noise)
    : grid_(grid), band_sr_{0}, level_(grid.size()), error_(grid.size()) {
  for (int row = 0; row <= grid.steps(); ++row) band_sr_.push_back(band_sr_.back() + grid.cell_sr(row));
  choose_levels(light, squares, noise);
}

void MapSmoother::choose_levels(std::span<const float> light, std::span<const float> squares, double noise) {
  const AreaSums lights(grid_, light), all_squares(grid_, squares);
  const int steps = grid_.steps();
  for_each_row(steps + 1, [&](int row) {
    const Windows windows(grid_, band_sr_, row);
    for (int column = 0; column <= steps; ++column) {
      // A cell that nothing fell into, or little, is not known to be dark: its error counts one more deposit, of the weight that is
      // usual around, where enough fell to tell.
      double weight = 0;
      for (int level = std::min(4, windows.count() - 1); level < windows.count(); ++level) {
        const Window& w = windows[level];
        const double sum = lights.around(w.first, w.end, column, w.reach);
        const double square = std::max(0.0, all_squares.around(w.first, w.end, column, w.reach));
        if (sum > 0) weight = square / sum;
        if (sum * sum > usual_deposits * square) break;
      }
      double low = 0, high = 1e300;
      int chosen = 0;
      for (int level = 0; level < windows.count(); ++level) {
        const Window& w = windows[level];
        const double sum = lights.around(w.first, w.end, column, w.reach), square = std::max(0.0, all_squares.around(w.first, w.end, column, w.reach));
        const double value = sum / w.sr, error = confidence * std::sqrt(square + weight * weight) / w.sr;
        if (value - error > high || value + error < low) {
          // The one before has the most error that goes unnoticed.
          chosen = std::max(0, chosen - 1);
          break;
        }
        low = std::max(low, value - error);
        high = std::min(high, value + error);
        chosen = level;
        if (sum > 0 && square <= noise * noise * sum * sum) break;
      }
      level_[static_cast<std::size_t>(row) * grid_.row() + static_cast<std::size_t>(column)] = static_cast<float>(chosen);
    }
  });
  even_levels();
  for_each_row(steps + 1, [&](int row) {
    const Windows windows(grid_, band_sr_, row);
    for (int column = 0; column <= steps; ++column) {
      const std::size_t at = static_cast<std::size_t>(row) * grid_.row() + static_cast<std::size_t>(column);
      const int level = static_cast<int>(level_[at]);
      const Window& w = windows[level];
      const double sum = lights.around(w.first, w.end, column, w.reach), square = all_squares.around(w.first, w.end, column, w.reach);
      error_[at] = sum > 0 && square > 0 ? static_cast<float>(std::min(1.0, std::sqrt(square) / sum)) : 1;
    }
  });
}

/// Some windows stop by chance: the median over neighbours leaves no speckles. Then shares of two windows in place of
/// steps from one to the next, but never beyond the median, so that no window grows across an edge.
void MapSmoother::even_levels() {
  const int steps = grid_.steps();
  const auto at = [&](int row, int column) {
    column = std::abs(column);
    if (column > steps) column = 2 * steps - column;
    return static_cast<std::size_t>(std::clamp(row, 0, steps)) * grid_.row() + static_cast<std::size_t>(column);
  };
  std::vector<float> median(level_.size());
  for_each_row(steps + 1, [&](int row) {
    std::array<float, 25> around;
    for (int column = 0; column <= steps; ++column) {
      std::size_t count = 0;
      for (int up = -2; up <= 2; ++up)
        for (int aside = -2; aside <= 2; ++aside) around[count++] = level_[at(row + up, column + aside)];
      std::nth_element(around.begin(), around.begin() + 12, around.end());
      median[at(row, column)] = around[12];
    }
  });
  for_each_row(steps + 1, [&](int row) {
    for (int column = 0; column <= steps; ++column) {
      float sum = 0;
      for (int up = -2; up <= 2; ++up)
        for (int aside = -2; aside <= 2; ++aside) sum += std::min(median[at(row, column)], median[at(row + up, column + aside)]);
      level_[at(row, column)] = sum / 25;
    }
  });
}

void MapSmoother::smooth(std::span<float> light) const {
  const AreaSums sums(grid_, light);
  const int steps = grid_.steps();
  double before = 0, after = 0;
  for (const float l : light) before += l;
  for (int row = 0; row <= steps; ++row) {
    const Windows windows(grid_, band_sr_, row);
    for (int column = 0; column <= steps; ++column) {
      const std::size_t at = static_cast<std::size_t>(row) * grid_.row() + static_cast<std::size_t>(column);
      const int level = static_cast<int>(level_[at]);
      const float share = level_[at] - static_cast<float>(level);
      const Window& w = windows[level];
      double value = sums.around(w.first, w.end, column, w.reach) / w.sr;
      if (share > 0) {
        const Window& v = windows[level + 1];
        value += share * (sums.around(v.first, v.end, column, v.reach) / v.sr - value);
      }
      light[at] = static_cast<float>(std::max(0.0, value));
      after += light[at] * grid_.cell_sr(row) * SkyGrid::images(column, steps);
    }
  }
  const auto factor = static_cast<float>(after > 0 ? before / after : 1);
  for (float& l : light) l *= factor;
}

float MapSmoother::half_width(std::size_t cell) const {
  const auto level = static_cast<std::size_t>(level_[cell]);
  const float share = level_[cell] - static_cast<float>(level);
  const auto low = static_cast<float>(half_widths[level]), high = static_cast<float>(half_widths[std::min(level + 1, half_widths.size() - 1)]);
  return low + share * (high - low);
}

}  // namespace arcus::phase
