#include "media/author/field.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <limits>

#include "phase/base/error.h"
#include "phase/base/whole_file.h"
#include "phase/settings/toml_text.h"

namespace arcus::media {
namespace {

class FieldTest : public testing::Test {
 protected:
  FieldTest() {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = (std::filesystem::temp_directory_path() / ("arcus_field_" + std::string(info->name()) + std::to_string(::getpid()))).string();
    std::filesystem::create_directories(folder_);
  }
  ~FieldTest() override { std::filesystem::remove_all(folder_); }
  template <class Number>
  void write(const std::string& name, const std::vector<Number>& numbers) {
    write_whole_file(folder_ + "/" + name, {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)});
  }
  void write_text(const std::string& name, const std::string& text) { write_whole_file(folder_ + "/" + name, text); }
  std::string refusal(const FieldSettings& settings) {
    try {
      author_field(settings, folder_);
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::input);
      return error.what();
    }
    ADD_FAILURE() << "was read";
    return "";
  }
  std::string folder_;
};

float at(const NewGrid& grid, int x, int y, int z) {
  for (const NewBrick& brick : grid.bricks)
    if (brick.origin == Coord{x & ~7, y & ~7, z & ~7}) return brick.values[static_cast<std::size_t>((x & 7) << 6 | (y & 7) << 3 | (z & 7))];
  return 0;
}

TEST_F(FieldTest, RawNumbersLandWhereTheyBelong) {
  // value = 100 x + 10 y + z on 10 x 3 x 9 voxels
  std::vector<float> z_fastest, x_fastest;
  for (int x = 0; x < 10; ++x)
    for (int y = 0; y < 3; ++y)
      for (int z = 0; z < 9; ++z) z_fastest.push_back(static_cast<float>(100 * x + 10 * y + z));
  for (int z = 0; z < 9; ++z)
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 10; ++x) x_fastest.push_back(static_cast<float>(100 * x + 10 * y + z));
  write("z.raw", z_fastest);
  write("x.raw", std::vector<double>(x_fastest.begin(), x_fastest.end()));
  FieldSettings settings;
  settings.file = "z.raw";
  settings.dimensions = {10, 3, 9};
  settings.first_m = {5, 6, 7};
  settings.voxel_m = {2, 3, 4};
  settings.scale = 0.5;
  const auto grids = author_field(settings, folder_).grids;
  ASSERT_EQ(grids.size(), 1u);
  EXPECT_EQ(grids[0].name, "density");
  EXPECT_TRUE(grids[0].metadata.empty());
  EXPECT_EQ(at(grids[0], 9, 2, 8), 464);
  EXPECT_EQ(at(grids[0], 9, 1, 3), 456.5f);
  EXPECT_EQ(grids[0].world_from_index.point({1, 1, 1}), Vec3(7, 9, 11));
  settings.file = "x.raw";
  settings.order = "x_fastest";
  settings.format = "float64";
  const auto again = author_field(settings, folder_).grids;
  for (int x = 0; x < 10; ++x)
    for (int z = 0; z < 9; ++z) EXPECT_EQ(at(again[0], x, 1, z), at(grids[0], x, 1, z));
}

TEST_F(FieldTest, ColumnsWithPositionsMakeASpecies) {
  write_text("cloud.csv", "# metres, 1/m, um\nx,y,z,extinction,size\n"
                          "0,0,100,0.01,10\n20,0,100,0.02,11\n0,50,150,0.03,12\n60,0,150,0.04,13\n");
  FieldSettings settings;
  settings.file = "cloud.csv";
  settings.name = "cloud";
  settings.has_phase = true;
  settings.phase.type = "hg";
  const auto grids = author_field(settings, folder_).grids;
  ASSERT_EQ(grids.size(), 2u);
  EXPECT_EQ(grids[0].name, "cloud.extinction");
  EXPECT_EQ(grids[1].name, "cloud.size");
  EXPECT_EQ(at(grids[0], 3, 0, 1), 0.04f);
  EXPECT_EQ(at(grids[1], 3, 0, 1), 13);
  EXPECT_EQ(at(grids[0], 1, 0, 0), 0.02f);
  EXPECT_EQ(at(grids[0], 0, 1, 1), 0.03f);
  EXPECT_EQ(at(grids[0], 2, 0, 0), 0) << "positions without a line are empty";
  EXPECT_LT(length(grids[0].world_from_index.point({3, 1, 1}) - Vec3(60, 50, 150)), 1e-9);
}

TEST_F(FieldTest, OneColumnIsADenseList) {
  write_text("list.txt", "1\n2\n3\n4\n5\n6\n");
  FieldSettings settings;
  settings.file = "list.txt";
  settings.dimensions = {1, 2, 3};
  EXPECT_EQ(at(author_field(settings, folder_).grids[0], 0, 1, 2), 6);
}

TEST_F(FieldTest, RefusalsSayWhere) {
  FieldSettings settings;
  settings.file = "none.raw";
  settings.dimensions = {2, 2, 2};
  refusal(settings);
  write("short.raw", std::vector<float>(7, 1.f));
  settings.file = "short.raw";
  EXPECT_NE(refusal(settings).find("28 bytes"), std::string::npos);
  std::vector<float> values(8, 1.f);
  values[5] = std::numeric_limits<float>::quiet_NaN();
  write("nan.raw", values);
  settings.file = "nan.raw";
  EXPECT_NE(refusal(settings).find("voxel (1, 0, 1): NaN"), std::string::npos) << refusal(settings);
  values[5] = -1;
  write("nan.raw", values);
  EXPECT_NE(refusal(settings).find("-1"), std::string::npos);
  write("zero.raw", std::vector<float>(8, 0.f));
  settings.file = "zero.raw";
  refusal(settings);
  write_text("uneven.csv", "0 0 0 1\n0 0 1 1\n0 0 2.5 1\n0 0 4 1\n");
  settings.file = "uneven.csv";
  EXPECT_NE(refusal(settings).find("column z"), std::string::npos);
  write_text("twice.csv", "0 0 0 1\n0 0 1 1\n0 0 1 2\n");
  settings.file = "twice.csv";
  EXPECT_NE(refusal(settings).find("two lines"), std::string::npos);
  settings.dimensions = {2, 2};
  settings.file = "nan.raw";
  refusal(settings);
}

}  // namespace
}  // namespace arcus::media
