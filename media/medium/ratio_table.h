#pragma once
// How extinction at a wavelength compares with that at 550 nm, by size: a species' answer, tabulated so that a lookup
// costs a nanosecond.

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "phase/base/spectrum.h"
#include "phase/base/wavelengths.h"

namespace arcus::phase {
class Species;
}

namespace arcus::media {

class RatioTable {
 public:
  /// Where a path's wavelengths lie in the table.
  struct Columns {
    int first[wavelength_count];
    Spectrum share;  ///< of the next column
  };

  /// The same for all sizes and wavelengths.
  RatioTable() : values_(column_count + 1, 1.f) {}
  /// For sizes from smallest_um to largest_um (beyond: as at the ends); equal ones make a table of one row.
  RatioTable(const phase::Species& species, float smallest_um, float largest_um);

  static Columns columns(const Wavelengths& wavelengths) {
    Columns result;
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
    const float* values = values_.data() + static_cast<std::size_t>(r) * (column_count + 1);
    Spectrum low, high;
    for (int i = 0; i < wavelength_count; ++i) {
      low[i] = values[columns.first[i]];
      high[i] = values[columns.first[i] + 1];
    }
    return low + (high - low) * columns.share;
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
  // λ⁻⁴ between columns 2 nm apart is wrong by less than 1e-4.
  static constexpr float column_nm = 2;
  static constexpr int column_count = static_cast<int>((longest_wavelength_nm - shortest_wavelength_nm) / column_nm) + 1;

  int row_count_ = 1;
  std::int32_t first_bits_ = 0;
  float rows_per_bit_ = 0, last_row_ = 0;
  std::vector<float> values_;  // [row][column], the last column twice
};

}  // namespace arcus::media
