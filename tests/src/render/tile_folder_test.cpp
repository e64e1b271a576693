#include "src/render/tile_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "phase/base/error.h"
#include "src/film/film_file.h"
#include "src/film/image_file.h"
#include "src/render/merge.h"
#include "src/render/picture.h"
#include "src/render/render_tile.h"
#include "src/render/tile.h"
#include "tests/src/render/small_scene.h"

namespace arcus::render {
namespace {

std::string content(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

/// A folder of tiles, and one for the picture, that are gone after the test.
class Tiles : public testing::Test {
 protected:
  Tiles() {
    settings_.film.channels = {"rgb", "variance", "spectral"};
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    std::filesystem::remove_all(output_);
    std::filesystem::create_directories(output_);
  }
  ~Tiles() override {
    std::filesystem::remove_all(folder_);
    std::filesystem::remove_all(output_);
  }

  RunResult make(const TileJob& job, long long tile, const RunOptions& options = {}) {
    const Scene scene = small_scene(settings_);
    return render_tile(settings_, scene, *prepare_integrator(scene, settings_.render, options), job, folder_, tile, options, [](std::string_view) {});
  }
  TileJob make_all(long long count) {
    const TileJob job = tile_job(settings_, count);
    write_record(folder_, job);
    for (long long tile = 0; tile < count; ++tile) make(job, tile);
    return job;
  }
  Picture whole() { return render_picture(settings_, small_scene(settings_), {}, {}); }
  Merge merge(const MergeOptions& options = {}) { return merge_tiles(folder_, exr_, png_, options); }
  bool has_no_output() const { return std::filesystem::is_empty(output_); }
  /// The merged files have the bytes that the picture would be written with, but for the seconds that it took.
  void expect_merged(Picture expected) {
    const double seconds = *read_exr(exr_).metadata.number("arcus:render_seconds");
    expected.image.metadata.set("arcus:render_seconds", seconds);
    write_exr(output_ + "/expected.exr", expected.image);
    EXPECT_EQ(content(exr_), content(output_ + "/expected.exr"));
    EXPECT_EQ(content(png_), png_bytes(tone_mapped(expected.image, expected.tone)));
  }

  SceneSettings settings_ = small_settings();
  std::string folder_ = testing::TempDir() + "arcus_tiles_" + testing::UnitTest::GetInstance()->current_test_info()->name();
  std::string output_ = folder_ + "_merged", exr_ = output_ + "/picture.exr", png_ = output_ + "/picture.png";
};

void replace(const std::string& path, const std::string& content) { std::ofstream(path, std::ios::binary) << content; }

/// Exit code of what is thrown; 0 where nothing is.
template <class Work>
int fault_of(const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    return static_cast<int>(error.fault());
  }
  return 0;
}

constexpr int mismatch = static_cast<int>(Fault::mismatch), incomplete = static_cast<int>(Fault::incomplete);

}  // namespace

TEST_F(Tiles, AnyNumberOfThemGivesTheBitsOfOneProcess) {
  const Picture one = whole();
  for (const long long count : {1, 7, 64}) {
    SCOPED_TRACE(std::to_string(count) + " tiles");
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    make_all(count);
    EXPECT_TRUE(merge().is_complete);
    expect_merged(one);
    const Image image = read_exr(exr_);
    EXPECT_EQ(image.channel_names().size(), one.image.channel_names().size());
    EXPECT_EQ(image.value(36, 20, 0), one.image.value(36, 20, 0));
  }
}

TEST_F(Tiles, StoppedOftenTheyHaveTheSameBits) {
  settings_.render.samples_per_pixel = 60;
  const TileJob job = tile_job(settings_, 2);
  int runs = 0;
  for (const long long tile : {0, 1})
    while (!make(job, tile, {.threads = 1 + runs % 3, .time_limit_s = 0.02, .checkpoint_s = 0.005}).is_complete && ++runs < 1000)
      EXPECT_EQ(inspect_tile(folder_, job, tile, true).state, TileState::partial);
  EXPECT_GE(runs, 2);
  merge();
  expect_merged(whole());
}

TEST_F(Tiles, AFileCutAnywhereIsDamaged) {
  const TileJob job = make_all(7);
  const std::string path = tile_path(folder_, 7, 3), good = content(path);
  ASSERT_EQ(inspect_tile(folder_, job, 3, true).state, TileState::done);
  for (std::size_t length = 0; length < good.size(); length += length < 64 || length + 16 > good.size() ? 1 : 97) {
    replace(path, good.substr(0, length));
    ASSERT_EQ(inspect_tile(folder_, job, 3, false).state, TileState::damaged) << "at " << length << " of " << good.size();
  }
  replace(path, good + "x");
  EXPECT_EQ(inspect_tile(folder_, job, 3, false).state, TileState::damaged);
  EXPECT_EQ(fault_of([&] { merge(); }), incomplete);
}

TEST_F(Tiles, OneFlippedBitIsFound) {
  const TileJob job = make_all(7);
  const std::string path = tile_path(folder_, 7, 3), good = content(path);
  for (std::size_t byte = 0; byte < good.size(); byte += byte < 200 ? 1 : 61) {
    std::string bad = good;
    bad[byte] = static_cast<char>(bad[byte] ^ (1 << byte % 8));
    replace(path, bad);
    ASSERT_EQ(inspect_tile(folder_, job, 3, true).state, TileState::damaged) << "in byte " << byte;
  }
}

TEST_F(Tiles, TilesOfAnotherSceneSeedOrCutAreForeign) {
  const TileJob job = make_all(2);
  const auto state_under = [&](const TileJob& other) { return inspect_tile(folder_, other, 1, true); };
  SceneSettings other = settings_;
  other.render.seed = 2;
  EXPECT_EQ(state_under(tile_job(other, 2)).state, TileState::foreign);
  EXPECT_NE(state_under(tile_job(other, 2)).why.find("the seed is 1 there and 2 here"), std::string::npos);
  other = settings_;
  other.sun.elevation_deg = 21;
  EXPECT_NE(state_under(tile_job(other, 2)).why.find("the scene is 'sun.elevation_deg = 20' there and 'sun.elevation_deg = 21' here"), std::string::npos);
  other = settings_;
  other.film.exposure_ev = 3;
  other.film.adaptation = "night";
  EXPECT_EQ(state_under(tile_job(other, 2)).state, TileState::done) << "what the PNG makes of them changes no pixel";
  std::filesystem::copy_file(tile_path(folder_, 2, 0), tile_path(folder_, 2, 1), std::filesystem::copy_options::overwrite_existing);
  EXPECT_EQ(state_under(job).state, TileState::foreign);
  EXPECT_EQ(fault_of([&] { merge({.allow_partial = true}); }), mismatch);
  EXPECT_TRUE(has_no_output());
}

TEST_F(Tiles, ACheckpointIsNoTile) {
  settings_.render.samples_per_pixel = 1000000;
  const TileJob job = tile_job(settings_, 2);
  make(job, 0, {.time_limit_s = 0.05});
  std::filesystem::rename(checkpoint_path(folder_, 2, 0), tile_path(folder_, 2, 0));
  EXPECT_EQ(inspect_tile(folder_, job, 0, true).state, TileState::damaged);
}

TEST_F(Tiles, ADamagedCheckpointCostsNothingButTime) {
  const TileJob job = tile_job(settings_, 1);
  replace(checkpoint_path(folder_, 1, 0), "arcusflm, but not for long");
  EXPECT_TRUE(make(job, 0).is_complete);
  merge();
  expect_merged(whole());
}

TEST_F(Tiles, MergeListsWhatIsMissingAndRepairs) {
  const TileJob job = make_all(7);
  const std::string damaged_tile = tile_path(folder_, 7, 6);
  for (const long long tile : {2, 5}) std::filesystem::remove(tile_path(folder_, 7, tile));
  std::filesystem::resize_file(damaged_tile, 1000);
  std::string said;
  try {
    merge();
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::incomplete);
    said = error.what();
  }
  EXPECT_NE(said.find("missing 2,5: damaged 6"), std::string::npos) << said;
  EXPECT_NE(said.find("--tiles 2,5,6/7"), std::string::npos) << said;
  EXPECT_EQ(survey_tiles(folder_, true).to_make(), (std::vector<long long>{2, 5, 6}));
  EXPECT_TRUE(has_no_output());
  EXPECT_EQ(merge({.allow_partial = true}).left_out, (std::vector<long long>{2, 5, 6}));
  const Image preview = read_exr(exr_);
  const Picture one = whole();
  for (long long tile = 0; tile < 7; ++tile) {
    const PixelBox box = tile_box(one.image.width_px(), one.image.height_px(), 7, tile);
    const bool is_there = tile != 2 && tile != 5 && tile != 6;
    EXPECT_EQ(preview.value(box.x0, box.y0, *preview.channel("R")), is_there ? one.image.value(box.x0, box.y0, 0) : 0) << "tile " << tile;
  }
  EXPECT_EQ(fault_of([&] { merge({.repair = true}); }), incomplete);
  EXPECT_FALSE(std::filesystem::exists(damaged_tile));
  for (const long long tile : {2, 5, 6}) make(job, tile);
  merge();
  expect_merged(one);
}

TEST_F(Tiles, DamageThatIsFoundWhileThePictureIsWrittenLeavesNone) {
  settings_.camera.height_px = 210;  // several bands
  make_all(40);
  const auto spoil = [&](long long tile) {
    const std::string path = tile_path(folder_, 40, tile);
    std::string bytes = content(path);
    bytes[bytes.size() - 3] ^= 1;  // its header is good
    replace(path, bytes);
  };
  for (const long long tile : {21, 39}) spoil(tile);
  EXPECT_TRUE(survey_tiles(folder_, false).to_make().empty());
  std::string said;
  try {
    merge();
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::incomplete);
    said = error.what();
  }
  EXPECT_NE(said.find("not complete: damaged 21,39 (" + tile_path(folder_, 40, 21) + ": "), std::string::npos) << said;
  EXPECT_TRUE(has_no_output());
  EXPECT_EQ(merge({.allow_partial = true}).left_out, (std::vector<long long>{21, 39}));
  const Image preview = read_exr(exr_);
  const Image one = whole().image;
  double pixels_left_out = 0;
  for (long long tile = 0; tile < 40; ++tile) {
    const PixelBox box = tile_box(one.width_px(), one.height_px(), 40, tile);
    const bool is_left_out = tile == 21 || tile == 39;
    pixels_left_out += is_left_out ? static_cast<double>(box.pixels()) : 0;
    const int x = box.x1 - 1, y = box.y1 - 1;
    EXPECT_EQ(preview.value(x, y, *preview.channel("R")), is_left_out ? 0 : one.value(x, y, 0)) << "tile " << tile;
  }
  EXPECT_DOUBLE_EQ(*preview.metadata.number("arcus:samples_per_pixel"),
                   static_cast<double>(settings_.render.samples_per_pixel) * (1 - pixels_left_out / (37 * 210)));
}

TEST_F(Tiles, AMergeThatIsStoppedLeavesNoPicture) {
  make_all(7);
  const std::atomic<int> stop_request = 2;
  EXPECT_FALSE(merge({.stop_request = &stop_request}).is_complete);
  EXPECT_TRUE(has_no_output());
}

TEST_F(Tiles, ARecordThatIsDamagedOrGoneIsNotNeeded) {
  make_all(3);
  std::string record = content(record_path(folder_));
  record[record.find("\"seed\": 1") + 8] = '7';
  replace(record_path(folder_), record);
  EXPECT_FALSE(read_record(folder_));
  merge();
  expect_merged(whole());
  std::filesystem::remove(record_path(folder_));
  merge();
  expect_merged(whole());
}

TEST_F(Tiles, FoldersWithoutTilesAreWrongInput) {
  EXPECT_EQ(fault_of([&] { survey_tiles(folder_, true); }), static_cast<int>(Fault::input));
  EXPECT_EQ(fault_of([&] { survey_tiles(folder_ + "_none", true); }), static_cast<int>(Fault::input));
  EXPECT_EQ(fault_of([&] { tile_job(settings_, 37 * 21 + 1); }), static_cast<int>(Fault::input));
}

}  // namespace arcus::render
