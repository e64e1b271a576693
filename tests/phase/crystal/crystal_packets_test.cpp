#include "phase/crystal/crystal_packets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

#include "phase/base/frame.h"
#include "phase/base/units.h"
#include "phase/crystal/crystal_habit.h"
#include "phase/crystal/crystal_rays.h"
#include "phase/crystal/orientations.h"
#include "tests/statistics/chi_square.h"
#include "tests/statistics/seed.h"
#include "tests/statistics/students_t.h"

namespace arcus::phase {
namespace {

using statistics::test_seed;

std::vector<CrystalShape> shapes() {
  HabitSettings pyramid{.aspect_ratio = 0.4};
  pyramid.upper.height = 0.6;
  pyramid.lower.height = 1;
  HabitSettings triangle{.aspect_ratio = 0.3};
  triangle.side_distances = {1, 1.6, 1, 1.6, 1, 1.6};
  HabitSettings odd = pyramid;
  odd.side_distances = {1, 1.2, 0.9, 2.5, 1.1, 0.8};
  return {make_crystal({.aspect_ratio = 0.7}, 100),
          make_crystal({.aspect_ratio = 1e-4}, 100),
          make_crystal({.aspect_ratio = 1e4}, 100),
          make_crystal(pyramid, 100),
          make_crystal(triangle, 100),
          make_crystal(odd, 100)};
}

Vec3 any_direction(Random& random) {
  return direction_in_cone(frame_around({0, 0, 1}), 1, random.uniform_double(),
                           random.uniform_double());
}

/// Rays with random directions, indices and numbers, all of which the reference may be given, too.
struct Rays {
  std::vector<Vec3> incoming;
  std::vector<double> n;
  std::vector<std::array<float, 3>> numbers;
};
Rays fill(CrystalBatch& batch, double absorption_per_length, Random& random) {
  Rays rays;
  for (int ray = 0; ray < batch.rays(); ++ray) {
    rays.incoming.push_back(any_direction(random));
    rays.n.push_back(1.3 + 0.02 * random.uniform());
    rays.numbers.push_back({random.uniform(), random.uniform(), random.uniform()});
    const auto& [face, u, v] = rays.numbers.back();
    batch.set(ray, rays.incoming.back(), rays.n.back(), absorption_per_length, face, u, v,
              random.bits());
  }
  return rays;
}

}  // namespace

TEST(CrystalPackets, AgreeWithTheReference) {
  Random random(test_seed(), 0, 0);
  for (const CrystalShape& shape : shapes())
    for (const double absorption : {0.0, 0.02}) {
      CrystalBatch batch(1000, 8);
      const Rays rays = fill(batch, absorption, random);
      CrystalPackets(shape).split(batch);
      int same = 0;
      for (int ray = 0; ray < batch.rays(); ++ray) {
        const auto at = static_cast<std::size_t>(ray);
        const CrystalRays tracer(shape, rays.n[at], absorption);
        const auto& [face, u, v] = rays.numbers[at];
        std::vector<CrystalExit> exits;
        const PowerAccount power =
            tracer.split(rays.incoming[at], tracer.entry(rays.incoming[at], face, u, v), 8, exits);
        EXPECT_NEAR(batch.projected_area(ray) / shape.projected_area(rays.incoming[at]), 1, 1e-5);
        bool agrees = std::fabs(batch.absorbed(ray) - power.absorbed) < 1e-5 &&
                      std::fabs(batch.cut_off(ray) - power.cut_off) < 1e-5;
        std::size_t next = 0;
        for (int event = 0; event <= 8 && agrees; ++event) {
          const Stokes light = batch.light(event, ray);
          if (light.i == 0) continue;
          if (next == exits.size() || exits[next].path != batch.path(event, ray)) {
            agrees = light.i < 1e-5;  // total reflection for one of them, nearly for the other
            continue;
          }
          const CrystalExit& exit = exits[next++];
          // Near grazing exit directions are steep functions of everything.
          const double tolerance = 1e-5 + 3e-6 / (1e-3 + exit.light.i);
          agrees = std::fabs(light.i - exit.light.i) < 1e-5 &&
                   length(batch.direction(event, ray) - exit.direction) < tolerance;
          // Axes are arbitrary straight on and straight back.
          if (length(cross(exit.direction, rays.incoming[at])) > 1e-2)
            agrees = agrees && std::fabs(light.q - exit.light.q) < 2e-5 &&
                     std::fabs(light.u - exit.light.u) < 2e-5 &&
                     std::fabs(light.v - exit.light.v) < 2e-5;
        }
        same += agrees;
      }
      // A ray that passes within rounding of an edge takes another way.
      EXPECT_GE(same, 985) << shape.faces().size() << " faces, " << absorption;
    }
}

TEST(CrystalPackets, LoseNoPower) {
  Random random(test_seed(), 0, 0);
  for (const CrystalShape& shape : shapes())
    for (const double absorption : {0.0, 0.02}) {
      CrystalBatch batch(1000, 10);
      fill(batch, absorption, random);
      CrystalPackets(shape).split(batch);
      for (int ray = 0; ray < batch.rays(); ++ray) {
        double sum = batch.absorbed(ray) + batch.cut_off(ray);
        for (int event = 0; event <= 10; ++event) {
          EXPECT_GE(batch.light(event, ray).i, -1e-7);
          sum += batch.light(event, ray).i;
        }
        EXPECT_NEAR(sum, 1, 1e-6);
      }
    }
}

// Needles, films, slivers, faces that nearly vanish, tips and cut tips.
TEST(CrystalPackets, LoseNoPowerWhateverTheHabit) {
  Random random(test_seed(), 0, 0);
  CrystalBatch batch(64, 10);
  for (int round = 0; round < 1000; ++round) {
    HabitSettings habit;
    habit.aspect_ratio = std::pow(10, -5 + 10 * random.uniform_double());
    for (double& distance : habit.side_distances) {
      const double kind = random.uniform_double();
      distance = kind < 0.1   ? 1000 * random.uniform_double() + 0.001
                 : kind < 0.4 ? 1
                              : 0.05 + 4 * random.uniform_double();
    }
    for (PyramidSettings* pyramid : {&habit.upper, &habit.lower}) {
      const double kind = random.uniform_double();
      pyramid->height = kind < 0.3 ? 0 : kind < 0.5 ? 1 : kind;
      pyramid->h = 1 + random.bits() % 3;
      pyramid->l = 1 + random.bits() % 3;
    }
    const CrystalShape shape = make_crystal(habit, 100);
    Vec3 sum(0);
    for (const CrystalFace& face : shape.faces()) sum += face.normal * face.area;
    EXPECT_LT(length(sum), 1e-6 * shape.surface()) << habit.aspect_ratio;
    fill(batch, 0.01, random);
    const CrystalPackets tracer(shape);
    tracer.split(batch);
    for (int ray = 0; ray < batch.rays(); ++ray) {
      double power = batch.absorbed(ray) + batch.cut_off(ray);
      for (int event = 0; event <= 10; ++event) power += batch.light(event, ray).i;
      EXPECT_NEAR(power, 1, 1e-6) << habit.aspect_ratio;
    }
    tracer.draw(batch);
    for (int ray = 0; ray < batch.rays(); ++ray) {
      EXPECT_GE(batch.light(0, ray).i, 0);
      EXPECT_LE(batch.light(0, ray).i + batch.cut_off(ray), 1.00001);
    }
  }
}

TEST(CrystalPackets, HaveEqualBitsOnAllProcessors) {
  if (best_instructions() != Instructions::avx512) GTEST_SKIP() << "no AVX-512 here";
  Random random(test_seed(), 0, 0);
  for (const CrystalShape& shape : shapes()) {
    CrystalBatch wide(500, 6);
    fill(wide, 0.01, random);
    CrystalBatch narrow(500, 6);
    const auto copy_and_compare = [&](int events) {
      for (int event = 0; event <= events; ++event)
        for (int k = 0; k < 7; ++k)
          EXPECT_EQ(std::memcmp(wide.column(event, k).data(), narrow.column(event, k).data(),
                                500 * sizeof(float)),
                    0);
      for (int ray = 0; ray < 500; ++ray) {
        EXPECT_EQ(wide.path(0, ray), narrow.path(0, ray));
        EXPECT_EQ(wide.cut_off(ray), narrow.cut_off(ray));
      }
    };
    Random again(test_seed(1), 0, 0);
    fill(wide, 0.01, again);
    Random once_more(test_seed(1), 0, 0);
    fill(narrow, 0.01, once_more);
    CrystalPackets(shape, Instructions::avx512).split(wide);
    CrystalPackets(shape, Instructions::avx2).split(narrow);
    copy_and_compare(6);
    CrystalPackets(shape, Instructions::avx512).draw(wide);
    CrystalPackets(shape, Instructions::avx2).draw(narrow);
    copy_and_compare(0);
  }
}

// Paths drawn by many rays that enter at one place, against their shares.
TEST(CrystalPackets, DrawsFollowTheShares) {
  const CrystalShape shape = make_crystal({.aspect_ratio = 0.6}, 100);
  const CrystalPackets tracer(shape);
  const CrystalRays reference(shape, 1.311);
  Random random(test_seed(), 0, 0);
  CrystalBatch batch(1024, 0);
  for (int place = 0; place < 4; ++place) {
    const Vec3 incoming = any_direction(random);
    const float face = random.uniform(), u = random.uniform(), v = random.uniform();
    std::vector<CrystalExit> exits;
    reference.split(incoming, reference.entry(incoming, face, u, v), 40, exits);
    std::map<FacePath, double> expected;
    for (const CrystalExit& exit : exits) expected[exit.path] += exit.light.i;
    std::map<FacePath, std::int64_t> found;
    for (int round = 0; round < 300; ++round) {
      for (int ray = 0; ray < batch.rays(); ++ray)
        batch.set(ray, incoming, 1.311, 0, face, u, v, random.bits());
      tracer.draw(batch);
      for (int ray = 0; ray < batch.rays(); ++ray) {
        ++found[batch.path(0, ray)];
        EXPECT_NEAR(batch.light(0, ray).i, 1, 1e-5);
      }
    }
    std::vector<double> shares;
    std::vector<std::int64_t> counts;
    std::vector<std::string> names;
    for (const auto& [path, share] : expected) {
      shares.push_back(share);
      counts.push_back(found[path]);
      names.push_back(path.text());
    }
    const auto name = [&](std::size_t i) { return names[i]; };
    std::int64_t outside = 300 * batch.rays();
    for (const auto count : counts) outside -= count;
    EXPECT_TRUE(statistics::chi_square(counts, outside, shares, name, 4));
    const auto strongest = std::max_element(shares.begin(), shares.end());
    const double moved = 0.01 * *strongest;
    *strongest -= moved;
    *(strongest == shares.begin() ? shares.end() - 1 : shares.begin()) += moved;
    EXPECT_FALSE(statistics::chi_square(counts, outside, shares, name, 4));
  }
}

// The mean of anything over drawn exits is that over all exits by their shares, absorption
// included.
TEST(CrystalPackets, DrawsHaveTheMeansOfTheSplit) {
  for (const CrystalShape& shape : shapes()) {
    const CrystalPackets tracer(shape);
    Random random(test_seed(), 0, 0);
    CrystalBatch split(1024, 20), drawn(1024, 0);
    statistics::Moments summed, sampled, polarised, polarised_sampled;
    for (int round = 0; round < 100; ++round) {
      fill(split, 0.005, random);
      fill(drawn, 0.005, random);
      tracer.split(split);
      tracer.draw(drawn);
      for (int ray = 0; ray < 1024; ++ray) {
        double sum = 0, q = 0;
        for (int event = 0; event <= 20; ++event) {
          sum += split.light(event, ray).i * split.direction(event, ray).z;
          q += split.light(event, ray).q * std::fabs(split.direction(event, ray).x);
        }
        summed.add(sum);
        polarised.add(q);
        sampled.add(drawn.light(0, ray).i * drawn.direction(0, ray).z);
        polarised_sampled.add(drawn.light(0, ray).q * std::fabs(drawn.direction(0, ray).x));
      }
    }
    EXPECT_TRUE(statistics::means_agree(summed, sampled, {.comparisons = 12, .tolerance = 1e-4}));
    EXPECT_TRUE(statistics::means_agree(polarised, polarised_sampled,
                                        {.comparisons = 12, .tolerance = 1e-4}));
  }
}

TEST(CrystalPackets, StopDrawingAfterSoManyFaces) {
  const CrystalShape shape = make_crystal({.aspect_ratio = 0.6}, 100);
  Random random(test_seed(), 0, 0);
  CrystalBatch batch(1000, 0);
  fill(batch, 0, random);
  CrystalPackets(shape).draw(batch, 2);
  int cut = 0;
  for (int ray = 0; ray < 1000; ++ray) {
    EXPECT_NEAR(batch.cut_off(ray) + batch.light(0, ray).i, 1, 1e-5);
    EXPECT_LE(batch.path(0, ray).length(), 3);
    cut += batch.cut_off(ray) > 0;
  }
  EXPECT_GT(cut, 50);
}

}  // namespace arcus::phase
