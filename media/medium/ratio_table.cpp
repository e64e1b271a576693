#include "media/medium/ratio_table.h"

#include <cmath>

#include "phase/species/species.h"

namespace arcus::media {
namespace {

constexpr int rows_per_octave = 16;
constexpr std::int32_t octave_bits = 1 << 23;  // a float's mantissa has 23 bits

}  // namespace

RatioTable::RatioTable(const phase::Species& species, float smallest_um, float largest_um) {
  smallest_um = std::max(smallest_um, 1e-6f);
  largest_um = std::max(largest_um, smallest_um);
  first_bits_ = std::bit_cast<std::int32_t>(smallest_um);
  const std::int32_t range = std::bit_cast<std::int32_t>(largest_um) - first_bits_;
  if (range > 0) {
    row_count_ = 2 + static_cast<int>(static_cast<std::int64_t>(range) * rows_per_octave / octave_bits);
    rows_per_bit_ = static_cast<float>(row_count_ - 1) / static_cast<float>(range);
    last_row_ = std::nextafter(static_cast<float>(row_count_ - 1), 0.f);
  }
  is_directed_ = species.is_oriented();
  const int blocks = is_directed_ ? direction_nodes + 1 : 1;
  values_.resize(static_cast<std::size_t>(blocks * row_count_) * (column_count + 1));
  for (int block = 0; block < blocks; ++block)
    for (int r = 0; r < row_count_; ++r) {
      const double share = row_count_ > 1 ? static_cast<double>(r) / (row_count_ - 1) : 0;
      const float size_um =
          std::bit_cast<float>(first_bits_ + static_cast<std::int32_t>(std::lround(share * static_cast<double>(range))));
      float* row = values_.data() + static_cast<std::size_t>(block * row_count_ + r) * (column_count + 1);
      for (int c = 0; c < column_count; c += wavelength_count) {
        Wavelengths wavelengths;
        for (int i = 0; i < wavelength_count; ++i)
          wavelengths.nm[static_cast<std::size_t>(i)] =
              static_cast<float>(shortest_wavelength_nm) + column_nm * static_cast<float>(std::min(c + i, column_count - 1));
        const Spectrum ratios = is_directed_ && block < direction_nodes
                                    ? species.directed_extinction_ratio(size_um, block, wavelengths)
                                    : species.extinction_ratio(size_um, wavelengths);
        for (int i = 0; i < wavelength_count && c + i < column_count; ++i) row[c + i] = ratios[i];
      }
      row[column_count] = row[column_count - 1];
    }
}

}  // namespace arcus::media
