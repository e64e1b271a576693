#include "media/air/sky_source.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <tbb/parallel_for.h>

#include "media/air/air_march.h"
#include "media/air/harmonics.h"
#include "phase/base/frame.h"
#include "phase/base/quadrature.h"

namespace arcus::media {
namespace {

constexpr std::array<double, 17> heights_m{0, 250, 700, 1400, 2500, 4000, 6000, 8500, 11500, 15000, 19500, 25000, 32000, 41000, 55000, 80000, 120000};
/// Sun's zenith angles on both sides of the scene's: light comes from no farther than some hundred kilometres.
constexpr int zeniths_aside = 5;
constexpr double zenith_step_deg = 1.2;

/// Elevations above the horizon and below it, crowded there: squares of the nodes; and azimuths on one side of the sun.
constexpr int above_nodes = 9, below_nodes = 6, around_nodes = 8;
/// Until the light grows by less; what is missing is then added as a geometric series.
constexpr double enough = 2e-3;
constexpr int most_iterations = 30;

}  // namespace

double horizon_rad(const Atmosphere& air, double height_m) {
  const double height = std::max(0.0, height_m);
  return -2 * std::asin(std::sqrt(0.5 * height / (air.settings().planet_radius_m + height)));  // −acos(R / (R + h)) with all its digits
}

double share_of_sun(const Atmosphere& air, double height_m, double sun_zenith_cosine, double sun_radius_rad) {
  const double above = std::asin(std::clamp(sun_zenith_cosine, -1.0, 1.0)) - horizon_rad(air, height_m);
  return sun_radius_rad > 0 ? std::clamp(0.5 + 0.5 * above / sun_radius_rad, 0.0, 1.0) : above > 0 ? 1 : 0;
}

SkySource::SkySource(const Atmosphere& air, const SkyAir& optics, const SkySettings& settings) : air_(air), optics_(optics), settings_(settings) {
  const double zenith = std::acos(std::clamp(settings.to_sun.z, -1.0, 1.0));
  for (int i = -zeniths_aside; i <= zeniths_aside; ++i)
    if (const double angle = zenith + i * radians(zenith_step_deg); angle > -1e-12 && angle < pi) zenith_rad_.push_back(std::max(0.0, angle));
  height_m_.assign(heights_m.begin(), heights_m.end());
  terms_ = even_harmonic_count(optics.degree());
  solve();
}

Vec3 SkySource::up_at(const Vec3& position_m) const {
  Vec3 from_centre = position_m;
  from_centre.z += air_.settings().planet_radius_m;
  return from_centre.normalized();
}

double SkySource::sun_zenith_rad(const Vec3& up) const { return std::acos(std::clamp(dot(up, settings_.to_sun), -1.0, 1.0)); }

SkySource::Place SkySource::place(double height_m, double zenith_rad) const {
  const Vec3& sun = settings_.to_sun;
  const double level = std::hypot(sun.x, sun.y);
  const Vec3 towards = level > 1e-9 ? Vec3(sun.x / level, sun.y / level, 0) : Vec3(1, 0, 0);
  // Towards the sun it stands higher. Without the loss of digits of cos(angle) − 1 over a large planet.
  const double angle = std::acos(std::clamp(sun.z, -1.0, 1.0)) - zenith_rad, half = std::sin(0.5 * angle);
  const double radius = air_.settings().planet_radius_m + height_m;
  return {towards * (radius * std::sin(angle)) + Vec3(0, 0, height_m - 2 * half * half * radius),
          towards * std::sin(angle) + Vec3(0, 0, std::cos(angle)),
          towards * std::cos(angle) - Vec3(0, 0, std::sin(angle)),
          {-towards.y, towards.x, 0}};
}

SkyLanes SkySource::sunlight(const Vec3& position_m, double height_m) const {
  const double share = share_of_sun(air_, height_m, dot(up_at(position_m), settings_.to_sun), settings_.sun_radius_rad);
  if (share == 0) return {};
  return static_cast<float>(share) * transmittance(optics_.diffuse_depth(air_.columns({position_m, settings_.to_sun})));
}

SkySource::Corners SkySource::corners_of(double height_m, double zenith) const {
  const auto cell = [](const std::vector<double>& nodes, double x, float& share) {
    if (nodes.size() == 1) {
      share = 0;
      return std::size_t{0};
    }
    const auto above = std::upper_bound(nodes.begin() + 1, nodes.end() - 1, x);
    const std::size_t low = static_cast<std::size_t>(above - nodes.begin()) - 1;
    share = static_cast<float>(std::clamp((x - nodes[low]) / (nodes[low + 1] - nodes[low]), 0.0, 1.0));
    return low;
  };
  float up = 0, over = 0;
  const std::size_t low = cell(height_m_, height_m, up), left = cell(zenith_rad_, zenith, over);
  const std::size_t high = std::min(low + 1, height_m_.size() - 1), right = std::min(left + 1, zenith_rad_.size() - 1);
  const std::size_t row = zenith_rad_.size();
  return {{low * row + left, low * row + right, high * row + left, high * row + right},
          {(1 - up) * (1 - over), (1 - up) * over, up * (1 - over), up * over}};
}

template <int degree>
void SkySource::scatter(const Corners& corners, const Vec3& direction, SkyLanes& by_molecules, SkyLanes& by_haze) const {
  std::array<double, even_harmonic_count(degree)> y;
  even_harmonics<degree>(direction, y);
  for (int l = 0; l <= degree; ++l) {
    const auto molecular = static_cast<float>(optics_.molecular_moment(l));
    if (molecular == 0 && !optics_.has_haze()) continue;
    SkyLanes sum;
    for (int m = 0; m <= l; ++m) {
      const std::size_t term = even_harmonic_index(l, m);
      for (int corner = 0; corner < 4; ++corner)
        if (corners.weight[corner] != 0) sum.add(corners.weight[corner] * static_cast<float>(y[term]), light_[corners.node[corner] * terms_ + term]);
    }
    if (molecular != 0) by_molecules.add(molecular, sum);
    if (optics_.has_haze()) by_haze.add(optics_.haze_moment(l), sum);
  }
}

void SkySource::scattered(const Vec3& position_m, double height_m, const Vec3& direction, SkyLanes& by_molecules, SkyLanes& by_haze) const {
  const Vec3 up = up_at(position_m);
  const double sun_cosine = std::clamp(dot(settings_.to_sun, up), -1.0, 1.0);
  const Corners corners = corners_of(height_m, std::acos(sun_cosine));
  // The harmonics' z is up, and x towards the sun.
  const Vec3 level = settings_.to_sun - up * sun_cosine;
  const double size = length(level);
  const Vec3 towards = size > 1e-9 ? level * (1 / size) : frame_around(up).side;
  const double x = dot(direction, towards), z = dot(direction, up);
  const Vec3 local(x, std::sqrt(std::max(0.0, 1 - x * x - z * z)), z);
  by_molecules = by_haze = {};
  if (optics_.has_haze()) scatter<SkyAir::most_degree>(corners, local, by_molecules, by_haze);
  else scatter<2>(corners, local, by_molecules, by_haze);
}

SkyLanes SkySource::ground(const Vec3& position_m) const {
  if (settings_.ground_albedo == 0) return {};
  const Vec3 up = up_at(position_m);
  const Corners corners = corners_of(0, sun_zenith_rad(up));
  SkyLanes light = static_cast<float>(std::max(0.0, dot(up, settings_.to_sun))) * sunlight(position_m, 0);
  for (int corner = 0; corner < 2; ++corner) light.add(corners.weight[corner], irradiance_[corners.node[corner]]);
  return static_cast<float>(settings_.ground_albedo / pi) * light;
}

std::vector<SkySource::Direction> SkySource::directions_at(double height_m) const {
  const double horizon = horizon_rad(air_, height_m);
  std::vector<Direction> directions;
  const auto add = [&](int count, double farthest_rad) {
    const Quadrature rule = gauss_legendre(count);
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const double t = 0.5 * (1 + rule.nodes[i]), e = horizon + t * t * (farthest_rad - horizon);
      const double weight = 0.5 * rule.weights[i] * 2 * t * std::fabs(farthest_rad - horizon) * std::cos(e) * (2 * pi / around_nodes);
      for (int k = 0; k < around_nodes; ++k) {
        const double azimuth = pi * (k + 0.5) / around_nodes;
        directions.push_back({{std::cos(e) * std::cos(azimuth), std::cos(e) * std::sin(azimuth), std::sin(e)}, weight});
      }
    }
  };
  add(above_nodes, pi / 2);
  add(below_nodes, -pi / 2);
  return directions;
}

template <class Light>
void SkySource::gather(const Light& light, std::vector<SkyLanes>& harmonics, std::vector<SkyLanes>& irradiance) const {
  const std::size_t zeniths = zenith_rad_.size();
  tbb::parallel_for(std::size_t{0}, height_m_.size() * zeniths, [&](std::size_t node) {
    const double height = height_m_[node / zeniths];
    const Place here = place(height, zenith_rad_[node % zeniths]);
    std::array<double, even_harmonic_count(SkyAir::most_degree)> y;
    for (const Direction& direction : directions_at(height)) {
      const Vec3& part = direction.towards_aside_up;
      const SkyLanes radiance = light(here.position_m, here.towards * part.x + here.aside * part.y + here.up * part.z);
      even_harmonics<SkyAir::most_degree>(part, y);
      for (std::size_t term = 0; term < terms_; ++term) harmonics[node * terms_ + term].add(static_cast<float>(direction.weight_sr * y[term]), radiance);
      if (node < zeniths && part.z > 0) irradiance[node].add(static_cast<float>(direction.weight_sr * part.z), radiance);
    }
  });
}

void SkySource::solve() {
  const std::size_t nodes = height_m_.size() * zenith_rad_.size();
  std::vector<SkyLanes> once(nodes * terms_), next;
  irradiance_.assign(zenith_rad_.size(), {});
  std::vector<SkyLanes> irradiance_once(zenith_rad_.size()), irradiance_next;
  // Scattered once, and sunlight from the ground.
  gather(
      [&](const Vec3& position, const Vec3& direction) {
        const double cosine = dot(direction, settings_.to_sun);
        const float molecular_phase = SkyAir::molecular_phase_per_sr(cosine);
        const SkyLanes haze_phase = optics_.diffuse_haze_phase_per_sr(cosine);
        SkyLanes radiance;
        Dimming through;
        const MarchEnd end = march(air_, position, direction, [&](const AirStep& step) {
          SkyLanes scattered = molecular_phase * optics_.molecular_scattering(step.columns);
          if (optics_.has_haze()) scattered.add(optics_.diffuse_haze_scattering(step.columns), haze_phase);
          radiance.add(through.step(optics_.diffuse_depth(step.columns)), scattered * sunlight(step.middle_m, step.height_m));
          return true;
        });
        if (end.is_at_sea_level) radiance.add(through.left, ground(end.position_m));
        return radiance;
      },
      once, irradiance_once);
  light_ = once;
  irradiance_ = irradiance_once;
  double before = 0;
  for (int iteration = 1; iteration < most_iterations; ++iteration) {
    next = once;
    irradiance_next = irradiance_once;
    gather(
        [&](const Vec3& position, const Vec3& direction) {
          SkyLanes radiance;
        Dimming through;
          const MarchEnd end = march(air_, position, direction, [&](const AirStep& step) {
            SkyLanes by_molecules, by_haze;
            scattered(step.middle_m, step.height_m, direction, by_molecules, by_haze);
            SkyLanes light = optics_.molecular_scattering(step.columns) * by_molecules;
            if (optics_.has_haze()) light.add(optics_.diffuse_haze_scattering(step.columns), by_haze);
            radiance.add(through.step(optics_.diffuse_depth(step.columns)), light);
            return true;
          });
          if (end.is_at_sea_level && settings_.ground_albedo > 0) {
            // What of its light came from the sky; what came from the sun is in `once`.
            const Corners corners = corners_of(0, sun_zenith_rad(up_at(end.position_m)));
            SkyLanes light;
            for (int corner = 0; corner < 2; ++corner) light.add(corners.weight[corner], irradiance_[corners.node[corner]]);
            radiance.add(through.left, static_cast<float>(settings_.ground_albedo / pi) * light);
          }
          return radiance;
        },
        next, irradiance_next);
    // How much there is more: the mean over all directions at all places.
    double growth = 0, all = 0;
    for (std::size_t node = 0; node < nodes; ++node)
      for (int lane = 0; lane < sky_lane_count; ++lane) {
        growth += static_cast<double>(next[node * terms_][lane] - light_[node * terms_][lane]);
        all += static_cast<double>(next[node * terms_][lane]);
      }
    const bool is_enough = growth < enough * all;
    if (is_enough && before > 0 && growth > 0 && growth < before) {
      const auto rest = static_cast<float>(growth / (before - growth));  // r / (1 − r) of the last step
      for (std::size_t i = 0; i < next.size(); ++i)
        for (int lane = 0; lane < sky_lane_count; ++lane) next[i][lane] += rest * (next[i][lane] - light_[i][lane]);
      for (std::size_t i = 0; i < irradiance_next.size(); ++i)
        for (int lane = 0; lane < sky_lane_count; ++lane) irradiance_next[i][lane] += rest * (irradiance_next[i][lane] - irradiance_[i][lane]);
    }
    light_.swap(next);
    irradiance_.swap(irradiance_next);
    before = growth;
    if (is_enough) break;
  }
}

}  // namespace arcus::media
