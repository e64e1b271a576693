// Halos where the sky has them, from nothing but traced light.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "phase/base/frame.h"
#include "phase/base/units.h"
#include "phase/crystal/crystal_habit.h"
#include "phase/crystal/crystal_rays.h"
#include "phase/crystal/orientations.h"
#include "phase/optics/refractive_index.h"
#include "tests/statistics/seed.h"

namespace arcus::phase {
namespace {

using statistics::test_seed;

double ice(double wavelength_nm) {
  static const RefractiveIndex index = RefractiveIndex::ice();
  return index.relative_to_air(wavelength_nm).real();
}

Vec3 any_direction(Random& random) {
  return direction_in_cone(frame_around({0, 0, 1}), 1, random.uniform_double(),
                           random.uniform_double());
}

std::size_t face_numbered(const CrystalShape& shape, int number) {
  const auto& faces = shape.faces();
  const auto found = std::find_if(faces.begin(), faces.end(),
                                  [&](const CrystalFace& face) { return face.number == number; });
  return static_cast<std::size_t>(found - faces.begin());
}

/// Directions of travel of all light that leaves along some path, from crystals that lie as told
/// and a sun at that elevation in the north.
template <class Use>
void follow(const HabitSettings& habit, const OrientationSettings& lying, double n,
            double sun_elevation_deg, const char* wanted, int rays, Use use) {
  const CrystalShape shape = make_crystal(habit, 1);
  const CrystalRays tracer(shape, n);
  const Orientations orientations(lying);
  const Vec3 light = -direction_of(0, sun_elevation_deg);
  const FacePath chosen = *FacePath::from_text(wanted);
  Random random(test_seed(), 0, 0);
  std::vector<CrystalExit> exits;
  for (int i = 0; i < rays; ++i) {
    const Orientation lies = orientations.draw(random);
    const Vec3 incoming = lies.to_crystal(light);
    exits.clear();
    tracer.split(incoming, tracer.entry(incoming, random), 6, exits);
    for (const CrystalExit& exit : exits)
      if (exit.path == chosen) use(lies.to_world(exit.direction), exit.light);
  }
}

double elevation_deg(const Vec3& v) { return degrees(std::asin(v.z)); }
/// Of where the light seems to come from, relative to the sun's, 0 ... 180.
double azimuth_from_sun_deg(const Vec3& travels) {
  return degrees(std::fabs(std::atan2(travels.x, -travels.y)));
}

/// Least deviation of any path whose faces make the given wedge, from randomly oriented crystals;
/// the search is narrowed around the best rays found.
double least_deviation_deg(const CrystalShape& shape, double n, std::size_t first,
                           std::size_t last) {
  const CrystalRays tracer(shape, n);
  const Vec3 in = shape.faces()[first].normal, out = shape.faces()[last].normal;
  Random random(test_seed(), 0, 0);
  Vec3 best_direction = normalize(-in * 1.2 + out * 0.7);
  double best = 180;
  std::vector<CrystalExit> exits;
  for (double spread = 2; spread > 1e-5; spread *= 0.7)
    for (int i = 0; i < (spread > 1 ? 5000 : 300); ++i) {
      const Vec3 incoming = normalize(best_direction + any_direction(random) * spread);
      const double u = random.uniform_double(), v = random.uniform_double();
      const CrystalEntry entry = tracer.entry(incoming, random.uniform_double(), u, v);
      if (entry.face != first) continue;
      exits.clear();
      tracer.split(incoming, entry, 1, exits);
      if (exits.size() < 2 || exits[1].path.face(1) != shape.faces()[last].number) continue;
      const double turned = degrees(angle_between_rad(incoming, exits[1].direction));
      if (turned >= best) continue;
      best = turned;
      best_direction = incoming;
    }
  return best;
}

}  // namespace

// Inner edges of the 22 and 46 degree halos, computed independently of this code with the index in
// vacuum. Air brings them in by 0.03 and 0.08 degrees.
TEST(Halos, OfThePrismStandAtTheirEdges) {
  const struct {
    double nm, at_22, at_46;
  } halos[] = {{650, 21.69, 45.31}, {550, 21.91, 45.95}, {450, 22.27, 46.98}};
  const CrystalShape shape = make_crystal({.aspect_ratio = 1}, 1);
  const std::size_t side = face_numbered(shape, 3), over_next = face_numbered(shape, 5),
                    top = face_numbered(shape, 1);
  for (const auto& halo : halos) {
    const double in_air = ice(halo.nm), n = in_air * air_index(halo.nm);
    const double at_22 = least_deviation_deg(shape, n, side, over_next);
    const double at_46 = least_deviation_deg(shape, n, side, top);
    EXPECT_NEAR(at_22, halo.at_22, 0.006);
    EXPECT_NEAR(at_46, halo.at_46, 0.006);
    EXPECT_NEAR(at_22 - least_deviation_deg(shape, in_air, side, over_next), 0.028, 0.004);
    EXPECT_NEAR(at_46 - least_deviation_deg(shape, in_air, side, top), 0.082, 0.006);
  }
}

// Names and faces of the halos of pyramidal crystals: W. Tape and J. Moilanen (2006).
TEST(Halos, OfThePyramidHaveTheirRadii) {
  HabitSettings habit{.aspect_ratio = 0.4};
  habit.upper.height = habit.lower.height = 0.6;
  const CrystalShape shape = make_crystal(habit, 1);
  const struct {
    int in, out;
    double wedge_deg, radius_deg;
    int named;
  } halos[] = {{13, 6, 28.0, 8.97, 9},    {13, 25, 52.4, 18.31, 18}, {13, 16, 56.0, 19.95, 20},
               {3, 5, 60.0, 21.89, 22},   {1, 23, 62.0, 22.91, 23},  {13, 5, 63.8, 23.87, 24},
               {13, 15, 80.2, 35.01, 35}, {3, 1, 90.0, 45.87, 46}};
  for (const auto& halo : halos) {
    const std::size_t in = face_numbered(shape, halo.in), out = face_numbered(shape, halo.out);
    const double wedge =
        pi - angle_between_rad(shape.faces()[in].normal, shape.faces()[out].normal);
    EXPECT_NEAR(degrees(wedge), halo.wedge_deg, 0.05) << halo.named;
    const double found = least_deviation_deg(shape, ice(550), in, out);
    EXPECT_NEAR(found, halo.radius_deg, 0.011) << halo.named;
    EXPECT_EQ(std::lround(found), halo.named);
    // Least deviation in closed form.
    EXPECT_NEAR(found, degrees(2 * std::asin(ice(550) * std::sin(0.5 * wedge)) - wedge), 1e-3);
  }
}

// Bravais: in a plane at right angles to the edges light sees the index n' = sqrt(n^2 - sin^2 h) /
// cos h.
TEST(Halos, ParheliaStandAtTheSunsHeightAndTheirDistance) {
  const struct {
    double elevation, at_650, at_450;
  } parhelia[] = {{0, 21.69, 22.27}, {20, 24.41, 25.06}, {40, 36.07, 37.06}};
  for (const auto& parhelion : parhelia)
    for (const double nm : {650.0, 450.0}) {
      double nearest = 180;
      follow({.aspect_ratio = 2}, {.type = "plate", .tilt_deg = 0}, ice(nm) * air_index(nm),
             parhelion.elevation, "3-5", 100'000, [&](const Vec3& travels, const Stokes& light) {
               EXPECT_NEAR(elevation_deg(travels), -parhelion.elevation, 1e-9);
               if (light.i > 1e-3) nearest = std::min(nearest, azimuth_from_sun_deg(travels));
             });
      EXPECT_NEAR(nearest, nm == 650 ? parhelion.at_650 : parhelion.at_450, 0.01)
          << parhelion.elevation;
    }
}

TEST(Halos, CircumzenithalArcKeepsItsHeightAndEndsAtASunOf32Degrees) {
  const double n = ice(650);
  for (const double sun : {5.0, 15.0, 25.0, 31.0}) {
    int found = 0;
    const double expected =
        degrees(std::asin(std::sqrt(n * n - std::pow(std::cos(radians(sun)), 2))));
    follow({.aspect_ratio = 0.3}, {.type = "plate", .tilt_deg = 0}, n, sun, "1-3", 20000,
           [&](const Vec3& travels, const Stokes&) {
             ++found;
             EXPECT_NEAR(elevation_deg(-travels), expected, 1e-6);
           });
    EXPECT_GT(found, 50) << sun;
    // Angles from the zenith computed independently, with the index in vacuum.
    if (sun == 5) {
      EXPECT_NEAR(90 - expected, 32.1, 0.1);
    }
    if (sun == 15) {
      EXPECT_NEAR(90 - expected, 28.1, 0.1);
    }
  }
  for (const double sun : {33.0, 45.0, 70.0})
    follow({.aspect_ratio = 0.3}, {.type = "plate", .tilt_deg = 0}, n, sun, "1-3", 20000,
           [&](const Vec3&, const Stokes&) { ADD_FAILURE() << sun; });
}

TEST(Halos, CircumhorizontalArcNeedsASunAbove58Degrees) {
  const double n = ice(650);
  for (const double sun : {20.0, 50.0, 57.0})
    follow({.aspect_ratio = 0.3}, {.type = "plate", .tilt_deg = 0}, n, sun, "3-2", 5000,
           [&](const Vec3&, const Stokes&) { ADD_FAILURE() << sun; });
  for (const double sun : {59.0, 65.0, 80.0}) {
    int found = 0;
    const double lowered = n * n - std::pow(std::sin(radians(sun)), 2);
    follow({.aspect_ratio = 0.3}, {.type = "plate", .tilt_deg = 0}, n, sun, "3-2", 20000,
           [&](const Vec3& travels, const Stokes&) {
             ++found;
             EXPECT_NEAR(elevation_deg(-travels), degrees(std::acos(std::sqrt(lowered))), 1e-6);
           });
    EXPECT_GT(found, 20) << sun;
  }
}

TEST(Halos, ParhelicCircleKeepsTheSunsHeight) {
  for (const char* path : {"3", "1-3-2", "1-3-4-2"}) {
    double lowest = 180, highest = 0;
    int found = 0;
    follow({.aspect_ratio = 0.5}, {.type = "plate", .tilt_deg = 0}, ice(550), 25, path, 100'000,
           [&](const Vec3& travels, const Stokes&) {
             ++found;
             EXPECT_NEAR(elevation_deg(-travels), 25, 1e-9);
             lowest = std::min(lowest, azimuth_from_sun_deg(travels));
             highest = std::max(highest, azimuth_from_sun_deg(travels));
           });
    EXPECT_GT(found, 50) << path;
    // Two reflections at upright faces 60 degrees apart turn all light alike: the 120 degree
    // parhelion.
    if (std::string_view(path) == "1-3-4-2") {
      EXPECT_NEAR(lowest, 120, 1e-9);
      EXPECT_NEAR(highest, 120, 1e-9);
    } else {
      EXPECT_GT(highest - lowest, 20) << path;
    }
  }
}

TEST(Halos, SubsunIsTheSunsMirrorImage) {
  for (const char* path : {"1", "1-2-1"}) {
    int found = 0;
    follow({.aspect_ratio = 0.1}, {.type = "plate", .tilt_deg = 0}, ice(550), 25, path, 2000,
           [&](const Vec3& travels, const Stokes&) {
             ++found;
             EXPECT_NEAR(elevation_deg(-travels), -25, 1e-9);
             EXPECT_NEAR(azimuth_from_sun_deg(travels), 0, 1e-9);
           });
    EXPECT_GT(found, 500);
  }
}

// Light through the faces 60 degrees apart of columns that lie level; with the sun on the horizon
// straight above it.
TEST(Halos, TangentArcsTouchTheHalo) {
  double nearest = 180;
  follow({.aspect_ratio = 3}, {.type = "column", .tilt_deg = 0}, ice(550), 10, "3-5", 200'000,
         [&](const Vec3& travels, const Stokes&) {
           nearest = std::min(nearest, degrees(angle_between_rad(travels, -direction_of(0, 10))));
         });
  EXPECT_NEAR(nearest, 21.89, 0.02);
}

// In through the top, out through a slanting face below, a wedge of 60 degrees; straight above the
// sun the light stays in the plane at right angles to the crystal's edges.
TEST(Halos, ParryArcStandsAboveTheSun) {
  const double n = ice(550), sun = 20;
  const double inside = radians(60) - std::asin(std::sin(radians(90 - sun)) / n);
  const double expected = 90 + degrees(std::asin(n * std::sin(inside))) - 60;
  int found = 0;
  follow({.aspect_ratio = 3}, {.type = "parry", .tilt_deg = 0, .roll_deg = 0}, n, sun, "3-5",
         200'000, [&](const Vec3& travels, const Stokes&) {
           if (azimuth_from_sun_deg(travels) > 0.5) return;
           ++found;
           EXPECT_NEAR(elevation_deg(-travels), expected, 0.02);
         });
  EXPECT_GT(found, 50);
}

}  // namespace arcus::phase
