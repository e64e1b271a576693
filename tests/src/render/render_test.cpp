#include "src/render/render.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "phase/base/error.h"
#include "phase/settings/toml_text.h"
#include "src/render/picture.h"
#include "tests/src/render/small_scene.h"

namespace arcus::render {
namespace {

Picture picture(const SceneSettings& settings, const RunOptions& options, std::optional<PixelBox> crop = {},
                const std::string& checkpoint_file = "") {
  return render_picture(settings, small_scene(settings), crop, options, checkpoint_file);
}

/// A name for a file that is not there yet, and is gone after the test.
struct TemporaryName {
  std::string path = testing::TempDir() + "arcus_" + testing::UnitTest::GetInstance()->current_test_info()->name();
  TemporaryName() { std::filesystem::remove(path); }
  ~TemporaryName() { std::filesystem::remove(path); }
};

}  // namespace

TEST(Render, AnyNumberOfThreadsGivesTheSameBits) {
  const SceneSettings settings = small_settings();
  const Picture one = picture(settings, {.threads = 1});
  for (const int threads : {2, 3})
    EXPECT_EQ(picture(settings, {.threads = threads}).image.values(), one.image.values()) << threads << " threads";
  EXPECT_EQ(one.refused.count, 0u);
  EXPECT_TRUE(one.run.is_complete);
}

TEST(Render, AnotherSeedGivesAnotherPicture) {
  SceneSettings settings = small_settings();
  const Picture one = picture(settings, {});
  settings.render.seed = 2;
  EXPECT_NE(picture(settings, {}).image.values(), one.image.values());
}

TEST(Render, CropIsThePartOfTheWhole) {
  const SceneSettings settings = small_settings();
  const PixelBox box{5, 3, 29, 20};
  const Image whole = picture(settings, {}).image, part = picture(settings, {}, box).image;
  for (int y = box.y0; y < box.y1; ++y)
    for (int x = box.x0; x < box.x1; ++x)
      for (std::size_t c = 0; c < whole.channel_names().size(); ++c)
        ASSERT_EQ(part.value(x, y, c), whole.value(x, y, c)) << x << "," << y;
}

TEST(Render, StoppedRenderingKeepsWhatIsDone) {
  SceneSettings settings = small_settings();
  settings.render.samples_per_pixel = 1000000;
  const Picture stopped = picture(settings, {.time_limit_s = 0.3});
  EXPECT_FALSE(stopped.run.is_complete);
  EXPECT_GT(stopped.run.progress.samples_done, 0);
  const std::atomic<int> now{1};
  const Picture none = picture(settings, {.stop_request = &now});
  EXPECT_EQ(none.run.progress.samples_done, 0);
  for (const float value : none.image.values()) EXPECT_EQ(value, 0);
}

TEST(Render, StoppedOftenAndResumedGivesTheSameBits) {
  SceneSettings settings = small_settings();
  settings.render.samples_per_pixel = 200;
  const Picture whole = picture(settings, {});
  const TemporaryName file;
  int runs = 0;
  Picture last;
  do {
    last = picture(settings, {.threads = 1 + runs % 3, .time_limit_s = 0.02, .checkpoint_s = 0.005}, {}, file.path);
    EXPECT_EQ(std::filesystem::exists(file.path), !last.run.is_complete);
  } while (!last.run.is_complete && ++runs < 1000);
  EXPECT_GE(runs, 3);
  EXPECT_TRUE(last.run.is_complete);
  EXPECT_EQ(last.image.values(), whole.image.values());
}

TEST(Render, CheckpointsOfOtherScenesOrDamagedOnesAreRefused) {
  SceneSettings settings = small_settings();
  settings.render.samples_per_pixel = 1000000;
  const TemporaryName file;
  picture(settings, {.time_limit_s = 0.05}, {}, file.path);
  const auto fault = [&] {
    try {
      picture(settings, {.time_limit_s = 0.05}, {}, file.path);
    } catch (const Error& error) {
      return static_cast<int>(error.fault());
    }
    return 0;
  };
  settings.render.seed = 7;
  EXPECT_EQ(fault(), static_cast<int>(Fault::mismatch));
  settings.render.seed = 1;
  EXPECT_EQ(fault(), 0);
  std::fstream(file.path, std::ios::in | std::ios::out | std::ios::binary).seekp(-3, std::ios::end).put('x');
  EXPECT_EQ(fault(), static_cast<int>(Fault::incomplete));
  std::filesystem::resize_file(file.path, 500);
  EXPECT_EQ(fault(), static_cast<int>(Fault::incomplete));
}

TEST(Render, PictureKnowsItsMaking) {
  const SceneSettings settings = small_settings();
  const Image image = picture(settings, {}).image;
  EXPECT_EQ(image.metadata.number("arcus:samples_per_pixel"), 5);
  ASSERT_TRUE(image.metadata.text("arcus:scene"));
  // The scene text alone makes the same scene again.
  SceneSettings again;
  read_toml(*image.metadata.text("arcus:scene"), "metadata", {}, [&](Keys& keys) { list_keys(keys, again); });
  EXPECT_EQ(text_of(again), *image.metadata.text("arcus:scene"));
}

}  // namespace arcus::render
