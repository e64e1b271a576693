#include "phase/base/netcdf_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "phase/base/error.h"
#include "phase/base/whole_file.h"
#include "tests/phase/base/netcdf_kit.h"
#include "tests/phase/species/scratch_folder.h"

namespace arcus {
namespace {

class NetcdfFileTest : public testing::Test {
 protected:
  /// A file with a record dimension of three, fixed variables before and after it, and one of odd length.
  std::string write(int mode) {
    const std::string path = scratch_.path("file.nc");
    kit::NewNetcdf file(path, mode);
    file.records = 3;
    file.dimension("time", NC_UNLIMITED);
    file.dimension("x", 5);
    file.variable("x", {"x"}, {1, 2, 3, 4, 5}, {{"units", "km"}});
    file.variable("a", {"time", "x"}, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15});
    const int packed = file.variable("packed", {"time", "x"}, {0, 1, 2, -99, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14}, {}, NC_SHORT);
    file.number(packed, "scale_factor", 0.5);
    file.number(packed, "add_offset", 100);
    file.number(packed, "missing_value", -99, NC_SHORT);
    file.text("title", "a test");
    return path;
  }
  std::string refusal(const std::string& path) {
    try {
      const NetcdfFile file(path);
      for (const auto& variable : file.variables()) file.read<float>(variable);
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::input);
      EXPECT_NE(std::string(error.what()).find(path), std::string::npos) << error.what();
      return error.what();
    }
    return "";
  }
  phase::ScratchFolder scratch_;
};

TEST_F(NetcdfFileTest, EveryFormatReadsAlike) {
  for (const int mode : {0, NC_64BIT_OFFSET, NC_64BIT_DATA, NC_NETCDF4, NC_NETCDF4 | NC_CLASSIC_MODEL}) {
    const NetcdfFile file(write(mode));
    ASSERT_EQ(file.variables().size(), 3u);
    const auto& a = file.get("a", "key");
    EXPECT_EQ(file.dimensions()[a.dimensions[0]].length, 3u);
    EXPECT_EQ(file.read<float>(a).at(14), 15);
    const std::size_t start[] = {1, 2}, count[] = {1, 3};
    EXPECT_EQ(file.read<double>(a, start, count), (std::vector<double>{8, 9, 10}));
    EXPECT_EQ(file.text(file.find("x"), "units"), "km");
    EXPECT_EQ(file.text(nullptr, "title"), "a test");
    EXPECT_FALSE(file.text(nullptr, "none"));
    const auto packed = file.read<float>(file.get("packed", "key"));
    EXPECT_EQ(packed[1], 100.5f);
    EXPECT_TRUE(std::isnan(packed[3])) << "a missing value is no number";
  }
}

TEST_F(NetcdfFileTest, UnknownVariablesAreNamedBesideTheNearest) {
  const NetcdfFile file(write(0));
  try {
    file.get("pakced", "water");
    FAIL();
  } catch (const Error& error) {
    for (const char* words : {"'pakced' (water)", "Did you mean 'packed'", "'a' (time, x)"})
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

TEST_F(NetcdfFileTest, ClassicHeadersTellTheLengthOfTheFile) {
  for (const int mode : {0, NC_64BIT_OFFSET, NC_64BIT_DATA}) {
    const std::string path = write(mode);
    std::ifstream in(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    const auto size = classic_netcdf_size(bytes);
    ASSERT_TRUE(size);
    EXPECT_LE(*size, bytes.size());
    EXPECT_LT(bytes.size() - *size, 4u) << "all but the padding";
    EXPECT_FALSE(classic_netcdf_size(bytes.substr(0, 60)));
  }
  EXPECT_EQ(classic_netcdf_size("\x89HDF"), 0u);
}

TEST_F(NetcdfFileTest, TruncatedFilesAreRefusedWhereverTheyEnd) {
  for (const int mode : {0, NC_64BIT_OFFSET, NC_64BIT_DATA, NC_NETCDF4}) {
    const std::string path = write(mode), cut = scratch_.path("cut.nc");
    std::ifstream in(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    const std::size_t whole = classic_netcdf_size(bytes).value();
    const std::size_t end = whole == 0 ? bytes.size() : whole;
    for (std::size_t length = 0; length < end; length += 1 + end / 150) {
      std::filesystem::remove(cut);
      write_whole_file(cut, bytes.substr(0, length));
      EXPECT_NE(refusal(cut), "") << "format " << mode << " cut to " << length << " of " << bytes.size();
    }
    EXPECT_EQ(refusal(path), "");
  }
  EXPECT_NE(refusal(scratch_.path("none.nc")), "");
  EXPECT_NE(refusal(scratch_.folder()), "");
}

}  // namespace
}  // namespace arcus
