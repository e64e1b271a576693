#include "src/farm/farm_job.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <vector>

#include "phase/base/error.h"

namespace arcus::farm {
namespace {

FarmJob a_job() {
  FarmJob job;
  job.program = "arcus";
  job.scene = "the scene.toml";
  job.folder = "out";
  job.picture = "p.exr";
  job.tiles = 5;
  job.tiles_per_task = 3;
  return job;
}

TEST(FarmJob, TasksHaveEveryTileOfEveryFrameOnce) {
  for (const long long per_task : {1, 2, 3, 5, 7, 15, 40}) {
    FarmJob job = a_job();
    job.frames = FrameRange{3, 5};
    job.tiles_per_task = per_task;
    std::vector<int> seen(15);
    for (long long task = 0; task < job.task_count(); ++task) {
      const auto parts = parts_of(job, task);
      EXPECT_FALSE(parts.empty());
      for (const TaskPart& part : parts)
        for (const long long tile : part.tiles) {
          ++seen[static_cast<std::size_t>(part.frame * 5 + tile)];
          EXPECT_EQ(task_of(job, part.frame, tile), task);
        }
    }
    EXPECT_EQ(seen, std::vector<int>(15, 1)) << per_task << " tiles a task";
  }
}

TEST(FarmJob, TasksHaveTilesFromAllOverThePicture) {
  FarmJob job = a_job();
  job.tiles = 100;
  job.tiles_per_task = 10;
  const auto parts = parts_of(job, 7);
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0].tiles, (std::vector<long long>{7, 17, 27, 37, 47, 57, 67, 77, 87, 97}));
}

TEST(FarmJob, CommandsAreAsPeopleTypeThem) {
  FarmJob job = a_job();
  job.overrides = {"sun.elevation_deg=10..20", "camera.position_m=[0, 1, 2]"};
  job.worker_options = {"--threads", "2"};
  EXPECT_EQ(command_of(a_job(), {0, {1, 3}}), "arcus tile 'the scene.toml' --tiles 1,3/5 --out out");
  job.frames = FrameRange{0, 1};
  EXPECT_EQ(command_of(job, {1, {0, 1, 2, 3, 4}}),
            "arcus tile 'the scene.toml' --tiles 0-4/5 --out out/frame_0001 --set sun.elevation_deg=20 --set 'camera.position_m=[0, 1, 2]' --threads 2");
  EXPECT_EQ(merge_words_of(job, 1), (std::vector<std::string>{"arcus", "merge", "out/frame_0001", "-o", "p.0001.exr"}));
}

TEST(FarmJob, ShellsGetTheSameWord) {
  for (const std::string word : {"plain-0.exr", "", "two words", "it's", "$HOME `ls` \"x\" \\", "*", "a\nb"}) {
    const std::string file = testing::TempDir() + "word.txt";
    ASSERT_EQ(std::system(("printf '%s' " + shell_quoted(word) + " >" + shell_quoted(file)).c_str()), 0);
    std::ifstream in(file, std::ios::binary);
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}), word);
  }
}

TEST(FarmJob, GoesOnWithWhatWasWritten) {
  FarmJob job = a_job();
  job.folder = testing::TempDir() + "farm_job_test";
  job.overrides = {"render.seed={frame}"};
  job.frames = FrameRange{1, 12};
  std::filesystem::remove_all(job.folder);
  EXPECT_FALSE(read_farm(job.folder));
  write_farm(job, 3);
  const auto read = read_farm(job.folder);
  ASSERT_TRUE(read);
  EXPECT_EQ(difference(*read, job), "");
  EXPECT_EQ(read->tiles_per_task, job.tiles_per_task);
  job.frames = FrameRange{1, 13};
  EXPECT_NE(difference(*read, job), "");
  std::ofstream(record_path(job.folder)) << "{\"arcus_farm\": 1";
  EXPECT_THROW(read_farm(job.folder), Error);
}

}  // namespace
}  // namespace arcus::farm
