#include "phase/crystal/crystal_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "phase/base/error.h"
#include "phase/base/frame.h"
#include "phase/base/units.h"
#include "phase/crystal/crystal_habit.h"
#include "phase/crystal/orientations.h"
#include "tests/statistics/seed.h"
#include "tests/statistics/students_t.h"

namespace arcus::phase {
namespace {

std::vector<HalfSpace> box(double x, double y, double z) {
  return {{{1, 0, 0}, x, 1},  {{-1, 0, 0}, x, 2}, {{0, 1, 0}, y, 3},
          {{0, -1, 0}, y, 4}, {{0, 0, 1}, z, 5},  {{0, 0, -1}, z, 6}};
}

std::set<int> numbers(const CrystalShape& shape) {
  std::set<int> found;
  for (const CrystalFace& face : shape.faces()) found.insert(face.number);
  return found;
}

std::string message(const HabitSettings& habit) {
  try {
    make_crystal(habit, 100);
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::input);
    return error.what();
  }
  return "no error";
}

/// A closed surface: areas times normals cancel, and moving the origin changes no volume.
void expect_closed(const CrystalShape& shape) {
  Vec3 sum(0);
  for (const CrystalFace& face : shape.faces()) {
    sum += face.normal * face.area;
    for (const Vec3& corner : face.corners)
      for (const CrystalFace& other : shape.faces())
        EXPECT_LT(dot(other.normal, corner) - other.distance, 1e-10 * shape.maximum_dimension());
  }
  EXPECT_LT(length(sum), 1e-9 * shape.surface());
}

HabitSettings pyramidal(double aspect_ratio, double upper, double lower) {
  HabitSettings habit;
  habit.aspect_ratio = aspect_ratio;
  habit.upper.height = upper;
  habit.lower.height = lower;
  return habit;
}

}  // namespace

TEST(CrystalShape, PrismHasTheAreasOfItsClosedForm) {
  for (const double aspect : {1e-4, 0.05, 0.5, 1.0, 2.0, 30.0, 1e4}) {
    const CrystalShape prism = make_crystal({.aspect_ratio = aspect}, 100);
    // Diameter 2a of the base, length L: D^2 = (2a)^2 + L^2.
    const double a = 50 / std::hypot(1.0, aspect), length = 2 * a * aspect;
    const double base = 1.5 * std::sqrt(3.0) * a * a;
    EXPECT_NEAR(prism.maximum_dimension(), 100, 1e-9);
    EXPECT_NEAR(prism.surface() / (2 * base + 6 * a * length), 1, 1e-10) << aspect;
    EXPECT_NEAR(prism.volume() / (base * length), 1, 1e-10) << aspect;
    EXPECT_NEAR(prism.projected_area({0, 0, 1}) / base, 1, 1e-10) << aspect;
    EXPECT_NEAR(prism.projected_area({1, 0, 0}) / (2 * a * length), 1, 1e-10) << aspect;
    EXPECT_NEAR(prism.projected_area({0, -1, 0}) / (std::sqrt(3.0) * a * length), 1, 1e-10);
    EXPECT_EQ(numbers(prism), (std::set<int>{1, 2, 3, 4, 5, 6, 7, 8}));
    expect_closed(prism);
  }
}

TEST(CrystalShape, PyramidsHaveTheAnglesOfTheCrystal) {
  EXPECT_NEAR(degrees(angle_from_c_axis_rad(1, 1)), 28.0, 0.05);
  EXPECT_NEAR(degrees(angle_from_c_axis_rad(1, 2)), 46.75, 0.05);  // {1 0 -1 2}
  const CrystalShape crystal = make_crystal(pyramidal(0.5, 1, 1), 100);
  EXPECT_EQ(crystal.faces().size(), 18u);  // no basal faces
  for (const CrystalFace& face : crystal.faces()) {
    if (face.number < 10) continue;
    EXPECT_NEAR(std::fabs(face.normal.z), std::sin(angle_from_c_axis_rad(1, 1)), 1e-12);
    EXPECT_EQ(face.normal.z > 0, face.number < 20) << face.number;
    EXPECT_EQ(face.corners.size(), 3u) << face.number;
  }
  expect_closed(crystal);
}

TEST(CrystalShape, PyramidsHaveTheVolumeOfTheirClosedForm) {
  for (const double height : {0.3, 0.8, 1.0}) {
    const CrystalShape crystal = make_crystal(pyramidal(0.7, height, 0), 1);
    const CrystalShape prism = make_crystal({.aspect_ratio = 0.7}, 1);
    // Of a pyramid over the same base; what is cut from its tip is similar to it.
    const double side = 1.5 * std::sqrt(3.0), inscribed = 0.5 * std::sqrt(3.0);
    const double whole = side * inscribed / std::tan(angle_from_c_axis_rad(1, 1)) / 3;
    const double cap = whole * (1 - std::pow(1 - height, 3));
    // In units of the base's radius, found from the basal face 2.
    const auto base = [](const CrystalShape& shape) {
      for (const CrystalFace& face : shape.faces())
        if (face.number == 2) return face.area;
      return 0.0;
    };
    const double unit = std::sqrt(base(crystal) / side);
    EXPECT_NEAR(crystal.volume() / std::pow(unit, 3), side * 1.4 + cap, 1e-9) << height;
    EXPECT_NEAR(prism.volume() / std::pow(std::sqrt(base(prism) / side), 3), side * 1.4, 1e-9);
    EXPECT_EQ(numbers(crystal).count(1), height < 1 ? 1u : 0u);
    expect_closed(crystal);
  }
}

TEST(CrystalShape, BipyramidHasNoPrismFaces) {
  const CrystalShape crystal = make_crystal(pyramidal(0, 1, 1), 100);
  EXPECT_EQ(crystal.faces().size(), 12u);
  EXPECT_EQ(*numbers(crystal).begin(), 13);
  expect_closed(crystal);
  expect_closed(make_crystal(pyramidal(0, 0.4, 0.9), 100));
}

TEST(CrystalShape, AllFacesOfTheTruncatedOneAppear) {
  const CrystalShape crystal = make_crystal(pyramidal(0.4, 0.5, 0.6), 100);
  EXPECT_EQ(crystal.faces().size(), 20u);
  expect_closed(crystal);
}

TEST(CrystalShape, TrianglesAreTruncatedHexagons) {
  HabitSettings habit{.aspect_ratio = 0.3};
  for (const double t : {1.3, 1.9, 2.0, 2.5}) {
    habit.side_distances = {1, t, 1, t, 1, t};
    const CrystalShape crystal = make_crystal(habit, 100);
    EXPECT_EQ(crystal.faces().size(), t < 2 ? 8u : 5u) << t;
    expect_closed(crystal);
  }
}

TEST(CrystalShape, IrregularPyramidsClose) {
  HabitSettings habit = pyramidal(0.5, 1, 0.7);
  habit.side_distances = {1, 1.2, 0.9, 1.4, 1.1, 0.8};
  habit.lower.l = 2;
  const CrystalShape crystal = make_crystal(habit, 250);
  EXPECT_NEAR(crystal.maximum_dimension(), 250, 1e-9);
  expect_closed(crystal);
}

TEST(CrystalShape, FacesThatNeverAppearHaveNoArea) {
  std::vector<HalfSpace> planes = box(1, 2, 3);
  planes.push_back({{1, 1, 1}, 20, 7});  // far away
  planes.push_back({{1, 1, 0}, 3, 8});   // along an edge
  planes.push_back({{1, 1, 1}, 6, 9});   // through a corner
  planes.push_back({{2, 0, 0}, 2, 10});  // the same as the first
  const CrystalShape crystal(planes);
  EXPECT_EQ(crystal.faces().size(), 6u);
  EXPECT_NEAR(crystal.volume(), 48, 1e-10);
  EXPECT_NEAR(crystal.surface(), 88, 1e-10);
}

TEST(CrystalShape, RefusesWhatIsNoBody) {
  std::vector<HalfSpace> open = box(1, 1, 1);
  open.pop_back();
  EXPECT_THROW(CrystalShape{open}, Error);
  EXPECT_THROW(CrystalShape{std::span<const HalfSpace>()}, Error);
  std::vector<HalfSpace> empty = box(1, 1, 1);
  empty.push_back({{0, 0, 1}, -3, 7});
  EXPECT_THROW(CrystalShape{empty}, Error);
  std::vector<HalfSpace> flat = box(1, 1, 0);
  EXPECT_THROW(CrystalShape{flat}, Error);
  std::vector<HalfSpace> twice = box(1, 1, 1);
  twice[1].number = 1;
  EXPECT_THROW(CrystalShape{twice}, Error);
  std::vector<HalfSpace> nowhere = box(1, 1, 1);
  nowhere[0].distance = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(CrystalShape{nowhere}, Error);
}

TEST(CrystalHabit, NamesTheKeyThatIsWrong) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double aspect : {0.0, -1.0, nan, 1e9, 1e-9})
    EXPECT_NE(message({.aspect_ratio = aspect}).find("aspect_ratio"), std::string::npos) << aspect;
  HabitSettings habit;
  habit.side_distances[3] = 0;
  EXPECT_NE(message(habit).find("side_distances"), std::string::npos);
  EXPECT_NE(message(pyramidal(1, 1.2, 0)).find("pyramid height"), std::string::npos);
  EXPECT_NE(message(pyramidal(0, 1, 0)).find("aspect_ratio"), std::string::npos);
  EXPECT_THROW(make_crystal({}, nan), Error);
  EXPECT_THROW(make_crystal({}, 0), Error);
}

TEST(CrystalShape, MeanShadowIsAQuarterOfTheSurface) {
  const CrystalShape crystal = make_crystal(pyramidal(0.4, 0.5, 0.6), 1);
  const Orientations random({});
  Random numbers(statistics::test_seed(), 0, 0);
  statistics::Moments shadow, tilted;
  const Orientations plates({.type = "plate", .tilt_deg = 60});
  for (int i = 0; i < 200'000; ++i) {
    shadow.add(crystal.projected_area(random.draw(numbers).to_crystal({0, 0.6, -0.8})));
    tilted.add(crystal.projected_area(plates.draw(numbers).to_crystal({0, 0.6, -0.8})));
  }
  EXPECT_TRUE(statistics::mean_is(shadow, crystal.mean_projected_area()));
  // Even plates that wobble by 60 degrees are told apart.
  EXPECT_FALSE(statistics::mean_is(tilted, crystal.mean_projected_area()));
}

}  // namespace arcus::phase
