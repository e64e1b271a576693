// Scattering by populations of crystals, traced in packets, against numbers computed independently
// of this code.

#include <gtest/gtest.h>

#include <cmath>

#include "phase/base/frame.h"
#include "phase/base/units.h"
#include "phase/crystal/crystal_habit.h"
#include "phase/crystal/crystal_packets.h"
#include "phase/crystal/orientations.h"
#include "tests/statistics/seed.h"
#include "tests/statistics/students_t.h"

namespace arcus::phase {
namespace {

using statistics::Moments;
using statistics::test_seed;

constexpr double n = 1.311;
constexpr int rays = 256;

/// The regular prism whose base has the radius 1.
CrystalShape prism(double aspect_ratio) {
  return make_crystal({.aspect_ratio = aspect_ratio}, 2 * std::hypot(1.0, aspect_ratio));
}

/// Traces light of one direction through crystals that lie as told; use(weight, direction, path)
/// for everything that leaves. Weights of a ray sum up to the crystal's shadow; end() after every
/// batch.
template <class Use, class End>
void trace(const CrystalShape& shape, const Orientations& orientations, const Vec3& incoming,
           int batches, int which, Use use, End end) {
  const CrystalPackets tracer(shape);
  CrystalBatch batch(rays, 10);
  std::vector<Orientation> lies(rays);
  Random random(test_seed(static_cast<std::uint64_t>(which)), 0, 0);
  for (int round = 0; round < batches; ++round) {
    for (int ray = 0; ray < rays; ++ray) {
      lies[static_cast<std::size_t>(ray)] = orientations.draw(random);
      batch.set(ray, lies[static_cast<std::size_t>(ray)].to_crystal(incoming), n, 0, random);
    }
    tracer.split(batch);
    for (int event = 0; event <= batch.events(); ++event)
      for (int ray = 0; ray < rays; ++ray) {
        const double power = batch.column(event, CrystalBatch::i)[static_cast<std::size_t>(ray)];
        if (power <= 0) continue;
        use(power * batch.projected_area(ray),
            lies[static_cast<std::size_t>(ray)].to_world(batch.direction(event, ray)), event, ray,
            batch);
      }
    end();
  }
}

/// Differential cross-section [1/sr in the unit of length squared], mean over a cone around
/// `outgoing`.
Moments cross_section(const CrystalShape& shape, const Orientations& orientations,
                      const Vec3& incoming, const Vec3& outgoing, double cone_deg, int batches,
                      int which, double scale = 1) {
  const double limit = std::pow(std::sin(0.5 * radians(cone_deg)), 2), solid_angle = 4 * pi * limit;
  Moments moments;
  double sum = 0;
  trace(
      shape, orientations, incoming, batches, which,
      [&](double weight, const Vec3& direction, int, int, const CrystalBatch&) {
        if (sin2_half_angle(direction, outgoing) < limit) sum += weight;
      },
      [&] {
        moments.add(scale * sum / (rays * solid_angle));
        sum = 0;
      });
  return moments;
}

double mean_shadow(const CrystalShape& shape, const Orientations& orientations,
                   const Vec3& incoming) {
  Random random(test_seed(9), 0, 0);
  double sum = 0;
  for (int i = 0; i < 100'000; ++i)
    sum += shape.projected_area(orientations.draw(random).to_crystal(incoming));
  return sum / 100'000;
}

}  // namespace

TEST(CrystalScattering, OfRandomPrismsHasTheAsymmetryOfGeometricOptics) {
  const struct {
    double aspect, asymmetry, near_20, near_22, near_30;
  } prisms[] = {{1, 0.541, 0.050, 1.38, 0.199},
                {0.25, 0.713, 0.059, 0.66, 0.124},
                {2.5, 0.666, 0.046, 1.72, 0.274}};
  for (const auto& one : prisms) {
    const CrystalShape shape = prism(one.aspect);
    const Vec3 incoming(0, 0, -1);
    constexpr int batches = 2000;
    double cosine = 0, outside = 0, all = 0, at_20 = 0, at_22 = 0, at_30 = 0;
    Moments asymmetry, reflection, halo;
    const auto within = [](double angle, double from, double to) {
      return angle > from && angle < to;
    };
    const auto solid_angle = [](double from, double to) {
      return 2 * pi * (std::cos(radians(from)) - std::cos(radians(to)));
    };
    double total_20 = 0, total_30 = 0;
    trace(
        shape, Orientations({}), incoming, batches, 0,
        [&](double weight, const Vec3& direction, int event, int, const CrystalBatch&) {
          const double angle = degrees(angle_between_rad(incoming, direction));
          all += weight;
          cosine += weight * dot(incoming, direction);
          if (event == 0) outside += weight;
          if (within(angle, 19.5, 20.5)) at_20 += weight;
          if (within(angle, 22.0, 22.1)) at_22 += weight;
          if (within(angle, 29.5, 30.5)) at_30 += weight;
        },
        [&] {
          const double shadow = shape.mean_projected_area() * rays;
          asymmetry.add(cosine / shadow);
          reflection.add(outside / shadow);
          halo.add(at_22 / shadow / solid_angle(22.0, 22.1));
          total_20 += at_20 / shadow;
          total_30 += at_30 / shadow;
          cosine = outside = at_20 = at_22 = at_30 = 0;
        });
    // Ten faces from inside leave half a percent in the crystal.
    EXPECT_TRUE(
        statistics::mean_is(asymmetry, one.asymmetry, {.comparisons = 9, .tolerance = 0.004}))
        << one.aspect;
    EXPECT_TRUE(statistics::mean_is(reflection, 0.063, {.comparisons = 9, .tolerance = 0.0006}))
        << one.aspect;
    EXPECT_TRUE(statistics::mean_is(halo, one.near_22, {.comparisons = 9, .tolerance = 0.01}))
        << one.aspect;
    // The widths that these were averaged over are not known; at 30 degrees a tenth counts 2 %.
    EXPECT_NEAR(total_20 / batches / solid_angle(19.5, 20.5), one.near_20, 0.004) << one.aspect;
    EXPECT_NEAR(total_30 / batches / solid_angle(29.5, 30.5), one.near_30, 0.012) << one.aspect;
  }
}

// Plates of half-height 0.25 over the radius of their base, tilted by 2 degrees, sun at 20 degrees;
// in squares of that radius per steradian.
TEST(CrystalScattering, OfTiltedPlatesIsBrightWhereParheliaAre) {
  const CrystalShape plate = prism(0.25);
  const Orientations tilted({.type = "plate", .tilt_deg = 2});
  const Vec3 light = -direction_of(0, 20);
  const struct {
    double elevation, azimuth, expected, tolerance;
  } places[] = {
      {20, 25.5, 13.1, 0.15}, {20, 60, 0.66, 0.015}, {-20, 3, 3.81, 0.05}, {45, 10, 0, 0}};
  for (const auto& place : places) {
    const Moments found = cross_section(
        plate, tilted, light, -direction_of(place.azimuth, place.elevation), 1.5, 4000, 0);
    EXPECT_TRUE(statistics::mean_is(found, place.expected,
                                    {.comparisons = 4, .tolerance = place.tolerance}))
        << place.elevation << ' ' << place.azimuth;
  }
}

// Light exchanged with its way back: equal cross-sections, though not equal phase functions.
TEST(CrystalScattering, IsReciprocal) {
  const CrystalShape plate = prism(0.25);
  const Orientations tilted({.type = "plate", .tilt_deg = 10});
  const struct {
    double sun, elevation, azimuth;
  } pairs[] = {{20, -35, 8}, {20, 20, 27}, {15, -30, 5}};
  for (const auto& pair : pairs) {
    const Vec3 in = -direction_of(0, pair.sun), out = -direction_of(pair.azimuth, pair.elevation);
    const Moments there = cross_section(plate, tilted, in, out, 6, 2000, 0);
    const Moments back = cross_section(plate, tilted, -out, -in, 6, 2000, 1);
    const double tolerance = 0.02 * there.mean();
    EXPECT_TRUE(statistics::means_agree(there, back, {.comparisons = 4, .tolerance = tolerance}));
    if (pair.elevation != -35) continue;
    const double shadows = mean_shadow(plate, tilted, in) / mean_shadow(plate, tilted, -out);
    const Moments per_shadow = cross_section(plate, tilted, -out, -in, 6, 2000, 1, shadows);
    EXPECT_FALSE(
        statistics::means_agree(there, per_shadow, {.comparisons = 4, .tolerance = tolerance}));
  }
}

// A share of the light passes through two parallel faces as if nothing were there.
TEST(CrystalScattering, LetsLightThroughParallelFaces) {
  const struct { double aspect, share; } prisms[] = {{1, 0.24}, {0.25, 0.47}};
  for (const auto& one : prisms) {
    const CrystalShape shape = prism(one.aspect);
    const Vec3 incoming(0, 0, -1);
    double straight = 0;
    trace(
        shape, Orientations({}), incoming, 1000, 0,
        [&](double weight, const Vec3& direction, int event, int, const CrystalBatch&) {
          if (event == 1 && sin2_half_angle(incoming, direction) < 1e-10) straight += weight;
        },
        [] {});
    EXPECT_NEAR(straight / (1000 * rays * shape.mean_projected_area()), one.share, 0.01)
        << one.aspect;
  }
}

}  // namespace arcus::phase
