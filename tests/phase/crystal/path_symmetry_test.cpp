#include "phase/crystal/path_symmetry.h"

#include <gtest/gtest.h>

#include "phase/crystal/crystal_habit.h"
#include "phase/crystal/crystal_population.h"
#include "phase/crystal/path_filter.h"

namespace arcus::phase {
namespace {

FacePath path(const char* text) { return *FacePath::from_text(text); }
PathSymmetry symmetry_of(const HabitSettings& habit) { return PathSymmetry(make_crystal(habit, 100)); }
PathSymmetry symmetry_of(const char* habit) { return symmetry_of(crystals_of_habit(habit).habit); }
bool are_equal(const PathSymmetry& symmetry, const char* a, const char* b) {
  return symmetry.representative(path(a)) == symmetry.representative(path(b));
}

TEST(PathSymmetry, RegularPrismsTurnMirrorAndStandOnTheirHeads) {
  for (const char* habit : {"plate", "column", "prism", "pyramid"}) {
    const PathSymmetry symmetry = symmetry_of(habit);
    EXPECT_EQ(symmetry.order(), 24) << habit;
    EXPECT_EQ(symmetry.equivalents(path("3-5")).size(), 12u) << habit;
    EXPECT_EQ(symmetry.equivalents(path("1-3")).size(), 12u) << habit;
    EXPECT_EQ(symmetry.representative(path("8-6")), path("3-5")) << habit;
    EXPECT_TRUE(are_equal(symmetry, "2-6", "1-3")) << habit;
    EXPECT_TRUE(are_equal(symmetry, "3-1-2-5", "7-2-1-5")) << habit;
    EXPECT_FALSE(are_equal(symmetry, "3-5", "3-6")) << habit;
    EXPECT_FALSE(are_equal(symmetry, "3-5", "3-4")) << habit;
    EXPECT_FALSE(are_equal(symmetry, "1-3", "3-1")) << habit;
  }
  EXPECT_EQ(symmetry_of("pyramid").representative(path("26-18")), symmetry_of("pyramid").representative(path("13-25")));
}

TEST(PathSymmetry, IrregularHabitsHaveTheirOwnAlone) {
  const PathSymmetry triangle = symmetry_of(HabitSettings{.aspect_ratio = 0.2, .side_distances = {1, 1.5, 1, 1.5, 1, 1.5}});
  EXPECT_EQ(triangle.order(), 12);
  EXPECT_TRUE(are_equal(triangle, "3-5", "7-5"));
  EXPECT_FALSE(are_equal(triangle, "3-5", "4-6"));
  const PathSymmetry bullet = symmetry_of("bullet");
  EXPECT_EQ(bullet.order(), 12);
  EXPECT_FALSE(are_equal(bullet, "13-5", "23-5"));
  EXPECT_TRUE(are_equal(bullet, "13-5", "16-4"));
  // Mirrored at its base's own axis and upside down.
  const PathSymmetry stretched = symmetry_of(HabitSettings{.aspect_ratio = 0.2, .side_distances = {1.3, 1, 1, 1, 1, 1}});
  EXPECT_EQ(stretched.order(), 4);
  EXPECT_TRUE(are_equal(stretched, "3-5", "3-7"));
  EXPECT_FALSE(are_equal(stretched, "3-5", "4-6"));
  const PathSymmetry odd = symmetry_of(HabitSettings{.aspect_ratio = 0.2, .side_distances = {1.2, 1, 1.1, 1, 0.95, 1}, .upper = {.height = 0.3}});
  EXPECT_EQ(odd.order(), 1);
  EXPECT_EQ(odd.equivalents(path("3-5")), std::vector<FacePath>{path("3-5")});
}

TEST(PathSymmetry, TheOriginOfTheDistancesDoesNotMatter) {
  // A regular hexagon moved by 0.1 along the normal of face 3.
  EXPECT_EQ(symmetry_of(HabitSettings{.side_distances = {1.1, 1.05, 0.95, 0.9, 0.95, 1.05}}).order(), 24);
}

TEST(PathSymmetry, LongPathsStayLong) {
  const PathSymmetry symmetry = symmetry_of("plate");
  const FacePath longer = path("4-1-2-1-2-1-2-1-2-1-2-1...");
  EXPECT_TRUE(symmetry.representative(longer).longer());
  EXPECT_EQ(symmetry.representative(longer), path("3-1-2-1-2-1-2-1-2-1-2-1..."));
}

TEST(PathFilter, OnlyAndWithout) {
  EXPECT_TRUE(PathFilter().lets_all_through());
  const PathFilter only({path("4-6"), path("3-5")}, {}), without({}, {path("3-5")}), both({path("3-5"), path("4-6")}, {path("3-5")});
  EXPECT_TRUE(only.lets_through(path("3-5")));
  EXPECT_FALSE(only.lets_through(path("3-1-5")));
  EXPECT_FALSE(only.lets_diffracted_light_through());
  EXPECT_EQ(only.last_event(), 1);
  EXPECT_FALSE(without.lets_through(path("3-5")));
  EXPECT_TRUE(without.lets_through(path("3")));
  EXPECT_TRUE(without.lets_diffracted_light_through());
  EXPECT_FALSE(both.lets_through(path("3-5")));
  EXPECT_TRUE(both.lets_through(path("4-6")));
  EXPECT_NE(only.text(), both.text());
  EXPECT_EQ(only.text(), PathFilter({path("3-5"), path("4-6")}, {}).text());
}

}  // namespace
}  // namespace arcus::phase
