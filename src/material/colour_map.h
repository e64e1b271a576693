#pragma once
// A picture of colours on the ground: laid out on the horizontal plane, north at its top, and repeated without end. Bilinear between the middles of
// its pixels; spectra follow their colours linearly, so it is the same whether colours or spectra are interpolated.

#include <array>
#include <cmath>
#include <memory>

#include "phase/base/raster.h"
#include "phase/base/three_spectra.h"
#include "phase/base/vec3.h"

namespace arcus::render {

/// Where one copy of the picture lies.
struct ColourMapPlace {
  double centre_x_m = 0, centre_y_m = 0;
  double size_x_m = 1, size_y_m = 1;
};

class ColourMap {
 public:
  /// `rgb`: reflectances from 0 to 1. `basis`: what they multiply; their sum is 1.
  ColourMap(Raster rgb, std::shared_ptr<const ThreeSpectra> basis, const ColourMapPlace& place) : rgb_(std::move(rgb)), basis_(std::move(basis)), place_(place) {}

  const ThreeSpectra& basis() const { return *basis_; }
  std::array<float, 3> at(const Vec3& position_m) const {
    // In pixels, from the middle of the one in the north-west.
    const double x = ((position_m.x - place_.centre_x_m) / place_.size_x_m + 0.5) * rgb_.width - 0.5;
    const double y = (0.5 - (position_m.y - place_.centre_y_m) / place_.size_y_m) * rgb_.height - 0.5;
    const double column = std::floor(x), row = std::floor(y);
    const auto across = static_cast<float>(x - column), down = static_cast<float>(y - row);
    const int west = wrapped(column, rgb_.width), east = west + 1 == rgb_.width ? 0 : west + 1;
    const int north = wrapped(row, rgb_.height), south = north + 1 == rgb_.height ? 0 : north + 1;
    const float *nw = rgb_.at(west, north), *ne = rgb_.at(east, north), *sw = rgb_.at(west, south), *se = rgb_.at(east, south);
    std::array<float, 3> result;
    for (std::size_t c = 0; c < 3; ++c) {
      const float upper = nw[c] + (ne[c] - nw[c]) * across, lower = sw[c] + (se[c] - sw[c]) * across;
      result[c] = upper + (lower - upper) * down;
    }
    return result;
  }

 private:
  static int wrapped(double whole, int count) {
    const double rest = whole - std::floor(whole / count) * count;
    return rest < count ? static_cast<int>(rest) : 0;
  }

  Raster rgb_;
  std::shared_ptr<const ThreeSpectra> basis_;
  ColourMapPlace place_;
};

}  // namespace arcus::render
