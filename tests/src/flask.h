#pragma once
// Descartes' flask for tests: a globe of water before a screen with a hole, and where ray optics has its bow on the screen.

#include <algorithm>
#include <cmath>

#include "src/scene/scene.h"
#include "tests/src/simple_surfaces.h"

namespace arcus::render {

inline constexpr double globe_radius_m = 0.1, globe_distance_m = 1.6;

/// A scene without medium; sunlight along +y, no camera.
inline Scene surfaces_in_sun(SurfaceParts parts, const SunSettings& sun, double sky_radiance = 0) {
  return Scene{.medium = std::make_unique<media::Medium>(std::vector<media::Component>{}),
               .sun = Sun(sun, sun_irradiance(sun, "")),
               .sky = Sky({.type = "constant", .radiance = sky_radiance}, Curve({550}, {1}, "")),
               .surfaces = Surfaces(std::move(parts)),
               .camera = nullptr};
}

inline Scene flask(double sun_radius_deg = 0.02) {
  SurfaceParts parts;
  PieceGroup screen;
  screen.flats = {{Vec3(0), Vec3(0, 0, 2.5), Vec3(2.5, 0, 0), true, 0.12 / 2.5}};
  parts.add(std::move(screen), Material(Matte(0.8)));
  parts.add(one_sphere(Vec3(0, globe_distance_m, 0), globe_radius_m), water());
  return surfaces_in_sun(std::move(parts),
                         {.azimuth_deg = 180, .elevation_deg = 0, .angular_radius_deg = sun_radius_deg, .spectrum = "equal_energy"});
}

/// How far from the axis a ray that enters at `impact` of the globe's radius meets the screen after so many reflections within [m].
inline double screen_radius_m(double impact, double n, int reflections) {
  // In the plane of the ray: every chord goes on by π − 2 r around the centre; the ray leaves as steeply as it came.
  const double i = std::asin(impact), r = std::asin(impact / n);
  const double leaves_at = i + (reflections + 1) * (pi - 2 * r);  // angle at the centre from where the light comes from; it enters at i
  const double direction = leaves_at + i;
  const double x_m = globe_radius_m * std::sin(leaves_at), towards_m = globe_radius_m * std::cos(leaves_at);
  // Towards the light is towards the screen.
  return std::fabs(x_m + (globe_distance_m - towards_m) * std::tan(direction));
}

/// Where the bow ends on the screen [m]: the primary's outer edge, the secondary's inner one.
inline double bow_radius_m(double nm, int reflections) {
  const double n = phase::RefractiveIndex::water().relative_to_air(nm).real();
  double best = reflections == 1 ? 0 : 1e9;
  for (double impact = 0.6; impact < 0.999; impact += 1e-5) {
    const double at = screen_radius_m(impact, n, reflections);
    best = reflections == 1 ? std::max(best, at) : std::min(best, at);
  }
  return best;
}

}  // namespace arcus::render
