#include "phase/crystal/crystal_rays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "phase/base/error.h"
#include "phase/base/frame.h"
#include "phase/base/units.h"
#include "phase/crystal/crystal_habit.h"
#include "phase/optics/fresnel.h"
#include "tests/statistics/chi_square.h"
#include "tests/statistics/seed.h"
#include "tests/statistics/students_t.h"

namespace arcus::phase {
namespace {

using statistics::test_seed;

FacePath path(const char* text) { return *FacePath::from_text(text); }

Vec3 any_direction(Random& random) {
  return direction_in_cone(frame_around({0, 0, 1}), 1, random.uniform_double(),
                           random.uniform_double());
}

/// A prism with pyramids on both ends.
CrystalShape pyramid() {
  HabitSettings habit{.aspect_ratio = 0.4};
  habit.upper.height = 0.6;
  habit.lower.height = 1;
  return make_crystal(habit, 1);
}

std::size_t face_numbered(const CrystalShape& shape, int number) {
  const auto& faces = shape.faces();
  const auto found = std::find_if(faces.begin(), faces.end(),
                                  [&](const CrystalFace& face) { return face.number == number; });
  return static_cast<std::size_t>(found - faces.begin());
}

}  // namespace

TEST(CrystalRays, LoseNoPower) {
  Random random(test_seed(), 0, 0);
  std::vector<CrystalExit> exits;
  for (const CrystalShape& shape : {make_crystal({.aspect_ratio = 0.3}, 1), pyramid()})
    for (const double absorption : {0.0, 0.7}) {
      const CrystalRays tracer(shape, 1.311, absorption);
      for (int i = 0; i < 5000; ++i) {
        const Vec3 incoming = any_direction(random);
        exits.clear();
        const PowerAccount power =
            tracer.split(incoming, tracer.entry(incoming, random), 12, exits);
        EXPECT_NEAR(power.left + power.absorbed + power.cut_off, 1, 1e-12);
        EXPECT_LE(power.absorbed, absorption == 0 ? 1e-15 : 1);
        double sum = 0;
        for (const CrystalExit& exit : exits) {
          sum += exit.light.i;
          const Stokes& s = exit.light;
          EXPECT_LE(s.q * s.q + s.u * s.u + s.v * s.v, s.i * s.i * (1 + 1e-9));
          EXPECT_NEAR(length(exit.direction), 1, 1e-12);
        }
        EXPECT_NEAR(sum, power.left, 1e-14);
      }
    }
}

TEST(CrystalRays, EntriesFillTheShadowEvenly) {
  // Seen along the light each cell of the shadow gets as many entries as it covers.
  const CrystalShape shape = make_crystal({.aspect_ratio = 0.8}, 1);
  const CrystalRays tracer(shape, 1.31);
  const Vec3 incoming = normalize(Vec3(0.3, 0.5, -0.8));
  std::vector<double> shares;
  for (const CrystalFace& face : shape.faces())
    shares.push_back(std::fmax(0, -dot(face.normal, incoming)) * face.area /
                     shape.projected_area(incoming));
  std::vector<std::int64_t> counts(shares.size());
  Random random(test_seed(), 0, 0);
  Vec3 basal_mean(0);
  const std::size_t top = face_numbered(shape, 1);
  statistics::Moments square;
  for (int i = 0; i < 500'000; ++i) {
    const CrystalEntry entry = tracer.entry(incoming, random);
    ++counts[entry.face];
    EXPECT_NEAR(dot(shape.faces()[entry.face].normal, entry.place),
                shape.faces()[entry.face].distance, 1e-12);
    if (entry.face == top)
      square.add(entry.place.x * entry.place.x + entry.place.y * entry.place.y);
  }
  const auto name = [&](std::size_t i) { return std::to_string(shape.faces()[i].number); };
  EXPECT_TRUE(statistics::chi_square(counts, 0, shares, name, 2));
  // <r^2> of a regular hexagon is 5/12 of its radius squared.
  const double radius2 = squared_length(shape.faces()[top].corners[0]) -
                         shape.faces()[top].distance * shape.faces()[top].distance;
  EXPECT_TRUE(statistics::mean_is(square, radius2 * 5 / 12, {.comparisons = 2}));
  std::swap(shares[0], shares[1]);
  EXPECT_FALSE(statistics::chi_square(counts, 0, shares, name));
}

TEST(CrystalRays, PlateAtNormalIncidenceIsAStackOfReflections) {
  const CrystalShape shape = make_crystal({.aspect_ratio = 0.1}, 1);
  const double n = 1.311, a = 0.9, reflectance = std::pow((n - 1) / (n + 1), 2);
  const CrystalRays tracer(shape, n, a);
  std::vector<CrystalExit> exits;
  tracer.split({0, 0, -1}, {face_numbered(shape, 1), {0.01, 0.02, 0.5 * 0.1 / std::hypot(1, 0.1)}},
               3, exits);
  const double dimming = std::exp(-a * 0.1 / std::hypot(1, 0.1)), t = 1 - reflectance;
  ASSERT_EQ(exits.size(), 4u);
  EXPECT_NEAR(exits[0].light.i, reflectance, 1e-15);
  EXPECT_NEAR(exits[1].light.i, t * t * dimming, 1e-12);
  EXPECT_NEAR(exits[2].light.i, t * t * dimming * dimming * reflectance, 1e-12);
  EXPECT_NEAR(exits[3].light.i, t * t * std::pow(dimming, 3) * reflectance * reflectance, 1e-12);
  EXPECT_EQ(exits[1].path.text(), "1-2");
  EXPECT_EQ(exits[3].path.text(), "1-2-1-2");
  EXPECT_NEAR(exits[1].direction.z, -1, 1e-15);
  EXPECT_NEAR(exits[2].direction.z, 1, 1e-15);
}

TEST(CrystalRays, ParallelFacesDoNotTurnLight) {
  Random random(test_seed(), 0, 0);
  const CrystalShape shape = make_crystal({.aspect_ratio = 0.2}, 1);
  const CrystalRays tracer(shape, 1.311);
  std::vector<CrystalExit> exits;
  int found = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 incoming = any_direction(random);
    exits.clear();
    tracer.split(incoming, tracer.entry(incoming, random), 1, exits);
    if (exits.size() < 2 || (exits[1].path != path("1-2") && exits[1].path != path("3-6")))
      continue;
    ++found;
    EXPECT_LT(length(exits[1].direction - incoming), 1e-13);
  }
  EXPECT_GT(found, 200);
}

// A ray sent back the way it came leaves where the first one entered, with the same share of the
// power.
TEST(CrystalRays, RunBackwardsAlike) {
  Random random(test_seed(), 0, 0);
  const CrystalShape shape = pyramid();
  const CrystalRays tracer(shape, 1.311, 0.3);
  std::vector<CrystalExit> there, back;
  int compared = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 incoming = any_direction(random);
    const CrystalEntry entry = tracer.entry(incoming, random);
    there.clear();
    tracer.split(incoming, entry, 6, there);
    for (const CrystalExit& exit : there) {
      if (exit.light.i < 1e-6) continue;
      const int last = exit.path.face(exit.path.length() - 1);
      back.clear();
      tracer.split(-exit.direction, {face_numbered(shape, last), exit.place}, 6, back);
      const auto length_of = [](const CrystalExit& e) { return e.path.length(); };
      const auto same = std::find_if(back.begin(), back.end(), [&](const CrystalExit& e) {
        return length_of(e) == length_of(exit);
      });
      ASSERT_NE(same, back.end()) << exit.path.text();
      EXPECT_NEAR(same->light.i / exit.light.i, 1, 1e-7) << exit.path.text();
      EXPECT_LT(length(same->direction + incoming), 1e-8);
      EXPECT_LT(length(same->place - entry.place), 1e-8);
      ++compared;
    }
  }
  EXPECT_GT(compared, 2000);
}

// Light through a prism in its plane of symmetry never mixes polarisations: powers are products of
// Fresnel's.
TEST(CrystalRays, PolariseAsFresnelSays) {
  const CrystalShape shape = make_crystal({.aspect_ratio = 50}, 1);
  const double n = 1.31;
  const CrystalRays tracer(shape, n);
  const double incidence = std::asin(n * 0.5);  // least deviation
  const Vec3 incoming(-std::cos(incidence), std::sin(incidence), 0);
  const CrystalFace& face = shape.faces()[face_numbered(shape, 3)];
  std::vector<CrystalExit> exits;
  const double side = 0.5 * std::sqrt(3.0) / std::hypot(1, 50) / std::sqrt(3.0);
  tracer.split(incoming,
               {face_numbered(shape, 3), face.normal * face.distance + Vec3(0, 0.25 * side, 0.01)},
               2, exits);
  const auto found = std::find_if(exits.begin(), exits.end(),
                                  [](const CrystalExit& e) { return e.path == path("3-5"); });
  ASSERT_NE(found, exits.end());
  const FresnelReflectance r = fresnel_reflectance(std::cos(incidence), n);
  const double perpendicular = std::pow(1 - r.perpendicular, 2),
               parallel = std::pow(1 - r.parallel, 2);
  EXPECT_NEAR(found->light.i, 0.5 * (parallel + perpendicular), 1e-12);
  EXPECT_NEAR(found->light.q, 0.5 * (parallel - perpendicular), 1e-12);
  EXPECT_NEAR(found->light.u, 0, 1e-12);
  EXPECT_NEAR(degrees(angle_between_rad(incoming, found->direction)), degrees(2 * incidence) - 60,
              1e-9);
}

// Both ways through the tracer count the same light: chance by chance and share by share.
TEST(CrystalRays, DrawsFollowTheShares) {
  const CrystalShape shape = make_crystal({.aspect_ratio = 0.6}, 1);
  const CrystalRays tracer(shape, 1.311);
  const Vec3 incoming = normalize(Vec3(0.5, 0.3, -0.6));
  Random random(test_seed(), 0, 0);
  for (int place = 0; place < 4; ++place) {
    const CrystalEntry entry = tracer.entry(incoming, random);
    std::vector<CrystalExit> exits;
    tracer.split(incoming, entry, 100, exits);
    // Long paths go in circles: ways that the test cannot tell apart are one.
    const auto find = [&](const CrystalExit& exit) {
      return std::find_if(exits.begin(), exits.end(), [&](const CrystalExit& e) {
        return e.path == exit.path && squared_length(e.direction - exit.direction) < 1e-20;
      });
    };
    std::vector<double> shares(exits.size());
    for (const CrystalExit& exit : exits)
      shares[static_cast<std::size_t>(find(exit) - exits.begin())] += exit.light.i;
    std::vector<std::int64_t> counts(exits.size());
    for (int i = 0; i < 200'000; ++i) {
      const auto exit = tracer.draw(incoming, entry, random);
      ASSERT_TRUE(exit);
      EXPECT_NEAR(exit->light.i, 1, 1e-12);
      const auto same = find(*exit);
      ASSERT_NE(same, exits.end()) << exit->path.text();
      ++counts[static_cast<std::size_t>(same - exits.begin())];
    }
    const auto name = [&](std::size_t i) { return exits[i].path.text(); };
    EXPECT_TRUE(statistics::chi_square(counts, 0, shares, name, 4));
    // One part in a hundred moved from one way to another is noticed.
    const auto strongest = std::max_element(shares.begin(), shares.end());
    const double moved = 0.01 * *strongest;
    *strongest -= moved;
    shares[0] += moved;
    EXPECT_FALSE(statistics::chi_square(counts, 0, shares, name, 4));
  }
}

// What absorption leaves is a weight, not a chance.
TEST(CrystalRays, DrawsCarryWhatAbsorptionLeaves) {
  const CrystalShape shape = make_crystal({.aspect_ratio = 0.6}, 1);
  const CrystalRays tracer(shape, 1.311, 0.8);
  const Vec3 incoming = normalize(Vec3(0.5, 0.3, -0.6));
  Random random(test_seed(), 0, 0);
  statistics::Moments drawn, summed;
  std::vector<CrystalExit> exits;
  for (int i = 0; i < 200'000; ++i) {
    const CrystalEntry entry = tracer.entry(incoming, random);
    const auto exit = tracer.draw(incoming, entry, random);
    drawn.add(exit ? exit->light.i * exit->direction.z : 0);
    exits.clear();
    tracer.split(incoming, entry, 20, exits);
    double sum = 0;
    for (const CrystalExit& e : exits) sum += e.light.i * e.direction.z;
    summed.add(sum);
  }
  EXPECT_TRUE(statistics::means_agree(drawn, summed));
}

TEST(CrystalRays, RefuseWhatIsNoIce) {
  const CrystalShape shape = make_crystal({}, 1);
  EXPECT_THROW(CrystalRays(shape, 1), Error);
  EXPECT_THROW(CrystalRays(shape, std::nan("")), Error);
  EXPECT_THROW(CrystalRays(shape, 1.31, -1), Error);
}

}  // namespace arcus::phase
