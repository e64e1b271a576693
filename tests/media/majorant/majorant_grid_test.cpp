#include "media/majorant/majorant_grid.h"

#include <gtest/gtest.h>

#include "media/medium/medium.h"
#include "tests/media/kit.h"
#include "tests/statistics/seed.h"

namespace arcus::media {
namespace {

const IndexBox rough_box{{-37, 5, 100}, {60, 90, 170}};

/// Places where extinction exceeds the majorant or undercuts the minorant of its cell, or lies outside all cells.
int violations(const Medium& medium, int points, double reading_error = 0) {
  Random random(statistics::test_seed(), 0, 0);
  const Box box = medium.bounds_m().grown_by(0.1);
  int wrong = 0;
  for (int i = 0; i < points; ++i) {
    const Vec3 p = kit::point_in(box, random);
    const float extinction = medium.extinction_per_m(p, kit::green())[0];
    const MajorantGrid::Cell cell = medium.majorants().at(p);
    wrong += extinction * (1 + reading_error) > cell.majorant_per_m || extinction < cell.minorant_per_m;
  }
  return wrong;
}

TEST(MajorantGrid, BoundsLinearAndNearestLookupsUnderEveryTransform) {
  const auto grid = kit::rough_grid(rough_box);
  for (const auto& [name, map] : kit::transforms())
    for (const Interpolation interpolation : {Interpolation::linear, Interpolation::nearest}) {
      std::vector<Component> components{kit::component(grid, map, interpolation)};
      const Medium medium(components);
      EXPECT_EQ(violations(medium, 20000), 0) << name;
      EXPECT_GT(medium.majorants().cells().size(), 0u) << name << ": cells smaller than a block were expected";
    }
}

TEST(MajorantGrid, IsTightSoThatATenthMoreExtinctionBreaksIt) {
  const Medium medium({kit::component(kit::rough_grid(rough_box))});
  EXPECT_GT(violations(medium, 100000, 0.1), 10);
}

TEST(MajorantGrid, BoundsTheSumOfOverlappingMedia) {
  const auto grid = kit::rough_grid(rough_box);
  std::vector<Component> components;
  for (const auto& [name, map] : kit::transforms()) components.push_back(kit::component(grid, map));
  components.push_back(kit::block({{-20, -20, 0}, {30, 40, 120}}, 0.7f));
  const Medium medium(components);
  EXPECT_EQ(violations(medium, 20000), 0);
}

TEST(MajorantGrid, BoundsEverySingleVoxelThatALookupMayDraw) {
  // Voxels alone in emptiness, at the faces, edges and corners of bricks and blocks.
  const auto grid = kit::grid({{-9, -9, -9}, {135, 20, 20}}, [](int x, int y, int z) {
    return (x == 7 || x == 8 || x == 63 || x == 64 || x == 127 || x == -8) && y % 8 == 0 && z % 7 == 0 ? 1.0 : 0.0;
  });
  for (const Interpolation interpolation : {Interpolation::linear, Interpolation::nearest}) {
    const Medium medium({kit::component(grid, {}, interpolation)});
    EXPECT_EQ(violations(medium, 200000), 0);
  }
}

TEST(MajorantGrid, SkipsEmptySpace) {
  // Two small clouds far apart: nearly all of the way between them must be empty.
  const auto grid = kit::grid({{0, 0, 0}, {499, 15, 15}}, [](int x, int, int) { return x < 16 || x > 480 ? 1.0 : 0.0; });
  const Medium medium({kit::component(grid)});
  int empty = 0;
  for (int x = 0; x < 500; ++x) empty += medium.majorants().at(Vec3(x + 0.5, 8, 8)).majorant_per_m == 0;
  EXPECT_GT(empty, 440);
}

TEST(MajorantGrid, IsOneCellForALoneBlock) {
  const Medium medium({kit::block({{0, 0, 0}, {100, 200, 10}}, 0.5f)});
  EXPECT_EQ(medium.majorants().blocks().size(), 1u);
  EXPECT_NEAR(medium.majorants().at(Vec3(50)).majorant_per_m, 0, 1e-12);  // above the block
  EXPECT_NEAR(medium.majorants().at(Vec3(5)).majorant_per_m, 0.5, 1e-5);
  EXPECT_NEAR(medium.majorants().at(Vec3(5)).minorant_per_m, 0.5, 1e-5);
}

TEST(MajorantGrid, StaysBoundedWhenAVastHazeSurroundsASmallCloud) {
  const auto cloud = kit::rough_grid({{0, 0, 0}, {63, 63, 63}});
  const Medium medium({kit::component(cloud), kit::block({{-1e5, -1e5, 0}, {1e5, 1e5, 1e4}}, 1e-5f)});
  EXPECT_LT(medium.majorants().memory_bytes(), std::size_t{300} << 20);
  EXPECT_EQ(violations(medium, 1000), 0);
  // The cloud still has cells of its own size.
  EXPECT_GT(medium.majorants().at(Vec3(32)).majorant_per_m, 0);
}

TEST(MajorantGrid, OfNothingIsEmpty) {
  const Medium medium(std::vector<Component>{});
  EXPECT_TRUE(medium.is_empty());
  EXPECT_EQ(medium.majorants().at(Vec3(0)).majorant_per_m, 0);
}

}  // namespace
}  // namespace arcus::media
