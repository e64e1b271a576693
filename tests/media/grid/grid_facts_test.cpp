#include "media/grid/grid_facts.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>

#include "tests/media/grid/vdb_kit.h"

namespace arcus::media {
namespace {

TEST(GridFacts, DescribeEveryGridOfAFile) {
  const std::string folder = kit::folder();
  const auto density = kit::cube("density", 0.5, 10);
  density->setTransform(openvdb::math::Transform::createLinearTransform(2.0));
  density->tree().setValue({1, 2, 3}, 2.5f);
  density->setSaveFloatAsHalf(true);
  density->insertMeta("creator", openvdb::StringMetadata("a test"));
  const auto bad = kit::cube("density", 1);
  bad->tree().setValue({4, 4, 4}, std::nanf(""));
  const auto facts =
      describe_vdb(kit::save(folder + "/test.vdb", {density, kit::cube<openvdb::Vec3SGrid>("velocity", 1), bad}));
  std::filesystem::remove_all(folder);
  ASSERT_EQ(facts.size(), 3u);
  EXPECT_EQ(facts[0].label, "density[0]");
  EXPECT_EQ(facts[0].type, "float");
  EXPECT_TRUE(facts[0].saved_as_half);
  EXPECT_EQ(facts[0].class_words, "fog volume");
  EXPECT_EQ(facts[0].active_voxels, 1000u);
  EXPECT_EQ(facts[0].active_box.low, (Coord{1, 2, 3}));
  EXPECT_EQ(facts[0].active_box.high, (Coord{10, 11, 12}));
  EXPECT_EQ(facts[0].bounds_m.low, Vec3(1, 3, 5));
  EXPECT_EQ(facts[0].bounds_m.high, Vec3(21, 23, 25));
  EXPECT_EQ(facts[0].voxel_m, Vec3(2));
  ASSERT_TRUE(facts[0].values);
  EXPECT_EQ(facts[0].values->smallest, 0.5);
  EXPECT_EQ(facts[0].values->largest, 2.5);
  EXPECT_NEAR(facts[0].values->mean, 0.502, 1e-9);
  ASSERT_TRUE(facts[0].values->depth);
  for (const ValueFacts::Depth& depth : *facts[0].values->depth) {
    EXPECT_NEAR(depth.mean, 10 * 2 * 0.502, 1e-6);
    EXPECT_NEAR(depth.largest, 9 * 2 * 0.5 + 5, 1e-6);
  }
  const auto& metadata = facts[0].metadata;
  EXPECT_NE(std::find(metadata.begin(), metadata.end(), std::pair<std::string, std::string>("creator", "a test")), metadata.end());
  EXPECT_EQ(facts[1].type, "vec3s");
  EXPECT_FALSE(facts[1].values);
  EXPECT_EQ(facts[1].active_voxels, 1728u);
  EXPECT_EQ(facts[2].label, "density[1]");
  EXPECT_EQ(facts[2].values->not_finite, 1u);
  EXPECT_EQ(facts[2].values->largest, 1);
}

}  // namespace
}  // namespace arcus::media
