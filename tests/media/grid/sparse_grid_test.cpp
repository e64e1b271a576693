#include "media/grid/sparse_grid.h"

#include <gtest/gtest.h>

#include "phase/base/error.h"
#include "tests/media/kit.h"
#include "tests/statistics/seed.h"

namespace arcus::media {
namespace {

double wave(int x, int y, int z) { return 1.5 + std::sin(0.7 * x) + 0.4 * std::cos(1.3 * y - z); }

TEST(SparseGrid, GivesBackEveryVoxelAndZeroOutside) {
  const IndexBox box{{-70, 3, -9}, {70, 80, 5}};
  const SparseGrid grid = make_sparse_grid(box, true, [](const Coord& c) {
    return Voxel{static_cast<float>(wave(c.x, c.y, c.z)), static_cast<float>(c.x + 1000)};
  });
  for (int x = -140; x < 140; x += 3)
    for (int y = -66; y < 140; ++y)
      for (int z = -70; z < 70; z += 2) {
        const Voxel voxel = grid.at(x, y, z);
        const bool inside = box.contains({x, y, z});
        EXPECT_EQ(voxel.extinction, inside ? static_cast<float>(wave(x, y, z)) : 0);
        EXPECT_EQ(voxel.size_um, inside ? static_cast<float>(x + 1000) : 0);
      }
  for (const int far : {-2147483647 - 1, 2147483647, 1 << 30}) EXPECT_EQ(grid.at(far, 10, 0).extinction, 0);
  EXPECT_EQ(grid.size_range().smallest, 930);
  EXPECT_EQ(grid.size_range().largest, 1070);
}

TEST(SparseGrid, RangesHoldAllVoxelsAndAreExactWhereAsked) {
  const IndexBox box{{0, 0, 0}, {90, 60, 40}};
  const auto grid = kit::grid(box, wave);
  Random random(statistics::test_seed(), 0, 0);
  const auto number = [&](int low, int high) { return low + static_cast<int>((high - low + 1) * random.uniform_double()); };
  for (int i = 0; i < 300; ++i) {
    const Coord low{number(-5, 90), number(-5, 60), number(-5, 40)};
    const IndexBox part{low, {low.x + number(0, 12), low.y + number(0, 12), low.z + number(0, 12)}};
    float smallest = 1e9f, largest = 0;
    for (int x = part.low.x; x <= part.high.x; ++x)
      for (int y = part.low.y; y <= part.high.y; ++y)
        for (int z = part.low.z; z <= part.high.z; ++z) {
          smallest = std::min(smallest, grid->at(x, y, z).extinction);
          largest = std::max(largest, grid->at(x, y, z).extinction);
        }
    const SparseGrid::Range exact = grid->range(part, true), rough = grid->range(part, false);
    EXPECT_EQ(exact.smallest, smallest);
    EXPECT_EQ(exact.largest, largest);
    EXPECT_LE(rough.smallest, smallest);
    EXPECT_GE(rough.largest, largest);
  }
}

TEST(SparseGrid, RegionsOfOneValueTakeNoRoom) {
  SparseGridBuilder builder({{0, 0, 0}, {4095, 4095, 639}}, false, "test");
  for (int x = 0; x < 4096; x += 64)
    for (int y = 0; y < 4096; y += 64)
      for (int z = 0; z < 576; z += 64) builder.set_constant_block({x, y, z}, {0.25f, 0});
  builder.set_constant_brick({4088, 4088, 632}, {0.5f, 0});
  builder.allocate();
  const SparseGrid grid = builder.finish();
  EXPECT_EQ(grid.at(17, 3000, 575).extinction, 0.25f);
  EXPECT_EQ(grid.at(4095, 4095, 639).extinction, 0.5f);
  EXPECT_LT(grid.memory_bytes(), 1u << 20);
}

TEST(SparseGrid, RefusesBoxesThatNoTableCanHold) {
  EXPECT_THROW(SparseGridBuilder({{0, 0, 0}, {2000000000, 2000000000, 2000000000}}, false, "test"), Error);
  EXPECT_THROW(SparseGridBuilder({{-2000000000, 0, 0}, {2000000000, 10000, 0}}, false, "test"), Error);
}

}  // namespace
}  // namespace arcus::media
