// The shadow of a disc in clear air: what makes crepuscular rays. Light that was scattered once against a plain sum along the view, which asks at each
// step whether the disc stands before the sun; all orders by the table's region against all of the air traced.
// A quarter of a minute: labelled slow.

#include <gtest/gtest.h>

#include <cmath>

#include "media/air/air_walk.h"
#include "phase/base/frame.h"
#include "phase/base/units.h"
#include "phase/species/species_cache.h"
#include "src/scene/build_scene.h"
#include "tests/src/integrator/traced.h"

namespace arcus::render {
namespace {

constexpr double sun_elevation_deg = 40, disc_m = 2500, disc_height_m = 7000, shadow_at_m = 6000, view_elevation_deg = 10;
const media::Ray view{Vec3(0, 0, 2), direction_of(90, view_elevation_deg)};

/// The middle of a level disc whose shadow's middle meets the view at shadow_at_m.
Vec3 disc_centre_m() {
  const Vec3 place = view.at(shadow_at_m), to_sun = direction_of(0, sun_elevation_deg);
  return place + to_sun * ((disc_height_m - place.z) / to_sun.z);
}

Scene scene_with(bool has_disc, const std::string& method, const std::string& haze) {
  SceneSettings scene;
  scene.path = "test.toml";
  scene.camera.position_m = view.origin_m;
  scene.sun = {.azimuth_deg = 0, .elevation_deg = sun_elevation_deg, .spectrum = "equal_energy"};
  scene.sun.angular_radius_deg = 0.001;
  scene.sky.type = "clear";
  scene.sky.method = method;
  scene.sky.haze.type = haze;
  scene.sky.haze.optical_depth = haze == "none" ? 0 : 0.2;
  scene.sky.ground_albedo = 0.2;
  if (has_disc) {
    SurfaceSettings disc;
    disc.name = "disc";
    disc.shape.type = "disc";
    disc.shape.centre_m = disc_centre_m();
    disc.shape.radius_m = disc_m;
    disc.material.albedo = {0};
    scene.surfaces.push_back(disc);
  }
  return build_scene(scene, {.cache_folder = phase::default_cache_folder()});
}

/// Light scattered once by molecules; a step counts where nothing stands before the sun.
double plain_sum(const Scene& scene, double nm, bool has_disc) {
  const Wavelengths wavelengths = one_wavelength(nm);
  const media::AirOptics optics(wavelengths, nullptr);
  const Vec3 to_sun = scene.sun.to_centre(), middle = disc_centre_m();
  const phase::PhaseFunction by_air{phase::Rayleigh()};
  const auto depth = [&](const media::Ray& ray) { return static_cast<double>(optics.optical_depth(scene.air->columns(ray))[0]); };
  constexpr int steps = 40000;
  constexpr double end_m = 400000;
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    media::Ray way = view;
    way.farthest_m = (i + 0.5) * end_m / steps;
    const Vec3 place = view.at(way.farthest_m);
    const Vec3 at_disc = place + to_sun * ((disc_height_m - place.z) / to_sun.z) - middle;
    if (has_disc && place.z < disc_height_m && at_disc.length() < disc_m) continue;
    const media::AirColumns here = scene.air->density(scene.air->height_m(place));
    sum += end_m / steps * here.molecules_per_m2 * optics.scattering_m2[0] * std::exp(-depth(way) - depth({place, to_sun}));
  }
  return sum * static_cast<double>(by_air.value(view.direction, to_sun, wavelengths)[0] * scene.sun.irradiance_w_per_m2_nm(wavelengths)[0]);
}

}  // namespace

TEST(ShadowsInAir, LightScatteredOnceIsThatOfAPlainSum) {
  std::size_t number = 0;
  for (const double nm : {450.0, 620.0}) {
    const Scene lit = scene_with(false, "traced", "none"), shaded = scene_with(true, "traced", "none");
    const double expected = plain_sum(shaded, nm, true), without = plain_sum(lit, nm, false);
    const Moments found = traced(shaded, view, number++, one_wavelength(nm), 2000, 1);
    EXPECT_NEAR(found.mean(), expected, 4 * found.standard_error());
    EXPECT_LT(found.standard_error(), 0.005 * expected);
    EXPECT_LT(expected, 0.9 * without);
    const Moments all = traced(lit, view, number++, one_wavelength(nm), 2000, 1);
    EXPECT_NEAR(all.mean(), without, 4 * all.standard_error());
  }
}

TEST(ShadowsInAir, TheTablesRegionHasThem) {
  const auto at = [](const Scene& scene, std::size_t number) { return traced(scene, view, number, one_wavelength(550), 1200); };
  const Moments by_table = at(scene_with(true, "table", "continental"), 10), all_traced = at(scene_with(true, "traced", "continental"), 11);
  const Moments lit = at(scene_with(false, "table", "continental"), 12);
  EXPECT_NEAR(by_table.mean(), all_traced.mean(), 0.03 * all_traced.mean() + 3 * std::hypot(by_table.standard_error(), all_traced.standard_error()));
  EXPECT_LT(all_traced.standard_error(), 0.02 * all_traced.mean());
  EXPECT_LT(by_table.mean() + 4 * std::hypot(by_table.standard_error(), lit.standard_error()), lit.mean());
}

}  // namespace arcus::render
