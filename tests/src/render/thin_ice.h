#pragma once
// Thin clouds of crystals under the sun, seen by single camera rays at 450, 550 and 650 nm: one scattering, no more.

#include <tbb/parallel_for.h>

#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "phase/base/frame.h"
#include "phase/optics/sun_disc.h"
#include "phase/species/make_species.h"
#include "src/integrator/volume_path.h"
#include "tests/statistics/seed.h"

namespace arcus::render {

inline constexpr int colours = 3;
inline constexpr std::array<double, colours> colour_nm{450, 550, 650};

/// Prisms of 500 µm that lie as told; rays without diffraction, in millions at each wavelength.
inline phase::Recipe ice_recipe(double aspect_ratio, const phase::OrientationSettings& lying, double rays_million = 3) {
  phase::Recipe recipe = phase::default_recipe("crystal");
  recipe.crystal.habit = {.aspect_ratio = aspect_ratio};
  recipe.crystal.orientation = lying;
  recipe.size_um = {500};
  recipe.wavelength_nm.assign(colour_nm.begin(), colour_nm.end());
  recipe.optics = "geometric";
  recipe.rays_million = rays_million;
  return recipe;
}

/// The sun stands in the north, white, one unit of irradiance at every wavelength; scale 0: off.
inline SunSettings ice_sun(double elevation_deg, double radius_deg = phase::mean_sun_radius_deg, double scale = 1) {
  return {.azimuth_deg = 0, .elevation_deg = elevation_deg, .angular_radius_deg = radius_deg, .spectrum = "equal_energy", .irradiance_scale = scale};
}

inline std::shared_ptr<const phase::Species> ice_species(const phase::Recipe& recipe, const SunSettings& sun) {
  return phase::make_species(recipe, {.sun_angular_radius_rad = radians(sun.angular_radius_deg), .sun_elevation_deg = sun.elevation_deg});
}

/// A block of crystals, 200 m wide and high; the camera is at the origin, in its middle, or `above_m` over that of a wider one.
struct ThinIce {
  SunSettings sun;
  std::vector<std::shared_ptr<const phase::Species>> species;
  double extinction_per_m = 2e-4;
  double above_m = 0;

  Scene scene() const {
    std::vector<media::Component> components;
    for (const auto& kind : species) {
      media::Component ice;
      ice.box = media::Box{Vec3(-1, -1, -1), Vec3(1, 1, 1)};
      ice.world_from_index = media::Affine::translation(Vec3(0, 0, -above_m)) * 
                            media::Affine::scaling(above_m > 0 ? Vec3(2000, 2000, 100) : Vec3(100));
      ice.extinction_scale = static_cast<float>(extinction_per_m);
      ice.size_um = 500;
      ice.species = kind;
      components.push_back(ice);
    }
    return Scene{.medium = std::make_unique<media::Medium>(std::move(components)),
                 .sun = Sun(sun, sun_irradiance(sun, "")),
                 .sky = Sky({}, Curve({550}, {1}, "")),
                 .surfaces = Surfaces(),
                 .camera = nullptr};
  }
};

/// A narrow picture across the sky: `along` [deg] goes its length, `across` its width, from -half_width to half_width.
struct Strip {
  double from, to, step, half_width;
  std::function<Vec3(double along, double across)> direction;
  std::function<std::array<double, 2>(const Vec3&)> place;  ///< the way back: along, across

  int pixels() const { return static_cast<int>(std::lround((to - from) / step)); }
  double middle(int pixel) const { return from + (pixel + 0.5) * step; }
};

inline double elevation_deg_of(const Vec3& v) { return degrees(std::atan2(v.z, std::hypot(v.x, v.y))); }
inline double azimuth_deg_of(const Vec3& v) { return degrees(std::atan2(v.x, v.y)); }

/// Along the horizon, around an elevation.
inline Strip level_strip(double elevation_deg, double from, double to, double half_width, double step = 0.04) {
  return {from, to, step, half_width, [=](double along, double across) { return direction_of(along, elevation_deg + across); },
          [=](const Vec3& v) { return std::array{azimuth_deg_of(v), elevation_deg_of(v) - elevation_deg}; }};
}
/// Upwards, at an azimuth. Elevations of more than 90 degrees lie beyond the zenith.
inline Strip upright_strip(double azimuth_deg, double from, double to, double half_width, double step = 0.04) {
  return {from, to, step, half_width, [=](double along, double across) { return direction_of(azimuth_deg + across, along); },
          [=](const Vec3& v) {
            return std::array{elevation_deg_of(v), std::remainder(azimuth_deg_of(v) - azimuth_deg, 360)};
          }};
}
/// Along circles around an axis: the angle between the axis and the strip is that of the sun, and `along` begins there.
inline Strip turned_strip(const Vec3& axis, const Vec3& sun, double from, double to, double half_width, double step = 0.04) {
  const Vec3 u = normalize(sun - axis * dot(axis, sun)), v = cross(axis, u);
  const double latitude = degrees(std::asin(dot(axis, sun)));
  return {from, to, step, half_width,
          [=](double along, double across) {
            const double a = radians(along), l = radians(latitude + across);
            return axis * std::sin(l) + (u * std::cos(a) + v * std::sin(a)) * std::cos(l);
          },
          [=](const Vec3& d) {
            return std::array{degrees(std::atan2(dot(d, v), dot(d, u))), degrees(std::asin(dot(d, axis))) - latitude};
          }};
}
/// By the distance from the sun, all around it.
inline Strip radial_strip(const Vec3& sun, double from, double to, double step = 0.04) {
  const Frame frame = frame_around(sun);
  return {from, to, step, 180,
          [=](double along, double across) {
            return direction_at(frame, std::pow(std::sin(radians(along) / 2), 2), radians(across));
          },
          [=](const Vec3& v) { return std::array{2 * degrees(std::asin(std::min(1.0, 0.5 * length(v - sun)))), 0.0}; }};
}

using Brightness = std::array<std::vector<double>, colours>;  ///< by pixel, for each wavelength

/// The strip as rendered; rays are spread evenly over each pixel's length and width.
inline Brightness rendered(const ThinIce& ice, const Strip& strip, int samples) {
  const Scene scene = ice.scene();
  const VolumePath integrator(scene, 1);
  const Wavelengths wavelengths{{550, 450, 650, 550}};
  Brightness result;
  for (auto& colour : result) colour.resize(static_cast<std::size_t>(strip.pixels()));
  tbb::parallel_for(0, strip.pixels(), [&](int pixel) {
    Spectrum sum;
    for (int i = 0; i < samples; ++i) {
      Random random(statistics::test_seed(), static_cast<std::uint64_t>(pixel), static_cast<std::uint32_t>(i));
      const FirstNumbers first = first_numbers(statistics::test_seed(), static_cast<std::uint64_t>(pixel), static_cast<std::uint32_t>(i));
      const Vec3 direction = strip.direction(strip.from + (pixel + first.pixel_x) * strip.step, (2 * first.pixel_y - 1) * strip.half_width);
      sum += integrator.radiance({Vec3(0, 0, 0), direction}, wavelengths, first, random);
    }
    const auto at = static_cast<std::size_t>(pixel);
    result[0][at] = sum[1] / samples;
    result[1][at] = sum[0] / samples;
    result[2][at] = sum[2] / samples;
  });
  return result;
}

}  // namespace arcus::render
