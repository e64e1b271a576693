#include "src/render/tile.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "phase/base/error.h"

namespace arcus::render {
namespace {

struct Size {
  int width, height;
};

}  // namespace

TEST(TileBox, TilesCoverEveryPixelOnce) {
  for (const Size size : {Size{1, 1}, {1, 17}, {17, 1}, {2, 2}, {3, 5}, {13, 11}, {48, 32}, {37, 101}}) {
    const long long pixels = static_cast<long long>(size.width) * size.height;
    for (long long count = 1; count <= pixels; ++count) {
      std::vector<int> times(static_cast<std::size_t>(pixels));
      for (long long tile = 0; tile < count; ++tile) {
        const PixelBox box = tile_box(size.width, size.height, count, tile);
        ASSERT_TRUE(0 <= box.x0 && box.x0 < box.x1 && box.x1 <= size.width && 0 <= box.y0 && box.y0 < box.y1 && box.y1 <= size.height)
            << size.width << " x " << size.height << ", tile " << tile << " of " << count;
        for (int y = box.y0; y < box.y1; ++y)
          for (int x = box.x0; x < box.x1; ++x) ++times[static_cast<std::size_t>(y * size.width + x)];
      }
      ASSERT_TRUE(std::all_of(times.begin(), times.end(), [](int n) { return n == 1; })) << size.width << " x " << size.height << " in " << count;
    }
  }
}

TEST(TileBox, TilesOfLargePicturesAreNearlySquareAndOfEqualArea) {
  for (const long long count : {2, 3, 7, 64, 97, 1000, 9973, 10000}) {
    const double mean = 7680.0 * 4320.0 / static_cast<double>(count);
    double covered = 0;
    for (long long tile = 0; tile < count; ++tile) {
      const PixelBox box = tile_box(7680, 4320, count, tile);
      const auto area = static_cast<double>(box.pixels());
      covered += area;
      EXPECT_NEAR(area / mean, 1, 0.04) << tile << " of " << count;
      const double shape = static_cast<double>(box.width()) / box.height();
      EXPECT_LT(std::max(shape, 1 / shape), 2.3) << tile << " of " << count;
    }
    EXPECT_EQ(covered, 7680.0 * 4320.0);
  }
}

TEST(TileList, NumbersAndRangesAreReadInOrderAndOnce) {
  const TileList list = read_tile_list("7,0-3,2,63/64", "--tiles");
  EXPECT_EQ(list.tiles, (std::vector<long long>{0, 1, 2, 3, 7, 63}));
  EXPECT_EQ(list.count, 64);
  EXPECT_EQ(text_of_tiles(list.tiles), "0,1,2,3,7,63");
  EXPECT_EQ(read_tile_list("0/1", "--tiles").tiles, std::vector<long long>{0});
}

TEST(TileList, WrongListsAreRefused) {
  for (const char* text : {"", "/", "3", "3/", "/4", "4/4", "0/0", "-1/4", "1-/4", "3-1/4", "1,/4", ",1/4", "1;2/4", "1/4x", "1/-4", "x/4", "0-9/4",
                           "99999999999999999999/4", "0.5/4"})
    EXPECT_THROW(read_tile_list(text, "--tiles"), Error) << text;
}

}  // namespace arcus::render
