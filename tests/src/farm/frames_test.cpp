#include "src/farm/frames.h"

#include <gtest/gtest.h>

#include "phase/base/error.h"

namespace arcus::farm {
namespace {

TEST(Frames, RangesAreTwoNumbers) {
  EXPECT_EQ(read_frame_range("8:10", "--frames"), (FrameRange{8, 10}));
  EXPECT_EQ(read_frame_range("7:7", "--frames").count(), 1);
  for (const char* wrong : {"", "5", "5:", ":5", "9:8", "-1:4", "1:2:3", "1:2x", "a:b", "0:99999999"})
    EXPECT_THROW(read_frame_range(wrong, "--frames"), Error) << wrong;
}

TEST(Frames, ValuesGoEvenlyFromTheFirstFrameToTheLast) {
  const FrameRange frames{10, 14};
  EXPECT_EQ(at_frame("sun.elevation_deg=5..30", frames, 10), "sun.elevation_deg=5");
  EXPECT_EQ(at_frame("sun.elevation_deg=5..30", frames, 11), "sun.elevation_deg=11.25");
  EXPECT_EQ(at_frame("sun.elevation_deg=5..30", frames, 14), "sun.elevation_deg=30");
  EXPECT_EQ(at_frame("sun.elevation_deg=1.5..-0.5", frames, 12), "sun.elevation_deg=0.5");
  EXPECT_EQ(at_frame("camera.position_m=[0, -8e3..8e3, 2]", frames, 12), "camera.position_m=[0, 0, 2]");
}

TEST(Frames, TheLastValueIsAsItIsTyped) {
  EXPECT_EQ(at_frame("a=0..0.7", {0, 3}, 3), "a=0.7");
}

TEST(Frames, BracesAreTheFramesNumber) {
  EXPECT_EQ(at_frame("medium.0.vdb=\"les_{frame:4}.vdb\"", {0, 20}, 7), "medium.0.vdb=\"les_0007.vdb\"");
  EXPECT_EQ(at_frame("render.seed={frame}", {0, 20}, 12), "render.seed=12");
  EXPECT_THROW(at_frame("render.seed={frame:x}", {0, 20}, 12), Error);
}

TEST(Frames, OneFrameHasTheFirstValue) { EXPECT_EQ(at_frame("a=2..9", {5, 5}, 5), "a=2"); }

TEST(Frames, WhatVariesIsSeen) {
  EXPECT_TRUE(varies("a=1..2"));
  EXPECT_TRUE(varies("a={frame}"));
  EXPECT_FALSE(varies("a=1.5"));
  EXPECT_FALSE(varies("medium.0.vdb=\"../cloud.vdb\""));
}

}  // namespace
}  // namespace arcus::farm
