#include "media/author/lwc_file.h"

#include <gtest/gtest.h>

#include "media/author/field.h"
#include "phase/base/error.h"
#include "phase/base/whole_file.h"
#include "tests/phase/species/scratch_folder.h"

namespace arcus::media {
namespace {

class LwcFileTest : public testing::Test {
 protected:
  std::string file(const std::string& text) {
    write_whole_file(scratch_.path("cloud.lwc"), text);
    return scratch_.path("cloud.lwc");
  }
  void refused(const std::string& text, const std::string& words) {
    try {
      read_lwc_file(file(text));
      ADD_FAILURE() << "was read: " << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::input);
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  }
  phase::ScratchFolder scratch_;
};

TEST_F(LwcFileTest, CellsOfTheI3rcModelHaveOneBoundMoreThanLayers) {
  const WaterField field = read_lwc_file(file("2 parameter LWC file\n 3 2 2\n0.05 0.1\n0.5 0.6 0.8\n288 287 286\n1 1 1 0.25 8\n3 2 2 0.5 12.5\n"));
  EXPECT_EQ(field.count, (Coord{3, 2, 2}));
  EXPECT_DOUBLE_EQ(field.step_x_m, 50);
  EXPECT_DOUBLE_EQ(field.first_y_m, 50);
  EXPECT_EQ(field.level_m, (std::vector<double>{500, 600, 800}));
  EXPECT_EQ(field.water_g_per_m3[field.place({0, 0, 0})], 0.25f);
  EXPECT_EQ(field.water_g_per_m3[field.place({2, 1, 1})], 0.5f);
  EXPECT_EQ(field.radius_um[field.place({2, 1, 1})], 12.5f);
  EXPECT_EQ(field.water_g_per_m3[field.place({1, 1, 1})], 0) << "no line: clear";
}

TEST_F(LwcFileTest, PointsOfShdomAreMiddlesOfCells) {
  const WaterField field = read_lwc_file(file("2\n2 1 3\n0.02 0.02\n0.4 0.44\n0.48\n280 280 280\n1 1 1 0.1 5\n2 1 3 0.2 6\n"));
  EXPECT_EQ(field.first_x_m, 0);
  ASSERT_EQ(field.level_m.size(), 4u);
  EXPECT_NEAR(field.level_m[0], 380, 1e-9);
  EXPECT_NEAR(field.level_m[3], 500, 1e-9);
  EXPECT_EQ(field.water_g_per_m3[field.place({1, 0, 2})], 0.2f);
}

TEST_F(LwcFileTest, OneParameterMeansWaterAlone) {
  const std::string path = file("1 parameter LWC file\n1 1 1\n0.02 0.02\n0.4 0.44\n280 280\n1 1 1 0.3\n");
  EXPECT_TRUE(read_lwc_file(path).radius_um.empty());
  // As the I3RC model has it for alpha = 7, that is an effective variance of 0.1: Reff = 100 (LWC 0.75·1.3889/(π N))^(1/3).
  FieldSettings settings;
  settings.file = path;
  settings.droplets.drops_per_cm3 = 100;
  const AuthoredField made = author_field(settings, "");
  EXPECT_NEAR(made.range.largest_size_um, 100 * std::cbrt(0.3 * 0.75 * 1.3889 / (3.14159 * 100)), 1e-3);
  EXPECT_EQ(made.grids.at(0).name, "cloud.extinction");
}

TEST_F(LwcFileTest, CsvOfAt3dHasNoTemperatures) {
  const WaterField field = read_lwc_file(
      file("# a cloud\n2,2,2      # nx,ny,nz\n0.020,0.030     # dx,dy [km, km]\n0.440,0.480   # altitude levels [km]\ni,j,k,lwc,reff\n1,2,2,0.0111,13.314\n"));
  EXPECT_EQ(field.step_y_m, 30);
  EXPECT_EQ(field.radius_um[field.place({0, 1, 1})], 13.314f);
}

TEST_F(LwcFileTest, RefusalsNameTheLine) {
  const std::string head = "2\n2 1 2\n0.02 0.02\n0.4 0.44\n280 280\n";
  refused("", "cloud.lwc");
  refused("hello\n", "'hello'");
  refused("3\n2 1 2\n0.02 0.02\n0.4 0.44\n280 280\n", "several kinds of particles");
  refused("2\n2 1\n", "cut short");
  refused("2\n2 1 2\n0.02 0.02\n0.4 0.44 0.5 0.6\n280 280\n1 1 1 1 1\n", "cloud.lwc:4: 4 heights");
  refused("2\n2 1 2\n0.02 0.02\n0.44 0.4\n280 280\n1 1 1 1 1\n", "ascending");
  refused("2\n2 1 2.5\n", "nz = 2.5");
  refused(head, "no row");
  refused(head + "1 1 1 0.1\n", "five expected");
  refused(head + "1 1 1 0.1 5\n1 1 2 0.1\n", "cloud.lwc:7");
  refused(head + "1 1 1 0.1 5\n3 1 1 0.1 5\n", "ix = 3");
  refused(head + "0 1 1 0.1 5\n", "ix = 0");
  refused(head + "1 1 1 0.1 5\n1 1 1 0.2 5\n", "another line");
  refused(head + "1 1 1 nan 5\n", "'nan'");
}

}  // namespace
}  // namespace arcus::media
