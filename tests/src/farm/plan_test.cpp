#include "src/farm/plan.h"

#include <gtest/gtest.h>

namespace arcus::farm {
namespace {

Workload an_hour() {
  Workload load;
  load.thread_seconds = 3600;
  load.width_px = 1920;
  load.height_px = 1080;
  return load;
}

TEST(Plan, TilesTakeAboutAMinute) {
  const Plan plan = plan_of(an_hour());
  EXPECT_EQ(plan.tiles, 60);
  EXPECT_EQ(plan.tiles_per_task, 1);
  EXPECT_DOUBLE_EQ(plan.task_seconds, 60);
}

TEST(Plan, MoreThreadsMakeFewerTiles) {
  Workload load = an_hour();
  load.threads = 4;
  EXPECT_EQ(plan_of(load).tiles, 15);
}

TEST(Plan, EveryWorkerHasSomeTiles) {
  Workload load = an_hour();
  load.workers = 100;
  const Plan plan = plan_of(load);
  EXPECT_EQ(plan.tiles, 400);
  EXPECT_EQ(plan.tasks, 400);
}

TEST(Plan, StartingCostsLittle) {
  Workload load = an_hour();
  load.start_seconds = 20;
  const Plan plan = plan_of(load);
  EXPECT_GE(plan.task_seconds, 40 * 20);
  EXPECT_EQ(plan.tiles, 60) << "a tile is what may be lost; it stays small";
}

TEST(Plan, TasksStayUnderTheEnginesLimit) {
  Workload load = an_hour();
  load.thread_seconds = 3600 * 100;
  load.most_tasks = 1001;
  const Plan plan = plan_of(load);
  EXPECT_EQ(plan.tiles, 6000);
  EXPECT_EQ(plan.tiles_per_task, 6);
  EXPECT_LE(plan.tasks, 1001);
}

TEST(Plan, TilesThatAreGivenStay) {
  Workload load = an_hour();
  load.tiles = 7200;
  const Plan plan = plan_of(load);
  EXPECT_EQ(plan.tiles, 7200);
  EXPECT_EQ(plan.tiles_per_task, 120);
  EXPECT_EQ(plan.tasks, 60);
}

TEST(Plan, FramesShareWorkersAndTasks) {
  Workload load = an_hour();
  load.thread_seconds = 6;
  load.frames = 1000;
  load.workers = 8;
  const Plan plan = plan_of(load);
  EXPECT_EQ(plan.tiles, 1);
  EXPECT_EQ(plan.tiles_per_task, 10);
  EXPECT_EQ(plan.tasks, 100);
}

TEST(Plan, SmallPicturesAreNotCutSmallerThanBlocks) {
  Workload load = an_hour();
  load.width_px = load.height_px = 32;
  EXPECT_EQ(plan_of(load).tiles, 4);
  load.thread_seconds = 0;
  EXPECT_EQ(plan_of(load).tiles, 1);
  EXPECT_EQ(plan_of(load).tasks, 1);
}

}  // namespace
}  // namespace arcus::farm
