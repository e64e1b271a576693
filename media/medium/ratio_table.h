#pragma once
// How extinction at a wavelength compares with that at 550 nm, by size and by how steeply the light goes: a species' answer,
// tabulated so that a lookup costs a nanosecond.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "phase/base/spectrum.h"
#include "phase/base/wavelengths.h"
#include "phase/population/sine_nodes.h"

namespace arcus::phase {
class Species;
}

namespace arcus::media {

class RatioTable {
 public:
  /// Where a path's wavelengths and its direction lie in the table.
  struct Columns {
    int first[wavelength_count];
    Spectrum share;  ///< of the next column
    int direction;          ///< the node below
    float direction_share;  ///< of the one above
  };

  /// The same for all sizes and wavelengths.
  RatioTable() : values_(column_count + 1, 1.f) {}
  /// For sizes from smallest_um to largest_um (beyond: as at the ends); equal ones make a table of one row.
  RatioTable(const phase::Species& species, float smallest_um, float largest_um);

  /// For light whose direction has this sine of elevation.
  static Columns columns(const Wavelengths& wavelengths, double sine_elevation) {
    Columns result = mean_columns(wavelengths);
    const float sine = std::min(static_cast<float>(std::fabs(sine_elevation)), 1.f);
    result.direction = phase::node_below_sine(sine);
    const auto low = static_cast<float>(phase::sine_of_node(result.direction)), high = static_cast<float>(phase::sine_of_node(result.direction + 1));
    result.direction_share = std::clamp((sine - low) / (high - low), 0.f, 1.f);
    return result;
  }
  /// For the mean over all directions.
  static Columns mean_columns(const Wavelengths& wavelengths) {
    Columns result;
    result.direction = direction_nodes;
    result.direction_share = 0;
    for (int i = 0; i < wavelength_count; ++i) {
      const float at = std::clamp((wavelengths[i] - static_cast<float>(shortest_wavelength_nm)) / column_nm, 0.f,
                                  static_cast<float>(column_count - 1));
      result.first[i] = static_cast<int>(at);
      result.share[i] = at - static_cast<float>(result.first[i]);
    }
    return result;
  }

  int row_count() const { return row_count_; }
  /// Position between the rows; its whole part is the row below, at most row_count() − 2 where there are two rows.
  /// The scale is that of a float's bits read as a whole number: logarithmic, with straight lines between powers of two, and cheap.
  float row_of(float size_um) const {
    const float at = static_cast<float>(std::bit_cast<std::int32_t>(size_um) - first_bits_) * rows_per_bit_;
    return std::clamp(at, 0.f, last_row_);
  }
  /// The ratios of one row at the columns' wavelengths.
  Spectrum row(int r, const Columns& columns) const {
    if (!is_directed_) return row_of_block(0, r, columns);
    const Spectrum low = row_of_block(columns.direction, r, columns);
    if (columns.direction_share == 0) return low;
    return low + (row_of_block(columns.direction + 1, r, columns) - low) * columns.direction_share;
  }
  /// The ratios at a size.
  Spectrum at(float size_um, const Columns& columns) const {
    if (row_count_ == 1) return row(0, columns);
    const float place = row_of(size_um);
    const int r = static_cast<int>(place);
    const Spectrum low = row(r, columns);
    return low + (row(r + 1, columns) - low) * (place - static_cast<float>(r));
  }

  float largest() const { return *std::max_element(values_.begin(), values_.end()); }
  float smallest() const { return *std::min_element(values_.begin(), values_.end()); }
  std::size_t memory_bytes() const { return values_.size() * sizeof(float); }

 private:
  Spectrum row_of_block(int block, int r, const Columns& columns) const {
    const float* values = values_.data() + static_cast<std::size_t>(block * row_count_ + r) * (column_count + 1);
    Spectrum low, high;
    for (int i = 0; i < wavelength_count; ++i) {
      low[i] = values[columns.first[i]];
      high[i] = values[columns.first[i] + 1];
    }
    return low + (high - low) * columns.share;
  }
  // λ⁻⁴ between columns 2 nm apart is wrong by less than 1e-4.
  static constexpr float column_nm = 2;
  static constexpr int column_count = static_cast<int>((longest_wavelength_nm - shortest_wavelength_nm) / column_nm) + 1;

  static constexpr int direction_nodes = phase::sine_node_count;  // after them the mean over directions

  int row_count_ = 1;
  bool is_directed_ = false;
  std::int32_t first_bits_ = 0;
  float rows_per_bit_ = 0, last_row_ = 0;
  std::vector<float> values_;  // [direction][row][column], the last column twice
};

}  // namespace arcus::media
