// Maps of chosen ray paths, lists of paths, and the places that halos' names stand at.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "phase/base/units.h"
#include "phase/crystal/named_halos.h"
#include "phase/crystal/path_symmetry.h"
#include "phase/optics/refractive_index.h"
#include "phase/population/path_census.h"
#include "tests/statistics/seed.h"

namespace arcus::phase {
namespace {

using statistics::test_seed;

constexpr double sun_deg = 20, nm = 550;

double ice() {
  static const double n = RefractiveIndex::ice().relative_to_air(nm).real();
  return n;
}

CrystalSettings crystals_without_tilt(const char* habit, const char* orientation, double aspect_ratio) {
  CrystalSettings crystals = crystals_of_habit(habit);
  crystals.habit.aspect_ratio = aspect_ratio;
  crystals.orientation = {.type = orientation, .tilt_deg = 0.05, .roll_deg = std::string(orientation) == "lowitz" ? 180 : 0.05};
  return crystals;
}

CrystalTableSettings settings_of(const CrystalSettings& crystals) {
  CrystalTableSettings settings;
  settings.crystals = crystals;
  settings.size_um = {200};
  settings.waves = {{nm, ice(), 0}};
  settings.diffraction = false;
  settings.rays = 2e5;
  return settings;
}

PathFilter all_like(const CrystalSettings& crystals, const char* text) {
  return {PathSymmetry(make_crystal(crystals.habit, 1)).equivalents(*FacePath::from_text(text)), {}};
}

/// Light by cell of rays that are the same for all filters.
std::vector<MapCell> map_of(const CrystalSettings& crystals, const PathFilter& paths, const SkyGrid& grid, int events = 10) {
  const CrystalPopulation population(crystals, 200);
  MapOptions options;
  options.paths = paths;
  options.events = events;
  std::vector<MapCell> cells(grid.size());
  RandomColumns random(test_seed(), 0, 0);
  RayAccount account;
  add_rays(population, {nm, ice(), 0}, options, SunLight(sun_deg, 0, nm), grid, 2e5, random, cells, account);
  return cells;
}

const NamedHalo* named(const std::vector<NamedHalo>& halos, const std::string& name) {
  const auto found = std::ranges::find(halos, name, &NamedHalo::name);
  return found == halos.end() ? nullptr : &*found;
}

TEST(MapPaths, ThreeFiveOfPlatesMakesParheliaAndNothingElse) {
  const CrystalSettings plates = crystals_without_tilt("plate", "plate", 1);
  const SkyGrid grid(0.5);
  const auto cells = map_of(plates, all_like(plates, "3-5"), grid, 1);
  const HaloPlace parhelion = named(named_halos(plates, ice(), sun_deg), "parhelion")->places[0];
  EXPECT_NEAR(parhelion.azimuth_deg, 24.6, 0.2);
  double sum = 0, near = 0;
  for (int row = 0; row <= grid.steps(); ++row)
    for (int column = 0; column <= grid.steps(); ++column) {
      const double light = cells[static_cast<std::size_t>(row) * grid.row() + static_cast<std::size_t>(column)].light;
      if (light == 0) continue;
      sum += light;
      EXPECT_NEAR(grid.elevation_deg(row), sun_deg, 0.75);
      EXPECT_GE(grid.azimuth_deg(column), parhelion.azimuth_deg - 0.75);
      // The tail ends where light grazes.
      EXPECT_LE(grid.azimuth_deg(column), 54);
      if (grid.azimuth_deg(column) < parhelion.azimuth_deg + 1.5) near += light;
    }
  EXPECT_GT(sum, 0);
  EXPECT_GT(near, 0.4 * sum);
}

TEST(MapPaths, ExclusiveFiltersAddUpToTheWhole) {
  for (const char* orientation : {"plate", "column", "random"}) {
    const CrystalSettings crystals = crystals_without_tilt("prism", orientation, 1);
    const SkyGrid grid(2);
    const PathFilter only = all_like(crystals, "3-5");
    const PathFilter without({}, PathSymmetry(make_crystal(crystals.habit, 1)).equivalents(*FacePath::from_text("3-5")));
    const auto whole = map_of(crystals, {}, grid), some = map_of(crystals, only, grid), rest = map_of(crystals, without, grid);
    double sum = 0, sum_of_some = 0;
    for (std::size_t at = 0; at < whole.size(); ++at) {
      ASSERT_NEAR(some[at].light + rest[at].light, whole[at].light, 1e-4 * whole[at].light) << orientation;
      sum += whole[at].light;
      sum_of_some += some[at].light;
    }
    EXPECT_GT(sum_of_some, 0.02 * sum) << orientation;
    EXPECT_LT(sum_of_some, 0.9 * sum) << orientation;
  }
}

TEST(MapPaths, FilteredTablesKeepTheExtinction) {
  CrystalTableSettings settings = settings_of(crystals_of_habit("plate"));
  settings.rays = 2e4;
  settings.map_step_deg = 2;
  const OrientedTable whole = tabulate_oriented_crystals(settings, sun_deg, 0.2666);
  settings.map_paths = all_like(settings.crystals, "1-3");
  const OrientedTable some = tabulate_oriented_crystals(settings, sun_deg, 0.2666);
  EXPECT_EQ(whole.extinction_cross_section_m2, some.extinction_cross_section_m2);
  EXPECT_EQ(whole.albedo, some.albedo);
  EXPECT_NE(whole.scattering_m2_per_sr, some.scattering_m2_per_sr);
}

/// What the list of paths says at the named place of a halo.
std::string brightest_at(const CrystalSettings& crystals, const char* halo, double sun = sun_deg) {
  const auto halos = named_halos(crystals, ice(), sun);
  const NamedHalo* found = named(halos, halo);
  if (!found) return "no such halo";
  const SkyPlace place{found->places[0].azimuth_deg, found->places[0].elevation_deg, 1};
  const PathSymmetry symmetry(make_crystal(crystals.habit, 1));
  const auto paths = paths_at(settings_of(crystals), sun, 0.2666, place, {1}, [&](const FacePath& path) { return symmetry.representative(path); });
  return paths.empty() ? "no light" : paths[0].path.text();
}

TEST(MapPaths, NamedHalosAreMadeByTheirPaths) {
  const CrystalSettings plates = crystals_without_tilt("plate", "plate", 1), columns = crystals_without_tilt("column", "column", 2),
                        parry = crystals_without_tilt("column", "parry", 2), lowitz = crystals_without_tilt("plate", "lowitz", 0.5);
  EXPECT_EQ(brightest_at(plates, "parhelion"), "3-5");
  EXPECT_EQ(brightest_at(plates, "circumzenithal arc"), "1-3");
  EXPECT_EQ(brightest_at(plates, "circumhorizontal arc", 65), "3-1");
  EXPECT_EQ(brightest_at(columns, "upper tangent arc"), "3-5");
  EXPECT_EQ(brightest_at(columns, "lower tangent arc"), "3-5");
  EXPECT_EQ(brightest_at(columns, "circumscribed halo", 50), "3-5");
  EXPECT_EQ(brightest_at(columns, "supralateral arc"), "3-1");
  EXPECT_EQ(brightest_at(columns, "infralateral arc"), "1-3");
  EXPECT_EQ(brightest_at(parry, "upper suncave Parry arc"), "3-5");
  EXPECT_EQ(brightest_at(parry, "upper sunvex Parry arc", 5), "3-5");
  EXPECT_EQ(brightest_at(lowitz, "upper Lowitz arc"), "3-5");
  EXPECT_EQ(brightest_at(lowitz, "lower Lowitz arc"), "3-5");
}

TEST(MapPaths, ListsAreTheSameForMirroredPlaces) {
  const CrystalSettings plates = crystals_without_tilt("plate", "plate", 1);
  const auto name_of = [](const FacePath& path) { return path; };
  const auto left = paths_at(settings_of(plates), sun_deg, 0.2666, {-25, sun_deg, 1}, {1}, name_of);
  const auto right = paths_at(settings_of(plates), sun_deg, 0.2666, {25, sun_deg, 1}, {1}, name_of);
  // Each path on one side is the mirrored one on the other.
  double there = 0, here = 0;
  const PathSymmetry symmetry(make_crystal(plates.habit, 1));
  const FacePath halo = *FacePath::from_text("3-5");
  for (const CountedPath& path : left) there += symmetry.representative(path.path) == halo ? path.light_m2_per_sr : 0;
  for (const CountedPath& path : right) here += symmetry.representative(path.path) == halo ? path.light_m2_per_sr : 0;
  EXPECT_GT(here, 0);
  EXPECT_NEAR(there / here, 1, 0.1);
}

TEST(NamedHalos, WhereTheyEnd) {
  const auto has = [](const char* habit, const char* name, double sun) { return named(named_halos(crystals_of_habit(habit), ice(), sun), name) != nullptr; };
  EXPECT_TRUE(has("plate", "circumzenithal arc", 32));
  EXPECT_FALSE(has("plate", "circumzenithal arc", 33));
  EXPECT_FALSE(has("plate", "circumhorizontal arc", 57));
  EXPECT_TRUE(has("plate", "circumhorizontal arc", 58.5));
  EXPECT_TRUE(has("plate", "parhelion", 60));
  EXPECT_FALSE(has("plate", "parhelion", 62));
  EXPECT_TRUE(has("column", "upper tangent arc", 28));
  EXPECT_FALSE(has("column", "circumscribed halo", 28));
  EXPECT_TRUE(has("column", "circumscribed halo", 31));
  EXPECT_TRUE(has("column", "infralateral arc", 67));
  EXPECT_FALSE(has("column", "infralateral arc", 69));
  EXPECT_TRUE(has("plate", "sun pillar", 1));
  EXPECT_FALSE(has("plate", "sun pillar", 20));
  const auto circles = named_halos(crystals_of_habit("pyramid"), ice(), sun_deg);
  for (const char* name : {"9° halo", "18° halo", "20° halo", "22° halo", "23° halo", "24° halo", "35° halo", "46° halo"})
    EXPECT_TRUE(named(circles, name)) << name;
  EXPECT_FALSE(named(named_halos(crystals_of_habit("prism"), ice(), sun_deg), "9° halo"));
}

}  // namespace
}  // namespace arcus::phase
