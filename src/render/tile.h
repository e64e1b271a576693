#pragma once
// Rectangles that cut a picture, and lists of them as people type them.
//
// N tiles stand in R rows, R the whole number nearest to sqrt(N height / width) that leaves room for all: row r holds the tiles
// floor(r N / R) up to floor((r + 1) N / R), side by side and equally wide; a row's height goes with the number of its tiles. So tiles
// are nearly square and, but for whole pixels, of equal area, and any N up to the number of pixels will do. They count from 0 in
// reading order.

#include <string>
#include <vector>

#include "src/film/image.h"

namespace arcus::render {

/// Pixels of tile `tile` of `count`; 0 <= tile < count <= width_px * height_px. Never empty.
PixelBox tile_box(int width_px, int height_px, long long count, long long tile);

/// Some tiles of a picture.
struct TileList {
  std::vector<long long> tiles;  ///< ascending, each once
  long long count = 0;           ///< of all tiles
};

/// Reads "K/N", "K,K,.../N" and ranges "A-B" among the K, both ends included. Throws bad_input that names the option.
TileList read_tile_list(const std::string& text, const std::string& option);

/// "2,5,9"
std::string text_of_tiles(const std::vector<long long>& tiles);

}  // namespace arcus::render
