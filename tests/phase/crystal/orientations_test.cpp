#include "phase/crystal/orientations.h"

#include <gtest/gtest.h>

#include <cmath>

#include "phase/base/error.h"
#include "phase/base/units.h"
#include "tests/statistics/cells.h"
#include "tests/statistics/chi_square.h"
#include "tests/statistics/seed.h"
#include "tests/statistics/students_t.h"

namespace arcus::phase {
namespace {

using statistics::test_seed;

constexpr int draws = 1'000'000;

double normal_density(double x, double deviation) {
  return std::exp(-0.5 * x * x / (deviation * deviation)) / (std::sqrt(2 * pi) * deviation);
}

/// Height of a vector above the horizon.
double elevation_deg(const Vec3& v) { return degrees(std::asin(std::fmax(-1, std::fmin(1, v.z)))); }

}  // namespace

TEST(Orientations, AreRotations) {
  Random random(test_seed(), 0, 0);
  for (const char* type : {"random", "plate", "column", "parry", "lowitz"}) {
    const Orientations kind({.type = type, .tilt_deg = 20, .roll_deg = 200});
    for (int i = 0; i < 100; ++i) {
      const Orientation o = kind.draw(random);
      EXPECT_LT(length(cross(o.x, o.y) - o.c), 1e-10) << type;
      EXPECT_NEAR(length(o.x), 1, 1e-10) << type;
      EXPECT_NEAR(length(o.y), 1, 1e-10) << type;
      EXPECT_NEAR(dot(o.x, o.y), 0, 1e-10) << type;
      const Vec3 v(0.1, -0.7, 0.3);
      EXPECT_LT(length(o.to_crystal(o.to_world(v)) - v), 1e-10) << type;
    }
  }
}

TEST(Orientations, RandomOnesFavourNoDirection) {
  const Orientations all({});
  EXPECT_TRUE(all.isotropic());
  const statistics::SphereCells cells([](const Vec3&) { return 0.25 / pi; }, {0, 0, 1}, 64);
  statistics::Tally x(cells), y(cells), c(cells), seen(cells);
  const Vec3 along = normalize(Vec3(1, 2, 3));
  Random random(test_seed(), 0, 0);
  for (int i = 0; i < draws; ++i) {
    const Orientation o = all.draw(random);
    x.add(o.x);
    y.add(o.y);
    c.add(o.c);
    seen.add(o.to_crystal(along));
  }
  for (const auto* tally : {&x, &y, &c, &seen}) EXPECT_TRUE(statistics::chi_square(*tally, 4));
}

TEST(Orientations, RandomOnesRollEvenlyAboutTheirAxis) {
  // The angle of a uniform rotation has density (1 - cos a) / pi; the axes alone wouldn't tell.
  const Orientations all({});
  const auto density = [](double angle) { return (1 - std::cos(angle)) / pi; };
  const statistics::IntervalCells cells(density, 0, pi, 64);
  const statistics::IntervalCells wrong(
      [&](double angle) { return density(angle) * (1 + 0.02 * std::cos(angle)) / 0.99; }, 0, pi,
      64);
  statistics::Tally tally(cells), off(wrong);
  Random random(test_seed(), 0, 0);
  for (int i = 0; i < draws; ++i) {
    const Orientation o = all.draw(random);
    const double cosine = 0.5 * (o.x.x + o.y.y + o.c.z - 1);
    const double angle = std::acos(std::fmax(-1, std::fmin(1, cosine)));
    tally.add(angle);
    off.add(angle);
  }
  EXPECT_TRUE(statistics::chi_square(tally));
  EXPECT_FALSE(statistics::chi_square(off));
}

TEST(Orientations, TiltsFollowTheirSpread) {
  struct Case {
    const char* type;
    Vec3 (*axis)(const Orientation&);
  };
  const Case cases[] = {
      {"column", [](const Orientation& o) { return o.c; }},
      {"parry", [](const Orientation& o) { return o.c; }},
      {"lowitz", [](const Orientation& o) { return o.x * std::cos(pi / 6) + o.y * 0.5; }},
      // A plate's tilt has no sign; the horizontal axis towards which it tilts gives it one.
      {"plate", [](const Orientation& o) {
         const Vec3 level = o.c.x >= 0 ? o.c : -o.c;
         return Vec3(0, 0, std::copysign(std::hypot(o.c.x, o.c.y), level.y));
       }}};
  for (const Case& one : cases)
    for (const char* spread : {"gaussian", "uniform"}) {
      const Orientations kind({.type = one.type, .tilt_deg = 3, .spread = spread});
      const bool gaussian = spread[0] == 'g';
      const statistics::IntervalCells cells(
          [&](double t) {
            return gaussian ? normal_density(t, 3) : std::fabs(t) < 3 ? 1.0 / 6 : 0.0;
          },
          -20, 20, 50, {-3, 0, 3});
      const statistics::IntervalCells wide([](double t) { return normal_density(t, 3.05); }, -20,
                                           20, 50, {0});
      statistics::Tally tally(cells), off(wide);
      Random random(test_seed(), 0, 0);
      for (int i = 0; i < draws / 5; ++i) {
        const double t = elevation_deg(one.axis(kind.draw(random)));
        tally.add(t);
        off.add(t);
      }
      EXPECT_TRUE(statistics::chi_square(tally, 8)) << one.type << ' ' << spread;
      EXPECT_FALSE(statistics::chi_square(off, 8)) << one.type << ' ' << spread;
    }
}

TEST(Orientations, FavourNoAzimuth) {
  const statistics::IntervalCells cells([](double) { return 0.5 / pi; }, -pi, pi, 40);
  Random random(test_seed(), 0, 0);
  for (const char* type : {"plate", "column", "parry", "lowitz"}) {
    const Orientations kind({.type = type, .tilt_deg = 5});
    statistics::Tally x(cells), c(cells);
    for (int i = 0; i < draws / 5; ++i) {
      const Orientation o = kind.draw(random);
      x.add(std::atan2(o.x.y, o.x.x));
      c.add(std::atan2(o.c.y, o.c.x));
    }
    // Where a Parry crystal's x is nearly vertical its azimuth still is any.
    EXPECT_TRUE(statistics::chi_square(x, 8)) << type;
    EXPECT_TRUE(statistics::chi_square(c, 8)) << type;
  }
}

TEST(Orientations, ParryCrystalsKeepAFaceOnTop) {
  const Orientations kind({.type = "parry", .tilt_deg = 0, .roll_deg = 2});
  Random random(test_seed(), 0, 0);
  statistics::Moments square;
  for (int i = 0; i < 100'000; ++i) {
    const Orientation o = kind.draw(random);
    EXPECT_NEAR(o.c.z, 0, 1e-10);
    EXPECT_GT(o.x.z, 0.9);
    const double roll_deg = degrees(std::asin(o.y.z));
    square.add(roll_deg * roll_deg);
  }
  EXPECT_TRUE(statistics::mean_is(square, 4));
}

TEST(Orientations, LowitzCrystalsTurnAboutTheirDiagonal) {
  const Orientations kind({.type = "lowitz", .tilt_deg = 0, .roll_deg = 180});
  Random random(test_seed(), 0, 0);
  statistics::Moments level;
  for (int i = 0; i < 100'000; ++i) {
    const Orientation o = kind.draw(random);
    EXPECT_NEAR((o.x * std::cos(pi / 6) + o.y * std::sin(pi / 6)).z, 0, 1e-10);
    level.add(o.c.z * o.c.z);
  }
  EXPECT_TRUE(statistics::mean_is(level, 0.5));  // all angles of roll alike
}

TEST(Orientations, PerfectPlatesLieLevel) {
  const Orientations kind({.type = "plate", .tilt_deg = 0});
  Random random(test_seed(), 0, 0);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(kind.draw(random).c.z, 1);
}

TEST(Orientations, RefuseWidthsThatAreNone) {
  EXPECT_THROW(Orientations({.type = "plates"}), Error);
  EXPECT_THROW(Orientations({.type = "plate", .tilt_deg = -1}), Error);
  EXPECT_THROW(Orientations({.type = "plate", .tilt_deg = std::nan("")}), Error);
  EXPECT_THROW(Orientations({.type = "plate", .spread = "wide"}), Error);
}

}  // namespace arcus::phase
