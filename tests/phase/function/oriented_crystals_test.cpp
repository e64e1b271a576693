#include "phase/function/oriented_crystals.h"

#include <gtest/gtest.h>

#include <cmath>

#include "phase/base/frame.h"
#include "phase/base/units.h"
#include "phase/function/phase_function.h"
#include "phase/optics/sun_disc.h"
#include "phase/population/sine_nodes.h"
#include "phase/species/species.h"

namespace arcus::phase {
namespace {

constexpr double sun_elevation_deg = 20, sun_radius_deg = 6;

/// Thick plates that wobble much, so that what they scatter is smooth.
CrystalTableSettings plates() {
  CrystalTableSettings settings;
  settings.crystals.habit.aspect_ratio = 0.3;
  settings.crystals.orientation = {.type = "plate", .tilt_deg = 12};
  settings.size_um = {500};
  settings.waves = {{500, 1.3130, 0}, {600, 1.3094, 0}};
  settings.rays = 8e5;
  settings.map_step_deg = 1;
  settings.map_noise = 0.015;
  return settings;
}

const OrientedCrystals& crystals() {
  static const OrientedCrystals made(plates(), tabulate_oriented_crystals(plates(), sun_elevation_deg, sun_radius_deg));
  return made;
}

Wavelengths all_at(float nm) {
  Wavelengths result;
  result.nm.fill(nm);
  return result;
}

/// Mean over the disc of the density of draws from `incoming`, weighted by the disc's darkening towards its limb; with its standard error.
struct Estimate {
  double mean, error;
};
Estimate by_drawing(const OrientedCrystals& c, const Vec3& incoming, const Vec3& to_centre, long long draws, double nm) {
  const DiscProfile disc(radians(sun_radius_deg));
  const double edge = std::pow(std::sin(radians(sun_radius_deg) / 2), 2);
  Random random(7, 1, 2);
  double sum = 0, squares = 0;
  for (long long i = 0; i < draws; ++i) {
    const auto ray = c.draw(0, incoming, nm, random);
    const double s = sin2_half_angle(ray.outgoing, to_centre);
    if (s >= edge) continue;
    const double value = ray.albedo * disc.relative_radiance(std::sqrt(s / edge), nm);
    sum += value;
    squares += value * value;
  }
  const auto n = static_cast<double>(draws);
  return {sum / n / disc.solid_angle_sr(), std::sqrt(squares - sum * sum / n) / n / disc.solid_angle_sr()};
}

TEST(OrientedCrystals, RaysDrawnFromTheViewerFindTheSunAsOftenAsTheMapSays) {
  const Vec3 to_centre = direction_of(50, sun_elevation_deg);
  const struct {
    double azimuth_deg, elevation_deg;
  } looks[] = {{50 + 25, 20}, {50 - 60, 25}, {50, 70}, {50, -20}, {50 + 115, 15}};
  for (const auto& look : looks) {
    const Vec3 incoming = direction_of(look.azimuth_deg, look.elevation_deg);
    for (const double nm : {500.0, 600.0}) {
      const double mapped = crystals().sunlit_value_per_sr(0, incoming, to_centre, all_at(static_cast<float>(nm)))[0];
      const Estimate drawn = by_drawing(crystals(), incoming, to_centre, 80'000, nm);
      // The map is smoothed, and its own noise is 1.5 %.
      EXPECT_NEAR(drawn.mean, mapped, 4 * drawn.error + 0.04 * mapped) << look.azimuth_deg << " " << look.elevation_deg << " " << nm;
      EXPECT_LT(drawn.error, 0.1 * mapped);
    }
  }
}

TEST(OrientedCrystals, TheSameIsNotTrueWithoutTheExtinctionOfTheViewersDirection) {
  const Vec3 to_centre = direction_of(0, sun_elevation_deg), incoming = direction_of(0, 70);
  const double at_sun = crystals().extinction_ratio(0, std::sin(radians(sun_elevation_deg)), 500);
  const double at_viewer = crystals().extinction_ratio(0, incoming.z, 500);
  const double wrong = crystals().sunlit_value_per_sr(0, incoming, to_centre, all_at(500))[0] * at_viewer / at_sun;
  const Estimate drawn = by_drawing(crystals(), incoming, to_centre, 80'000, 500);
  EXPECT_GT(std::fabs(drawn.mean - wrong), 4 * drawn.error + 0.03 * wrong);
}

TEST(OrientedCrystals, ExtinctionOfThinPlatesGoesWithTheSineOfElevation) {
  CrystalTableSettings settings = plates();
  settings.crystals.habit.aspect_ratio = 1e-3;
  settings.crystals.orientation.tilt_deg = 0;
  settings.waves = {{550, 1.3110, 0}};
  settings.rays = 1e5;
  settings.map_step_deg = 5;
  settings.remove_forward = false;
  const OrientedCrystals thin(settings, tabulate_oriented_crystals(settings, 30, 0.27));
  for (const double sine : {0.25, 0.5, 1.0}) EXPECT_NEAR(thin.extinction_ratio(0, sine, 550), 2 * sine, 0.01);
  EXPECT_NEAR(thin.mean_extinction_ratio(0, 550), 1, 2e-3);
}

TEST(OrientedCrystals, ASpeciesTellsExtinctionByDirectionAndItsBound) {
  CrystalTableSettings settings = plates();
  settings.rays = 2e5;
  settings.map_step_deg = 5;
  const Species species(std::make_unique<const OrientedCrystals>(settings, tabulate_oriented_crystals(settings, 20, 0.27)));
  ASSERT_TRUE(species.is_oriented());
  const int last = sine_node_count - 1;
  const float level = species.directed_extinction_ratio(500, 0, all_at(550))[0], steep = species.directed_extinction_ratio(500, last, all_at(550))[0];
  EXPECT_GT(steep, 0);
  EXPECT_GT(level, 0);
  EXPECT_LE(std::max(level, steep), species.largest_extinction_ratio());
  // Diffraction and what passes through parallel faces are left out: less than half of all is left.
  EXPECT_LT(species.extinction_ratio(500, all_at(550))[0], 0.5);
  EXPECT_EQ(species.albedo(500, all_at(550))[0], 1);
  EXPECT_TRUE(species.phase_function(500, 0.5f).includes_sun_disc());
}

TEST(OrientedCrystals, ADrawLeavesTheOtherWavelengthsWithoutWeight) {
  // Draws trace crystals; of the table they need next to nothing.
  CrystalTableSettings settings = plates();
  settings.rays = 1e4;
  settings.map_step_deg = 5;
  const OrientedCrystals coarse(settings, tabulate_oriented_crystals(settings, sun_elevation_deg, sun_radius_deg));
  const PhaseFunction function{OrientedLobe{&coarse, 0}};
  Random random(1, 2, 3);
  const Draw draw = function.draw(direction_of(10, 5), all_at(550), random);
  EXPECT_EQ(draw.density_per_sr[0], 1);
  EXPECT_EQ(draw.value_per_sr[0], 1);  // nothing is absorbed
  EXPECT_EQ(draw.density_per_sr[1], 0);
  EXPECT_NEAR(length(draw.outgoing), 1, 1e-9);
}

}  // namespace
}  // namespace arcus::phase
