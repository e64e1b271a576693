#pragma once
// Values on a rectangle of pixels, as a file has them: what pictures of the sky, of colours and of heights are before anybody uses them.

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace arcus {

struct Raster {
  int width = 0, height = 0;
  int channels = 1;           ///< 1, or 3: R, G, B
  std::vector<float> values;  ///< [row from the top][column from the left][channel]

  std::size_t pixels() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
  const float* at(int column, int row) const {
    return &values[(static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column)) * static_cast<std::size_t>(channels)];
  }
};

/// Reads such a file for those who know no files of pictures; `where` begins the messages.
using RasterReader = std::function<Raster(const std::string& path, const std::string& where)>;

}  // namespace arcus
