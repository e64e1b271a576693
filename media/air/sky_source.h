#pragma once
// Light that air has scattered before, and what the ground returns: the source of all further light of the sky. Solved by iteration over places that
// differ in height and in how high the sun stands there; over directions as spherical harmonics, which scattering multiplies degree by degree.

#include <vector>

#include "media/air/sky_air.h"
#include "phase/base/vec3.h"

namespace arcus::media {

struct SkySettings {
  Vec3 to_sun{0, 0, 1};           ///< unit vector
  double sun_radius_rad = 0;      ///< of its disc, which sets gradually
  double ground_albedo = 0;       ///< of the planet, matte
};

/// Elevation of the sea's horizon from a height [rad]; at most 0.
double horizon_rad(const Atmosphere& air, double height_m);
/// Share of the sun's disc above the planet, from a place at that height [0 to 1]; the disc taken as evenly bright along its height.
double share_of_sun(const Atmosphere& air, double height_m, double sun_zenith_cosine, double sun_radius_rad);

class SkySource {
 public:
  SkySource(const Atmosphere& air, const SkyAir& optics, const SkySettings& settings);

  /// Sunlight at a place, dimmed by the air: share of what arrives outside. What haze sends straight on is in it.
  SkyLanes sunlight(const Vec3& position_m, double height_m) const;
  /// Scattered light per scattering cross section at a place, towards a path that comes along `direction` backwards, of what molecules and of what haze
  /// scatter: times scattering per metre it is radiance per metre, for unit irradiance by the sun [1/sr].
  void scattered(const Vec3& position_m, double height_m, const Vec3& direction, SkyLanes& by_molecules, SkyLanes& by_haze) const;
  /// Radiance of the ground [1/sr], for unit irradiance by the sun on a surface that faces it.
  SkyLanes ground(const Vec3& position_m) const;
  /// A place at that height where the sun stands so, with its axes: up, level towards the sun, and level aside.
  struct Place {
    Vec3 position_m, up, towards, aside;
  };
  Place place(double height_m, double zenith_rad) const;

 private:
  struct Corners {
    std::size_t node[4];
    float weight[4];
  };
  template <int degree>
  void scatter(const Corners& corners, const Vec3& direction, SkyLanes& by_molecules, SkyLanes& by_haze) const;
  Corners corners_of(double height_m, double sun_zenith_rad) const;
  double sun_zenith_rad(const Vec3& up) const;
  Vec3 up_at(const Vec3& position_m) const;
  struct Direction {
    Vec3 towards_aside_up;  ///< components along a place's axes
    double weight_sr;
  };
  /// Half of all directions, on one side of the sun's vertical plane, crowded around the horizon of a place; weights are for both halves.
  std::vector<Direction> directions_at(double height_m) const;
  /// Light from all directions at all nodes, as harmonics, and what of it falls on level ground: light(position, direction).
  template <class Light>
  void gather(const Light& light, std::vector<SkyLanes>& harmonics, std::vector<SkyLanes>& irradiance) const;
  void solve();

  const Atmosphere& air_;
  const SkyAir& optics_;
  SkySettings settings_;
  std::vector<double> height_m_, zenith_rad_;
  std::size_t terms_;                 ///< harmonics of a node
  std::vector<SkyLanes> light_;       ///< [height][zenith][term]
  std::vector<SkyLanes> irradiance_;  ///< [zenith] at sea level, of the sky alone
};

}  // namespace arcus::media
