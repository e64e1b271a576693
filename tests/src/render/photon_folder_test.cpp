#include "src/render/photon_folder.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include "phase/base/error.h"
#include "phase/base/whole_file.h"
#include "src/film/image_file.h"
#include "src/render/merge.h"
#include "src/render/photon_file.h"
#include "src/render/picture.h"
#include "src/render/render_tile.h"
#include "src/render/tile_integrator.h"
#include "tests/src/render/small_scene.h"

namespace arcus::render {
namespace {

/// The block of haze over land with a ball of water in the sun, and a folder that is gone after the test.
class Photons : public testing::Test {
 protected:
  Photons() {
    settings_.render.integrator = "photon_map";
    settings_.render.photons = 40000;
    settings_.render.neighbours = 10;
    settings_.render.iterations = 3;
    settings_.render.passes = 2;
    settings_.render.samples_per_pixel = 2;
    scene_ = std::make_unique<Scene>(small_scene(settings_));
    SurfaceParts parts;
    parts.planes.push_back({0, 0});
    parts.materials.push_back(Material(Matte(0.4)));
    parts.add(one_sphere(Vec3(0.2, -1.5, 0.4), 0.4), water());
    scene_->surfaces = Surfaces(std::move(parts));
    job_ = tile_job(settings_, 3);
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~Photons() override { std::filesystem::remove_all(folder_); }

  PhotonFolder photons() { return PhotonFolder(folder_, job_, sending(), &stop_request_, say_); }
  const PhotonSending& sending() {
    if (!sending_) sending_.emplace(*scene_, settings_.render);
    return *sending_;
  }
  std::string path(std::size_t range) { return photon_range_path(folder_, sending().range_count(), range); }
  /// What was said, and forgets it.
  std::string said() { return std::exchange(said_, ""); }
  std::size_t done() { return survey_photons(folder_, job_, true).ranges_done; }

  SceneSettings settings_ = small_settings();
  std::unique_ptr<Scene> scene_;
  TileJob job_;
  std::string folder_ = testing::TempDir() + "arcus_photons_" + testing::UnitTest::GetInstance()->current_test_info()->name();
  std::atomic<int> stop_request_{0};
  int stops_after_ = -1;  ///< things that are said
  std::function<void(std::string_view)> say_ = [this](std::string_view text) {
    said_ += std::string(text) + "\n";
    if (--stops_after_ == 0) stop_request_ = 15;
  };

 private:
  std::optional<PhotonSending> sending_;
  std::string said_;
};

std::string content(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

void replace(const std::string& path, const std::string& content) { std::ofstream(path, std::ios::binary) << content; }

bool are_same(const std::vector<Photon>& a, const std::vector<Photon>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Photon)) == 0;
}
bool are_same(const std::optional<std::vector<LandedPhotons>>& a, const std::optional<std::vector<LandedPhotons>>& b) {
  if (!a || !b || a->size() != b->size()) return false;
  for (std::size_t i = 0; i < a->size(); ++i)
    if (!are_same((*a)[i].on_surfaces, (*b)[i].on_surfaces) || !are_same((*a)[i].in_media, (*b)[i].in_media)) return false;
  return true;
}

bool is_damaged(const std::string& path) {
  try {
    read_photons(path);
  } catch (const Error& error) {
    return error.fault() == Fault::incomplete;
  }
  return false;
}

}  // namespace

TEST_F(Photons, SharedByWorkersGiveThePictureOfOneProcess) {
  ASSERT_EQ(sending().range_count(), 4u);
  for (long long tile = 0; tile < 3; ++tile) {  // the first sends all, the others find them
    const auto integrator = make_tile_integrator(settings_, *scene_, job_, folder_, tile, {.threads = static_cast<int>(tile) + 1}, say_);
    EXPECT_EQ(said().empty(), tile > 0);
    render_tile(settings_, *scene_, *integrator, job_, folder_, tile, {}, say_);
  }
  const std::string merged = folder_ + "/merged.exr";
  merge_tiles(folder_, merged, "", {});
  EXPECT_EQ(read_exr(merged).values(), render_picture(settings_, *scene_, {}, {}).image.values());
  const PhotonSurvey survey = survey_photons(folder_, job_, true);
  EXPECT_EQ(survey.ranges, 4u);
  EXPECT_EQ(survey.ranges_done, 4u);
  EXPECT_EQ(survey.passes, 2u);
  EXPECT_EQ(survey.passes_done, 2u);
}

TEST_F(Photons, AreReadAsTheyWereSent) {
  PhotonFolder one = photons();
  ASSERT_TRUE(one.share(0.5));
  double caustic = 0, in_media = 0;
  for (std::size_t range = 0; range < 4; ++range) {
    const auto sent = sending().send(range);
    EXPECT_TRUE(are_same(one.landed(range), sent)) << range;
    for (const LandedPhotons& landed : *sent) in_media += static_cast<double>(landed.in_media.size());
    caustic += static_cast<double>((*sent)[0].on_surfaces.size());
  }
  EXPECT_GT(caustic, 1000);
  EXPECT_GT(in_media, 1000);
}

TEST_F(Photons, AWorkerBeginsAtItsPlaceAndLeavesToOthersWhatTheyAreAt) {
  std::filesystem::create_directories(folder_ + "/photons");
  replace(folder_ + "/photons/.range_3_of_4.partelsewhere-1-0.photons", "");
  ASSERT_TRUE(photons().share(0.5));
  const std::string order = said();
  std::vector<std::size_t> at;
  for (const char* range : {"range 2 of 4", "range 0 of 4", "range 1 of 4", "range 3 of 4"}) at.push_back(order.find(range));
  EXPECT_LT(at.back(), std::string::npos) << order;
  EXPECT_TRUE(std::is_sorted(at.begin(), at.end())) << order;
}

TEST_F(Photons, WhatAnotherOfThisMachineIsAtIsWaitedFor) {
  std::filesystem::create_directories(folder_ + "/photons");
  ASSERT_TRUE(photons().share(0));
  for (const std::string& path : {path(1), relaxed_photons_path(folder_, 2, 0)}) {
    const std::string good = content(path);
    std::filesystem::remove(path);
    said();
    std::thread other([&, file = std::make_unique<WholeFile>(path)] {
      std::this_thread::sleep_for(std::chrono::milliseconds(300));
      replace(file->temporary_path(), good);
      file->commit();
    });
    EXPECT_TRUE(photons().share(0));
    EXPECT_EQ(said(), "") << "made twice: " << path;
    other.join();
  }
}

TEST_F(Photons, StoppedBetweenRangesKeepWhatIsSent) {
  stops_after_ = 2;
  EXPECT_FALSE(photons().share(0.25));
  EXPECT_EQ(done(), 2u);
  EXPECT_FALSE(photons().landed(0));
  EXPECT_EQ(make_tile_integrator(settings_, *scene_, job_, folder_, 0, {.stop_request = &stop_request_}, say_), nullptr);
  EXPECT_EQ(done(), 2u);
  stop_request_ = 0;
  said();
  EXPECT_TRUE(photons().share(0));
  const std::string later = said();
  EXPECT_NE(later.find("range 0 of 4"), std::string::npos);
  EXPECT_EQ(later.find("range 1 of 4"), std::string::npos);
  EXPECT_EQ(done(), 4u);
}

TEST_F(Photons, OneFlippedBitIsFoundAndTheRangeMadeAgain) {
  PhotonFolder one = photons();
  ASSERT_TRUE(one.share(0));
  const auto sent = sending().send(1);
  const std::string good = content(path(1));
  const std::size_t step = good.size() / 50;
  for (std::size_t byte = 0; byte < good.size(); byte += byte < 100 ? 7 : step) {
    std::string bad = good;
    bad[byte] = static_cast<char>(bad[byte] ^ (1 << byte % 8));
    replace(path(1), bad);
    ASSERT_TRUE(is_damaged(path(1))) << "in byte " << byte;
  }
  EXPECT_EQ(done(), 3u);
  said();
  EXPECT_TRUE(are_same(one.landed(1), sent));  // by the worker that has seen it whole
  EXPECT_NE(said().find("range_1_of_4.photons: the file is damaged"), std::string::npos);
  EXPECT_EQ(content(path(1)), good);
  for (const std::size_t length : {std::size_t{0}, std::size_t{20}, std::size_t{48}, good.size() - 1}) {
    replace(path(1), good.substr(0, length));
    ASSERT_TRUE(photons().share(0)) << "at " << length;
    EXPECT_NE(said().find("made again"), std::string::npos) << length;
    EXPECT_EQ(content(path(1)), good);
  }
  replace(path(1), good + "x");
  ASSERT_TRUE(photons().share(0));
  EXPECT_EQ(content(path(1)), good);
  std::filesystem::copy_file(path(0), path(1), std::filesystem::copy_options::overwrite_existing);
  ASSERT_TRUE(photons().share(0));
  EXPECT_NE(said().find("is range_0_of_4 under another name"), std::string::npos);
  EXPECT_EQ(content(path(1)), good);
  const std::string relaxed = relaxed_photons_path(folder_, 2, 1), good_relaxed = content(relaxed);
  for (const std::size_t byte : {std::size_t{30}, good_relaxed.size() - 5}) {
    std::string bad = good_relaxed;
    bad[byte] = static_cast<char>(bad[byte] ^ 4);
    replace(relaxed, bad);
    auto caustics = one.caustics_of(1);
    ASSERT_TRUE(photons().share(0));
    EXPECT_TRUE(one.relax(1, *caustics));
    EXPECT_NE(said().find("relaxed_1_of_2.photons: the file is damaged"), std::string::npos);
    EXPECT_EQ(content(relaxed), good_relaxed);
  }
}

TEST_F(Photons, OfAnotherJobAreRefused) {
  ASSERT_TRUE(photons().share(0));
  settings_.render.seed = 2;
  const TileJob first = std::exchange(job_, tile_job(settings_, 3));
  for (const bool is_seen_later : {false, true}) try {
      PhotonFolder later = photons();
      if (is_seen_later) later.landed(2);
      else later.share(0);
      ADD_FAILURE() << "photons of another seed are taken";
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::mismatch);
      EXPECT_NE(std::string(error.what()).find("the seed is 1 there and 2 here"), std::string::npos) << error.what();
    }
  const PhotonSurvey survey = survey_photons(folder_, job_, false);
  EXPECT_EQ(survey.foreign.size(), 6u);
  EXPECT_EQ(survey.ranges_done + survey.passes_done, 0u);
  EXPECT_EQ(survey_photons(folder_, first, false).ranges_done, 4u);
}

}  // namespace arcus::render
