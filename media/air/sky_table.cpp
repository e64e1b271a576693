#include "media/air/sky_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <tbb/parallel_for.h>

#include "media/air/air_march.h"
#include "phase/base/frame.h"
#include "phase/optics/air.h"

namespace arcus::media {
namespace {

constexpr std::array<double, 18> heights_m{0, 15, 60, 200, 500, 1000, 1700, 2700, 4000, 6000, 9000, 13000, 18000, 25000, 35000, 50000, 75000, 120000};
/// How high the sun stands: at the origin and to both sides, no farther apart than this where places are.
constexpr double most_zenith_step_rad = 0.6 * pi / 180;
constexpr int most_zeniths_aside = 4;
/// Above the horizon, and below it; squares of even steps from it, where all changes fast.
constexpr std::size_t above_nodes = 36, below_nodes = 20, elevation_nodes = above_nodes + below_nodes;
constexpr std::size_t azimuth_nodes = 19;
/// From the horizon, so that a direction lies on one side of it [rad].
constexpr double aside_rad = 1e-7;

}  // namespace

SkyTable::SkyTable(const Atmosphere& air, std::shared_ptr<const Haze> haze, const SkySettings& settings, double highest_m, double farthest_m)
    : air_(air), haze_(std::move(haze)), optics_(haze_.get()), settings_(settings), scattering_m2_(phase::air_scattering_cross_section_m2(550)) {
  for (const double height : heights_m) {
    height_m_.push_back(height);
    thinness_.push_back(thinness(height));
    if (height >= highest_m) break;
  }
  const double zenith = std::acos(std::clamp(settings.to_sun.z, -1.0, 1.0));
  const double reach = farthest_m / air_.settings().planet_radius_m;
  const int aside = std::clamp(static_cast<int>(std::ceil(reach / most_zenith_step_rad)), 1, most_zeniths_aside);
  for (int i = -aside; i <= aside; ++i)
    if (const double angle = zenith + i * std::min(reach, aside * most_zenith_step_rad) / aside; angle > -1e-12 && angle < pi && (i == 0 || reach > 0))
      zenith_rad_.push_back(std::max(0.0, angle));
  const SkySource source(air_, optics_, settings_);
  values_.resize(height_m_.size() * zenith_rad_.size() * elevation_nodes * azimuth_nodes);
  tbb::parallel_for(std::size_t{0}, height_m_.size() * zenith_rad_.size() * elevation_nodes, [&](std::size_t row) {
    const std::size_t elevation = row % elevation_nodes, place = row / elevation_nodes;
    const double height = height_m_[place / zenith_rad_.size()], sun = zenith_rad_[place % zenith_rad_.size()], horizon = horizon_rad(air_, height);
    const bool is_above = elevation >= below_nodes;
    const double u = is_above ? static_cast<double>(elevation - below_nodes) / (above_nodes - 1) : static_cast<double>(below_nodes - 1 - elevation) / (below_nodes - 1);
    const double e = is_above ? horizon + aside_rad + u * u * (pi / 2 - horizon - aside_rad) : horizon - aside_rad - u * u * (pi / 2 + horizon - aside_rad);
    for (std::size_t azimuth = 0; azimuth < azimuth_nodes; ++azimuth)
      values_[row * azimuth_nodes + azimuth] = made(source, height, sun, e, pi * static_cast<double>(azimuth) / (azimuth_nodes - 1));
  });
}

SkyTable::Entry SkyTable::made(const SkySource& source, double height_m, double zenith_rad, double elevation_rad, double azimuth_rad) const {
  const SkySource::Place place = source.place(height_m, zenith_rad);
  const Vec3 direction = place.towards * (std::cos(elevation_rad) * std::cos(azimuth_rad)) + place.aside * (std::cos(elevation_rad) * std::sin(azimuth_rad)) +
                         place.up * std::sin(elevation_rad);
  Entry entry;
  Dimming through;
  const MarchEnd end = march(air_, place.position_m, direction, [&](const AirStep& step) {
    const SkyLanes mean = through.step(optics_.diffuse_depth(step.columns)), sun = mean * source.sunlight(step.middle_m, step.height_m);
    const SkyLanes molecules = optics_.molecular_scattering(step.columns);
    SkyLanes by_molecules, by_haze;
    source.scattered(step.middle_m, step.height_m, direction, by_molecules, by_haze);
    entry.molecules.add(molecules, sun);
    SkyLanes before = molecules * by_molecules;
    if (optics_.has_haze()) {
      entry.haze.add(optics_.haze_scattering(step.columns), sun);
      before.add(optics_.diffuse_haze_scattering(step.columns), by_haze);
    }
    entry.before.add(mean, before);
    return true;
  });
  if (end.is_at_sea_level) entry.before.add(through.left, source.ground(end.position_m));
  return entry;
}

Spectrum SkyTable::radiance(const Vec3& position_m, const Vec3& direction, const Wavelengths& wavelengths) const {
  const double height = std::max(0.0, air_.height_m(position_m));
  Vec3 up = position_m;
  up.z += air_.settings().planet_radius_m;
  up = up.normalized();
  const double sun_cosine = std::clamp(dot(up, settings_.to_sun), -1.0, 1.0), sine = std::clamp(dot(direction, up), -1.0, 1.0);
  const auto cell = [](const std::vector<double>& nodes, double x) -> Cell {
    if (nodes.size() == 1) return {0, 0};
    const auto above = std::upper_bound(nodes.begin() + 1, nodes.end() - 1, x);
    const std::size_t low = static_cast<std::size_t>(above - nodes.begin()) - 1;
    return {low, static_cast<float>(std::clamp((x - nodes[low]) / (nodes[low + 1] - nodes[low]), 0.0, 1.0))};
  };
  const Cell at_zenith = cell(zenith_rad_, std::acos(sun_cosine));

  // Azimuth from the sun.
  const Vec3 level = direction - up * sine, level_sun = settings_.to_sun - up * sun_cosine;
  const double lengths = length(level) * length(level_sun);
  const double azimuth = lengths > 1e-12 ? std::acos(std::clamp(dot(level, level_sun) / lengths, -1.0, 1.0)) : 0;
  const double a = azimuth / pi * (azimuth_nodes - 1);
  const Cell at_azimuth{std::min(static_cast<std::size_t>(a), azimuth_nodes - 2), static_cast<float>(a - static_cast<double>(std::min(static_cast<std::size_t>(a), azimuth_nodes - 2)))};

  // The place between nodes is on the same side of the horizon, and as far from it, at both heights.
  const double elevation = std::asin(sine), horizon = horizon_rad(air_, height);
  const bool is_above = elevation >= horizon;
  // What is seen upwards goes with the air above, what is seen below the horizon with the height.
  Cell at_height = cell(height_m_, height);
  const auto level_share = static_cast<float>(elevation >= 0 ? 1 : is_above ? 1 - elevation / horizon : 0);
  if (level_share > 0) at_height.share += level_share * (cell(thinness_, thinness(height)).share - at_height.share);
  const double u = is_above ? std::sqrt(std::max(0.0, (elevation - horizon) / (pi / 2 - horizon))) : std::sqrt(std::max(0.0, (horizon - elevation) / (pi / 2 + horizon)));
  const std::size_t side_nodes = is_above ? above_nodes : below_nodes;
  const double v = std::min(u, 1.0) * static_cast<double>(side_nodes - 1);
  const std::size_t step = std::min(static_cast<std::size_t>(v), side_nodes - 2);
  const auto rise = static_cast<float>(v - static_cast<double>(step));
  const std::size_t near = is_above ? below_nodes + step : below_nodes - 1 - step, far = is_above ? near + 1 : near - 1;

  struct Between {
    int low;
    float share;
  };
  std::array<Between, wavelength_count> lanes;
  static const double per_logarithm = (sky_lane_count - 1) / std::log(longest_wavelength_nm / shortest_wavelength_nm);
  for (int j = 0; j < wavelength_count; ++j) {
    const double place = std::log(static_cast<double>(wavelengths[j]) / shortest_wavelength_nm) * per_logarithm;
    const int low = std::clamp(static_cast<int>(place), 0, sky_lane_count - 2);
    lanes[static_cast<std::size_t>(j)] = {low, static_cast<float>(std::clamp(place - low, 0.0, 1.0))};
  }
  Spectrum molecules, haze, before;
  for (int corner = 0; corner < 16; ++corner) {
    const auto part = [&](int bit, const Cell& cell) { return corner & bit ? cell.share : 1 - cell.share; };
    const float weight = part(1, at_height) * part(2, at_zenith) * part(4, at_azimuth) * (corner & 8 ? rise : 1 - rise);
    if (weight == 0) continue;
    const Entry& entry = values_[index(at_height.low + (corner & 1 ? 1 : 0), at_zenith.low + (corner & 2 ? 1 : 0), corner & 8 ? far : near,
                                       at_azimuth.low + (corner & 4 ? 1 : 0))];
    for (int j = 0; j < wavelength_count; ++j) {
      const auto [low, share] = lanes[static_cast<std::size_t>(j)];
      const auto at = [&](const SkyLanes& values) { return weight * ((1 - share) * values[low] + share * values[low + 1]); };
      molecules[j] += at(entry.molecules);
      haze[j] += at(entry.haze);
      before[j] += at(entry.before);
    }
  }
  Spectrum light = before + molecules * SkyAir::molecular_phase_per_sr(dot(direction, settings_.to_sun));
  if (optics_.has_haze()) light += haze * optics_.haze_phase_per_sr(direction, settings_.to_sun, wavelengths);
  return light;
}

double SkyTable::thinness(double height_m) const {
  const AirColumns here = air_.density(height_m);
  const AirSettings& air = air_.settings();
  // Where there is no air at all: by the height.
  return 1e-13 * height_m - (here.molecules_per_m2 * air.molecule_scale_height_m * scattering_m2_ + here.haze_depth_550 * air.haze_scale_height_m);
}

std::size_t SkyTable::index(std::size_t height, std::size_t zenith, std::size_t elevation, std::size_t azimuth) const {
  return ((height * zenith_rad_.size() + zenith) * elevation_nodes + elevation) * azimuth_nodes + azimuth;
}

}  // namespace arcus::media
