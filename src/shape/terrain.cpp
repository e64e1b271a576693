#include "src/shape/terrain.h"

#include <algorithm>
#include <cmath>

namespace arcus::render {
namespace {

/// Where a corner is along an edge of so many pixels, 0 to 1.
double share(std::uint32_t corner, int pixels) {
  return std::clamp((static_cast<double>(corner) - 0.5) / pixels, 0.0, 1.0);
}

/// The corner at or before a place along the edge, with a next one after it.
std::uint32_t corner_before(double share, int pixels) {
  return static_cast<std::uint32_t>(std::clamp(std::floor(share * pixels + 0.5), 0.0, static_cast<double>(pixels)));
}

}  // namespace

Vec3 Terrain::corner_m(std::uint32_t column, std::uint32_t row) const {
  const int x = std::clamp(static_cast<int>(column) - 1, 0, heights_.width - 1), y = std::clamp(static_cast<int>(row) - 1, 0, heights_.height - 1);
  const double value = static_cast<double>(heights_.at(x, y)[0]);
  return place_.centre_m + Vec3((share(column, heights_.width) - 0.5) * place_.size_x_m, (0.5 - share(row, heights_.height)) * place_.size_y_m,
                                place_.low_m + value * (place_.high_m - place_.low_m));
}

Terrain::Corners Terrain::corners(std::uint32_t triangle) const {
  const std::uint32_t cell = triangle / 2, north_west = cell / (columns() - 1) * columns() + cell % (columns() - 1), south_west = north_west + columns();
  if (triangle % 2 == 0) return {south_west, south_west + 1, north_west + 1};
  return {south_west, north_west + 1, north_west};
}

std::optional<double> Terrain::height_m(double x_m, double y_m) const {
  const double x = (x_m - place_.centre_m.x) / place_.size_x_m + 0.5, y = 0.5 - (y_m - place_.centre_m.y) / place_.size_y_m;
  if (!(x >= 0 && x <= 1 && y >= 0 && y <= 1)) return std::nullopt;
  const std::uint32_t column = corner_before(x, heights_.width), row = corner_before(y, heights_.height);
  const Vec3 north_west = corner_m(column, row), north_east = corner_m(column + 1, row), south_west = corner_m(column, row + 1), south_east = corner_m(column + 1, row + 1);
  const double east = (x_m - north_west.x) / (north_east.x - north_west.x), south = (y_m - north_west.y) / (south_west.y - north_west.y);
  // The diagonal leads from the south-west to the north-east.
  if (east + south > 1) return south_east.z + (south_west.z - south_east.z) * (1 - east) + (north_east.z - south_east.z) * (1 - south);
  return north_west.z + (north_east.z - north_west.z) * east + (south_west.z - north_west.z) * south;
}

media::Box Terrain::bounds_m() const {
  const auto [least, most] = std::minmax_element(heights_.values.begin(), heights_.values.end());
  media::Box box;
  for (const float value : {*least, *most})
    for (const double side : {-0.5, 0.5})
      box.include(place_.centre_m + Vec3(side * place_.size_x_m, side * place_.size_y_m, place_.low_m + static_cast<double>(value) * (place_.high_m - place_.low_m)));
  return box;
}

}  // namespace arcus::render
