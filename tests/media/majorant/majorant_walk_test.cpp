#include "media/majorant/majorant_walk.h"

#include <gtest/gtest.h>

#include "media/medium/medium.h"
#include "tests/media/kit.h"
#include "tests/statistics/seed.h"

namespace arcus::media {
namespace {

/// Walks a ray and checks it against the cells at points along it: every point lies in the segment with its cell's majorant,
/// segments are in order and do not overlap, and where there is none, the cell is empty. Returns the number of segments.
int check(const Medium& medium, const Ray& ray, const std::string& what) {
  MajorantWalk walk(medium.majorants(), ray);
  Segment segment;
  double last = ray.nearest_m, gap_begin = -1;
  int count = 0;
  const auto probe = [&](double begin, double end, float majorant) {
    for (const double share : {1e-3, 0.3, 0.7, 0.999}) {
      const double at = begin + share * (end - begin);
      EXPECT_EQ(medium.majorants().at(ray.at(at)).majorant_per_m, majorant) << what << " at " << at;
    }
  };
  while (walk.next(segment)) {
    EXPECT_LT(segment.begin_m, segment.end_m) << what;
    EXPECT_GE(segment.begin_m, last) << what << ": segments overlap";
    EXPECT_GE(segment.begin_m, ray.nearest_m) << what;
    EXPECT_LE(segment.end_m, ray.farthest_m) << what;
    if (segment.end_m - segment.begin_m > 1e-6) probe(segment.begin_m, segment.end_m, segment.majorant_per_m);
    if (segment.begin_m - last > 1e-6) {
      for (double share = 0.01; share < 1; share += 0.07)
        EXPECT_EQ(medium.majorants().at(ray.at(last + share * (segment.begin_m - last))).majorant_per_m, 0)
            << what << ": a gap from " << last << " to " << segment.begin_m;
    }
    last = segment.end_m;
    ++count;
  }
  gap_begin = last;
  const double far = std::min(ray.farthest_m, gap_begin + 300);
  for (double share = 0.001; share < 1 && far > gap_begin + 1e-6; share += 0.01)
    EXPECT_EQ(medium.majorants().at(ray.at(gap_begin + share * (far - gap_begin))).majorant_per_m, 0)
        << what << ": not covered after " << gap_begin;
  EXPECT_FALSE(walk.next(segment)) << what << ": goes on after its end";
  return count;
}

TEST(MajorantWalk, SegmentsMeetAndCoverTheRay) {
  const auto grid = kit::rough_grid({{-20, -20, -20}, {150, 80, 90}});
  for (const auto& [name, map] : kit::transforms()) {
    const Medium medium({kit::component(grid, map)});
    Random random(statistics::test_seed(), 0, 0);
    const Box around = medium.bounds_m().grown_by(20);
    int segments = 0;
    for (int i = 0; i < 300; ++i) {
      const Vec3 from = kit::point_in(around, random), to = kit::point_in(medium.bounds_m(), random);
      Ray ray{from, normalize(to - from)};
      if (i % 3 == 0) ray.farthest_m = length(to - from);
      if (i % 5 == 0) ray.nearest_m = 0.3 * length(to - from);
      segments += check(medium, ray, name);
    }
    EXPECT_GT(segments, 1000) << name;
  }
}

TEST(MajorantWalk, FollowsAxesFacesEdgesAndDiagonals) {
  const auto grid = kit::rough_grid({{0, 0, 0}, {127, 127, 127}});
  const Medium medium({kit::component(grid)});
  int segments = 0;
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0})
      // On planes between cells and blocks, and off them; nothing may be lost or repeated.
      for (const double offset : {8.0, 64.0, 31.7, 63.999999999, 12.0})
        for (const double other : {16.0, 64.0, 40.2}) {
          Vec3 direction(0), origin(0);
          direction[axis] = sign;
          origin[axis] = sign > 0 ? -50 : 200;
          origin[(axis + 1) % 3] = offset;
          origin[(axis + 2) % 3] = other;
          MajorantWalk walk(medium.majorants(), {origin, direction});
          Segment segment;
          double last = 0;
          while (walk.next(segment)) {
            EXPECT_GE(segment.begin_m, last);
            EXPECT_LT(segment.begin_m, segment.end_m);
            last = segment.end_m;
            ++segments;
          }
        }
  EXPECT_GT(segments, 100);
  for (const Vec3& diagonal : {Vec3(1, 1, 1), Vec3(1, 1, 0), Vec3(-1, 1, -1)})
    check(medium, {Vec3(64) - diagonal * 200, normalize(diagonal)}, "diagonal");
}

TEST(MajorantWalk, MissesWhatItDoesNotMeet) {
  const Medium medium({kit::block({{0, 0, 0}, {10, 10, 10}}, 1)});
  Segment segment;
  const auto meets = [&](const Ray& ray) { return MajorantWalk(medium.majorants(), ray).next(segment); };
  EXPECT_FALSE(meets({{-5, 11, 5}, {1, 0, 0}}));
  EXPECT_FALSE(meets({{-5, 5, 5}, {-1, 0, 0}}));
  EXPECT_FALSE(meets({{-5, 5, 5}, {1, 0, 0}, 0, 4}));
  EXPECT_FALSE(meets({{-5, 5, 5}, {1, 0, 0}, 16}));
  EXPECT_FALSE(meets({{0, 20, 0}, normalize(Vec3(1, 1, 0))}));
  EXPECT_TRUE(meets({{5, 5, 5}, {0, 0, 1}}));
  EXPECT_DOUBLE_EQ(segment.begin_m, 0);
  EXPECT_DOUBLE_EQ(segment.end_m, 5);
}

TEST(MajorantWalk, GrazesAFaceWithoutStumbling) {
  const Medium medium({kit::block({{0, 0, 0}, {10, 10, 10}}, 1)});
  for (const double y : {0.0, 10.0, 1e-15, 10 - 1e-15}) {
    MajorantWalk walk(medium.majorants(), {{-5, y, 5}, {1, 0, 0}});
    Segment segment;
    double covered = 0;
    while (walk.next(segment)) covered += segment.end_m - segment.begin_m;
    EXPECT_TRUE(covered == 0 || std::abs(covered - 10) < 1e-9) << y << " " << covered;
  }
}

}  // namespace
}  // namespace arcus::media
