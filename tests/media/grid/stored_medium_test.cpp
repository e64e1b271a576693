#include "media/grid/stored_medium.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "media/grid/new_grid.h"
#include "phase/base/error.h"
#include "tests/media/grid/vdb_kit.h"

namespace arcus::media {
namespace {

using kit::cube;

/// The message of the bad_input that reading throws; a failure where it does not.
std::string refusal(const std::string& path, const std::string& choice = "") {
  try {
    read_media(path, choice);
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::input) << error.what();
    EXPECT_NE(std::string(error.what()).find(path), std::string::npos) << "the file is not named: " << error.what();
    return error.what();
  }
  ADD_FAILURE() << path << " was read";
  return "";
}
testing::AssertionResult says(const std::string& text, const std::vector<std::string>& words) {
  for (const std::string& word : words)
    if (text.find(word) == std::string::npos) return testing::AssertionFailure() << "'" << word << "' is not in: " << text;
  return testing::AssertionSuccess();
}

class StoredMediumTest : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string file(const openvdb::GridPtrVec& grids) { return kit::save(folder_ + "/test.vdb", grids); }
  std::string folder_ = kit::folder();
};

/// Bricks with different values in every voxel; one brick is far away.
NewSpecies species_with_sizes() {
  NewSpecies species{.name = "rain", .recipe = "type = \"rain\"", .phase_id = "00ff", .size_um = 0, .world_from_index = {}, .extinction = {}, .size = {}};
  species.world_from_index = {{0, 2, 0}, {-3, 0, 0}, {0, 0.5, 4}, {100, -200, 1e3}};
  for (const Coord& origin : {Coord{0, 0, 0}, Coord{8, -16, 24}, Coord{-800, 640, 8}}) {
    NewBrick extinction{origin, {}}, size{origin, {}};
    for (std::size_t i = 0; i < 512; ++i) {
      extinction.values[i] = i % 7 ? 1e-3f * static_cast<float>(i + 1) : 0.f;
      size.values[i] = i % 7 ? 100 + static_cast<float>(i) : 0.f;
    }
    species.extinction.push_back(extinction);
    species.size.push_back(size);
  }
  return species;
}

TEST_F(StoredMediumTest, SpeciesSurviveWritingAndReading) {
  const NewSpecies species = species_with_sizes();
  save_grids(folder_ + "/rain.vdb", grids_of(species));
  const StoredMedia stored = read_media(folder_ + "/rain.vdb", "");
  ASSERT_EQ(stored.media.size(), 1u);
  const StoredMedium& rain = stored.media[0];
  EXPECT_TRUE(stored.notes.empty());
  EXPECT_TRUE(rain.is_species);
  EXPECT_EQ(rain.name, "rain");
  EXPECT_EQ(rain.recipe, "type = \"rain\"");
  EXPECT_EQ(rain.phase_id, "00ff");
  EXPECT_EQ(rain.smallest_size_um, 101);
  EXPECT_EQ(rain.largest_size_um, 611 - (511 % 7 == 0));
  for (const Vec3& p : {Vec3(0), Vec3(1, 2, 3)})
    EXPECT_LT(length(rain.world_from_index.point(p) - species.world_from_index.point(p)), 1e-9);
  for (const NewBrick& brick : species.extinction)
    for (int i = 0; i < 512; ++i) {
      const Voxel voxel = rain.grid->at(brick.origin.x + (i >> 6), brick.origin.y + (i >> 3 & 7), brick.origin.z + (i & 7));
      EXPECT_EQ(voxel.extinction, brick.values[static_cast<std::size_t>(i)]);
      EXPECT_EQ(voxel.size_um, voxel.extinction > 0 ? 100 + static_cast<float>(i) : 0);
    }
  // What is read is what would be rendered without a file.
  const SparseGrid direct = sparse_grid_of(species);
  EXPECT_EQ(direct.at(9, -15, 30).extinction, rain.grid->at(9, -15, 30).extinction);
  EXPECT_EQ(direct.range({{0, 0, 0}, {7, 7, 7}}, true).largest, rain.grid->range({{0, 0, 0}, {7, 7, 7}}, true).largest);
}

TEST_F(StoredMediumTest, FilesOpenAsOrdinaryFogVolumes) {
  save_grids(folder_ + "/rain.vdb", grids_of(species_with_sizes()));
  openvdb::io::File file(folder_ + "/rain.vdb");
  file.open();
  const auto grid = openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid("rain.extinction"));
  EXPECT_EQ(grid->getGridClass(), openvdb::GRID_FOG_VOLUME);
  EXPECT_EQ(grid->background(), 0);
  EXPECT_EQ(grid->metaValue<std::int32_t>("arcus_format"), 1);
  EXPECT_EQ(grid->metaValue<std::string>("arcus_phase"), "type = \"rain\"");
  EXPECT_EQ(grid->metaValue<std::string>("arcus_phase_id"), "00ff");
  EXPECT_TRUE(grid->metaValue<std::string>("creator").starts_with("arcus "));
  EXPECT_EQ(grid->activeVoxelCount(), 3u * (512 - 74));
  EXPECT_EQ(grid->tree().getValue({0, 0, 1}), 2e-3f);
  const openvdb::Vec3d at = grid->indexToWorld(openvdb::Vec3d(1, 2, 3));
  EXPECT_NEAR(at.x(), 94, 1e-9);
  EXPECT_NEAR(at.y(), -196.5, 1e-9);
  EXPECT_NEAR(at.z(), 1012, 1e-9);
}

TEST_F(StoredMediumTest, SizeOfAllParticlesComesFromTheMetadata) {
  NewSpecies species = species_with_sizes();
  species.size.clear();
  species.size_um = 12.5f;
  save_grids(folder_ + "/fog.vdb", grids_of(species));
  const StoredMedium medium = read_media(folder_ + "/fog.vdb", "rain").media.at(0);
  EXPECT_EQ(medium.size_um, 12.5f);
  EXPECT_EQ(medium.largest_size_um, 12.5f);
  EXPECT_FALSE(medium.grid->has_size());
}

TEST_F(StoredMediumTest, PlainFloatHalfAndDoubleGridsAreDensities) {
  const auto halves = cube("density", 0.5);
  halves->setSaveFloatAsHalf(true);
  StoredMedia stored = read_media(file({halves}), "");
  EXPECT_FALSE(stored.media.at(0).is_species);
  EXPECT_EQ(stored.media[0].grid->at(1, 2, 3).extinction, 0.5f);
  EXPECT_EQ(stored.media[0].grid->at(12, 13, 14).extinction, 0.5f);
  EXPECT_EQ(stored.media[0].grid->at(13, 13, 14).extinction, 0);
  EXPECT_TRUE(stored.notes.empty());

  stored = read_media(file({cube<openvdb::DoubleGrid>("density", 0.1)}), "");
  EXPECT_EQ(stored.media.at(0).grid->at(5, 5, 5).extinction, 0.1f);
  ASSERT_EQ(stored.notes.size(), 1u);
  EXPECT_TRUE(says(stored.notes[0], {"'density'", "double", "float"}));

  const auto unnamed_class = cube("density", 2);
  unnamed_class->setGridClass(openvdb::GRID_UNKNOWN);
  EXPECT_EQ(read_media(file({unnamed_class}), "").media.at(0).grid->at(5, 5, 5).extinction, 2);
}

TEST_F(StoredMediumTest, TheOnlyFogVolumeIsUsedAndSaidSo) {
  const StoredMedia stored = read_media(file({cube<openvdb::Vec3SGrid>("velocity", 1), cube("smoke", 2)}), "");
  EXPECT_EQ(stored.media.at(0).name, "smoke");
  ASSERT_EQ(stored.notes.size(), 1u);
  EXPECT_TRUE(says(stored.notes[0], {"'smoke'", "only"}));
  EXPECT_EQ(read_media(file({cube("temperature", 1), cube("density", 2)}), "").media.at(0).name, "density");
}

TEST_F(StoredMediumTest, GridsOfOneNameArePickedByOrder) {
  const std::string path = file({cube("density", 1), cube("smoke", 5), cube("density", 2)});
  EXPECT_EQ(read_media(path, "density[0]").media.at(0).grid->at(5, 5, 5).extinction, 1);
  EXPECT_EQ(read_media(path, "density[1]").media.at(0).grid->at(5, 5, 5).extinction, 2);
  EXPECT_EQ(read_media(path, "smoke").media.at(0).grid->at(5, 5, 5).extinction, 5);
  EXPECT_TRUE(says(refusal(path, "density"), {"2 grids", "'density[0]'", "'density[1]'"}));
  EXPECT_TRUE(says(refusal(path, ""), {"'density[0]'", "'density[1]'", "'smoke'"}));
  EXPECT_TRUE(says(refusal(path, "density[2]"), {"no such grid"}));
  EXPECT_TRUE(says(refusal(path, "smokes"), {"Did you mean 'smoke'"}));
}

TEST_F(StoredMediumTest, StrangeNamesCanBeChosen) {
  const std::string path = file({cube("", 1), cube("two\nlines\x1b[31m", 2), cube("ρ of water", 3), cube("heat", 4)});
  EXPECT_TRUE(says(refusal(path), {"'[0]'", "'two?lines?[31m'", "'ρ of water'", "'heat'"}));
  EXPECT_EQ(read_media(path, "[0]").media.at(0).grid->at(5, 5, 5).extinction, 1);
  EXPECT_EQ(read_media(path, "two?lines?[31m").media.at(0).grid->at(5, 5, 5).extinction, 2);
  EXPECT_EQ(read_media(path, "two\nlines\x1b[31m").media.at(0).grid->at(5, 5, 5).extinction, 2);
  EXPECT_EQ(read_media(path, "ρ of water").media.at(0).grid->at(5, 5, 5).extinction, 3);
  EXPECT_EQ(refusal(path).find('\x1b'), std::string::npos) << "a name reaches the terminal as it is";
}

TEST_F(StoredMediumTest, TransformsAreReadAsTheyAre) {
  for (const Affine& map : {Affine{{1e6, 0, 0}, {0, 1e6, 0}, {0, 0, 1e6}, {3, 4, 5}}, Affine{{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}},
                            Affine{{1, 0.7, 0}, {0, 1, 0}, {-0.4, 0, 1}, {1e7, 0, 0}}, Affine{{0, 0, 2}, {3, 0, 0}, {0, 4, 0}, {0, 0, 0}},
                            Affine{{2e-5, 0, 0}, {0, 2e-5, 0}, {0, 0, 2e-5}, {0, 0, 0}}, Affine{{100, 0, 0}, {0, 100, 0}, {0, 0, 1e-3}, {0, 0, 0}}}) {
    const auto grid = cube("density", 1);
    openvdb::math::Mat4d matrix = openvdb::math::Mat4d::identity();
    const Vec3 rows[] = {map.x, map.y, map.z, map.origin};
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 3; ++j) matrix(i, j) = rows[i][j];
    grid->setTransform(openvdb::math::Transform::createLinearTransform(matrix));
    const Affine found = read_media(file({grid}), "").media.at(0).world_from_index;
    for (const Vec3& p : {Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)})
      EXPECT_LT(length(found.point(p) - map.point(p)), 1e-12 * (1 + length(map.point(p)))) << map.x.x;
  }
}

TEST_F(StoredMediumTest, OtherTypesAreRefusedNamingWhatWouldDo) {
  openvdb::initialize();
  const auto sphere = cube("surface", 1);
  sphere->setGridClass(openvdb::GRID_LEVEL_SET);
  const auto points = openvdb::GridBase::createGrid("Tree_ptdataidx32_5_4_3");
  points->setName("drops");
  const auto velocity = cube<openvdb::Vec3SGrid>("velocity", 1);
  velocity->setGridClass(openvdb::GRID_STAGGERED);
  const auto frustum = cube("view", 1);
  frustum->setTransform(openvdb::math::Transform::createFrustumTransform(openvdb::BBoxd({0, 0, 0}, {10, 10, 10}), 0.5, 10));
  const std::string path = file({sphere, points, velocity, cube<openvdb::BoolGrid>("mask", 1), cube<openvdb::Int32Grid>("id", 1),
                                 cube("density", 1), frustum});
  EXPECT_TRUE(says(refusal(path, "surface"), {"'surface'", "float", "level set", "'density'"}));
  EXPECT_TRUE(says(refusal(path, "drops"), {"'drops'", "points", "'density'"}));
  EXPECT_TRUE(says(refusal(path, "velocity"), {"'velocity'", "vec3s", "staggered", "'density'"}));
  EXPECT_TRUE(says(refusal(path, "mask"), {"'mask'", "bool", "fog volume", "'density'"}));
  EXPECT_TRUE(says(refusal(path, "id"), {"'id'", "int32", "'density'"}));
  EXPECT_TRUE(says(refusal(path, "view"), {"'view'", "frustum"}));
  EXPECT_TRUE(says(refusal(path, "nothing"), {"'nothing'", "no such grid", "'mask' (bool", "'density'"}));
  EXPECT_EQ(read_media(path, "").media.at(0).name, "density");
}

TEST_F(StoredMediumTest, ReferencesToAnotherGridsTreeAreFollowed) {
  const auto one = cube("density", 3);
  const openvdb::FloatGrid::Ptr other = one->copy();  // shares the tree
  other->setName("again");
  other->setTransform(openvdb::math::Transform::createLinearTransform(0.5));
  const std::string path = file({one, other});
  const StoredMedium medium = read_media(path, "again").media.at(0);
  EXPECT_EQ(medium.grid->at(5, 5, 5).extinction, 3);
  EXPECT_EQ(medium.world_from_index.x.x, 0.5);
}

TEST_F(StoredMediumTest, EmptinessIsSaid) {
  openvdb::initialize();
  EXPECT_TRUE(says(refusal(file({})), {"no grid"}));
  const auto empty = openvdb::FloatGrid::create();
  empty->setName("density");
  EXPECT_TRUE(says(refusal(file({empty})), {"'density'", "no active voxel"}));
  const auto inactive = cube("density", 1);
  for (auto value = inactive->beginValueOn(); value; ++value) value.setActiveState(false);
  EXPECT_TRUE(says(refusal(file({inactive})), {"'density'", "no active voxel"}));
  const StoredMedia zeros = read_media(file({cube("density", 0)}), "");
  ASSERT_EQ(zeros.notes.size(), 1u);
  EXPECT_TRUE(says(zeros.notes[0], {"'density'", "0 everywhere"}));
  EXPECT_TRUE(zeros.media.at(0).grid->voxels().is_empty());
}

TEST_F(StoredMediumTest, ValuesThatMeanNothingAreNamedWithTheirVoxel) {
  for (const float value : {std::nanf(""), -1.f, std::numeric_limits<float>::infinity()}) {
    const auto grid = cube("density", 1);
    grid->tree().setValue({9, 9, 9}, value);
    grid->tree().setValue({4, 50, 60}, value);
    const std::string word = std::isnan(value) ? "NaN" : value < 0 ? "-1" : "infinity";
    EXPECT_TRUE(says(refusal(file({grid})), {"'density'", word, "(4, 50, 60)"}));
  }
  const auto huge = cube<openvdb::DoubleGrid>("density", 1);
  huge->tree().setValue({9, 9, 9}, 1e60);
  EXPECT_TRUE(says(refusal(file({huge})), {"'density'", "1e+60", "(9, 9, 9)"}));
  const auto inactive = cube("density", 1);
  inactive->tree().setValueOff({9, 9, 9}, -5);  // not active: counts as nothing
  EXPECT_EQ(read_media(file({inactive}), "").media.at(0).grid->at(9, 9, 9).extinction, 0);
  const auto tile = cube("density", 1);
  tile->tree().addTile(1, {64, 64, 64}, -2.f, true);
  EXPECT_TRUE(says(refusal(file({tile})), {"-2", "(64, 64, 64)"}));
}

TEST_F(StoredMediumTest, BackgroundsOtherThanZeroAreRefused) {
  const auto grid = openvdb::FloatGrid::create(0.25f);
  grid->setName("density");
  grid->tree().setValue({1, 1, 1}, 1.f);
  EXPECT_TRUE(says(refusal(file({grid})), {"'density'", "background", "0.25"}));
}

TEST_F(StoredMediumTest, SpeciesThatContradictThemselvesAreRefused) {
  const auto with = [&](const auto& change) {
    auto grids = grids_of(species_with_sizes());
    change(grids);
    save_grids(folder_ + "/rain.vdb", grids);
    return refusal(folder_ + "/rain.vdb");
  };
  EXPECT_TRUE(says(with([](auto& g) { g[1].bricks.pop_back(); }), {"'rain.extinction'", "0 at voxel (-800, 640, 9)", "size"}));
  EXPECT_TRUE(says(with([](auto& g) { g[1].bricks[0].values[5] = -3; }), {"-3 at voxel (0, 0, 5)", "size"}));
  EXPECT_TRUE(says(with([](auto& g) { g[1].world_from_index.x.y = 2.1; }), {"'rain.size'", "transform"}));
  EXPECT_TRUE(says(with([](auto& g) { g[0].metadata[0].second = std::int32_t{2}; }), {"arcus_format = 2"}));
  EXPECT_TRUE(says(with([](auto& g) { g[0].metadata[1].second = std::string(); }), {"arcus_phase"}));
}

TEST_F(StoredMediumTest, HugeTilesStayCompact) {
  const auto grid = cube("density", 1);
  grid->tree().addTile(3, {4096, 0, 0}, 2.f, true);    // 4096³ voxels
  grid->tree().addTile(2, {0, 256, 0}, 3.f, true);     // 128³
  grid->tree().addTile(1, {-64, -64, -64}, 4.f, true); // 8³
  const StoredMedium medium = read_media(file({grid}), "").media.at(0);
  EXPECT_EQ(medium.grid->at(5000, 1, 4095).extinction, 2);
  EXPECT_EQ(medium.grid->at(8191, 4095, 4095).extinction, 2);
  EXPECT_EQ(medium.grid->at(8192, 4095, 4095).extinction, 0);
  EXPECT_EQ(medium.grid->at(127, 383, 127).extinction, 3);
  EXPECT_EQ(medium.grid->at(127, 384, 127).extinction, 0);
  EXPECT_EQ(medium.grid->at(-57, -57, -57).extinction, 4);
  EXPECT_EQ(medium.grid->at(-56, -57, -57).extinction, 0);
  EXPECT_LT(medium.grid->memory_bytes(), std::size_t{20} << 20);
  const auto vast = cube("density", 1);
  vast->tree().setValue({2000000000, -2000000000, 2000000000}, 1.f);
  EXPECT_TRUE(says(refusal(file({vast})), {"'density'", "voxels", "at most"}));
}

TEST_F(StoredMediumTest, TilesTakeSizesFromTheSizeGrid) {
  save_grids(folder_ + "/rain.vdb", grids_of(species_with_sizes()));
  openvdb::io::File in(folder_ + "/rain.vdb");
  in.open();
  const auto extinction = openvdb::gridPtrCast<openvdb::FloatGrid>(in.readGrid("rain.extinction"));
  const auto size = openvdb::gridPtrCast<openvdb::FloatGrid>(in.readGrid("rain.size"));
  extinction->tree().addTile(2, {128, 128, 128}, 0.5f, true);
  size->tree().addTile(2, {128, 128, 128}, 70.f, true);
  size->tree().setValue({200, 201, 202}, 80.f);
  const StoredMedium medium = read_media(file({extinction, size}), "").media.at(0);
  EXPECT_EQ(medium.grid->at(128, 128, 128).size_um, 70);
  EXPECT_EQ(medium.grid->at(200, 201, 202).size_um, 80);
  EXPECT_EQ(medium.grid->at(200, 201, 203).size_um, 70);
  EXPECT_EQ(medium.grid->at(255, 255, 255).extinction, 0.5f);
}

TEST_F(StoredMediumTest, FilesThatAreNotVdbAreRefused) {
  const std::string path = folder_ + "/test.vdb";
  EXPECT_TRUE(says(refusal(path), {"No such file"}));
  for (const std::string& content : {std::string(), std::string("x"), std::string("hello, this is no volume at all")}) {
    std::ofstream(path, std::ios::binary) << content;
    EXPECT_TRUE(says(refusal(path), {"something else than an OpenVDB file"}));
  }
  refusal(folder_);
}

TEST_F(StoredMediumTest, TruncatedFilesAreRefusedWhereverTheyEnd) {
  save_grids(folder_ + "/rain.vdb", grids_of(species_with_sizes()));
  const std::string cut = folder_ + "/cut.vdb";
  const auto half = cube("density", 0.3, 20);
  half->setSaveFloatAsHalf(true);
  for (const std::string& whole : {folder_ + "/rain.vdb", file({half, cube<openvdb::Vec3SGrid>("velocity", 1)})}) {
    std::ifstream in(whole, std::ios::binary);
    const std::string content{std::istreambuf_iterator<char>(in), {}};
    // Every length near the front, where the table of contents is, then one in seven.
    for (std::size_t length = 0; length < content.size(); length += length < 600 ? 1 : 7) {
      std::filesystem::remove(cut);  // writing over a file makes some file systems wait for the disk
      std::ofstream(cut, std::ios::binary).write(content.data(), static_cast<std::streamsize>(length));
      refusal(cut);
    }
  }
}

}  // namespace
}  // namespace arcus::media
