#pragma once
// Land as a grid of heights: two triangles between every four of them, told by their number, so that only the heights are kept.

#include <cstdint>
#include <optional>

#include "media/space/box.h"
#include "phase/base/raster.h"
#include "src/shape/triangle.h"

namespace arcus::render {

/// Where the picture of heights lies: north at its top, each height in the middle of its pixel.
struct TerrainPlace {
  Vec3 centre_m{0, 0, 0};
  double size_x_m = 1, size_y_m = 1;  ///< of the whole picture
  double low_m = 0, high_m = 1;       ///< heights above centre_m of the values 0 and 1
};

class Terrain {
 public:
  /// `heights`: one channel.
  Terrain(Raster heights, const TerrainPlace& place) : heights_(std::move(heights)), place_(place) {}

  /// Corners from west to east and from north to south: the pixels' middles, and around them the picture's edge, as high as the outermost pixels.
  std::uint32_t columns() const { return static_cast<std::uint32_t>(heights_.width) + 2; }
  std::uint32_t rows() const { return static_cast<std::uint32_t>(heights_.height) + 2; }
  Vec3 corner_m(std::uint32_t column, std::uint32_t row) const;

  std::uint32_t triangles() const { return 2 * (columns() - 1) * (rows() - 1); }
  /// Numbers of a triangle's corners: row times columns() plus column. Its front is above.
  struct Corners {
    std::uint32_t a, b, c;
  };
  Corners corners(std::uint32_t triangle) const;
  Triangle triangle(std::uint32_t number) const {
    const Corners at = corners(number);
    return {corner_m(at.a), corner_m(at.b), corner_m(at.c)};
  }
  /// Height of the land at a place; nothing beyond its edges.
  std::optional<double> height_m(double x_m, double y_m) const;
  media::Box bounds_m() const;

 private:
  Vec3 corner_m(std::uint32_t number) const { return corner_m(number % columns(), number / columns()); }

  Raster heights_;
  TerrainPlace place_;
};

}  // namespace arcus::render
