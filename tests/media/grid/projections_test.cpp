#include "media/grid/projections.h"

#include <gtest/gtest.h>

namespace arcus::media {
namespace {

/// Values x + 10 y + 100 z in a box that crosses bricks and the origin.
SparseGrid ramp() {
  return make_sparse_grid({{-3, 2, 5}, {9, 4, 6}}, false, [](const Coord& c) {
    return Voxel{static_cast<float>(1000 + c.x + 10 * c.y + 100 * c.z), 0};
  });
}

}  // namespace

TEST(Projections, SumColumnsInMetres) {
  const auto [along_x, along_y, along_z] = projections(ramp(), Vec3(2, 3, 4));
  EXPECT_EQ(along_x.width, 3);   // y
  EXPECT_EQ(along_x.height, 2);  // z
  EXPECT_EQ(along_y.width, 13);
  EXPECT_EQ(along_z.height, 3);
  // The first row is the highest: z = 6, at y = 2; x from -3 to 9 sums to 39.
  EXPECT_NEAR(along_x.depth[0], 2 * (13 * (1000 + 20 + 600) + 39), 1e-6);
  // z = 6, x = -3; y = 2, 3, 4.
  EXPECT_NEAR(along_y.depth[0], 3 * (3 * (1000 - 3 + 600) + 90), 1e-6);
  // y = 4, x = -3; z = 5, 6.
  EXPECT_NEAR(along_z.depth[0], 4 * (2 * (1000 - 3 + 40) + 1100), 1e-6);
}

TEST(Projections, OfSeveralGridsAddUp) {
  const SparseGrid first = ramp(), second = make_sparse_grid({{20, 3, 5}, {20, 3, 5}}, false, [](const Coord&) { return Voxel{7, 0}; });
  const auto [along_x, along_y, along_z] = projections({&first, &second}, Vec3(2, 3, 4));
  EXPECT_EQ(along_y.width, 24);
  EXPECT_NEAR(along_y.depth.back(), 3 * 7, 1e-6);  // z = 5, x = 20
  EXPECT_NEAR(along_x.depth[0], 2 * (13 * (1000 + 20 + 600) + 39), 1e-6);
  EXPECT_NEAR(along_z.depth[1 * 24 + 23], 4 * 7, 1e-6);  // y = 3, x = 20
}

TEST(Projections, EveryVoxelIsVisitedOnce) {
  int voxels = 0;
  double sum = 0;
  for_each_voxel(ramp(), [&](const Coord& c, const Voxel& voxel) {
    ++voxels;
    sum += voxel.extinction - (1000 + c.x + 10 * c.y + 100 * c.z);
  });
  EXPECT_EQ(voxels, 13 * 3 * 2);
  EXPECT_EQ(sum, 0);
}

TEST(Projections, OfAnEmptyGridAreEmpty) {
  for (const Projection& p : projections(SparseGrid(), Vec3(1))) EXPECT_TRUE(p.depth.empty());
}

}  // namespace arcus::media
