#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <mutex>

#include "phase/base/units.h"
#include "phase/population/map_rays.h"
#include "phase/population/map_smoother.h"
#include "phase/population/progress.h"
#include "phase/population/sine_nodes.h"
#include "phase/population/tabulate_crystals.h"

namespace arcus::phase {
namespace {

constexpr int absorbed_rays = 512;
/// Light may go straight on after many turns inside flat crystals; a map of few rays needs no better account.
constexpr int straight_events = 32;
int straight_rays(double map_rays) { return static_cast<int>(std::clamp(map_rays / 64, 2048.0, 65536.0)); }
constexpr std::uint64_t map_seed = 0x6d6170, account_seed = 0x616363;

/// A sum of planes that come in any order, added in their own, so that it is the same for any number of threads.
class SumInOrder {
 public:
  SumInOrder(std::size_t planes, std::size_t size) : waiting_(planes), sum_(size) {}
  void add(std::size_t which, std::vector<float> plane) {
    const std::lock_guard guard(mutex_);
    waiting_[which] = std::move(plane);
    for (; next_ < waiting_.size() && !waiting_[next_].empty(); ++next_) {
      for (std::size_t i = 0; i < sum_.size(); ++i) sum_[i] += waiting_[next_][i];
      waiting_[next_] = {};
    }
  }
  const std::vector<float>& sum() const { return sum_; }

 private:
  std::mutex mutex_;
  std::vector<std::vector<float>> waiting_;
  std::vector<float> sum_;
  std::size_t next_ = 0;
};

/// One task for each, however little it seems to be.
template <class Action>
void for_each(std::size_t count, const Action& action) {
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, count, 1),
      [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) action(i);
      },
      tbb::simple_partitioner());
}

/// A positive number with that many binary digits: far below the noise, and a file of such numbers is half as long.
float rounded(float value, int digits) {
  const std::uint32_t unit = 1u << (24 - digits);
  return std::bit_cast<float>((std::bit_cast<std::uint32_t>(value) + unit / 2) & ~(unit - 1));
}
constexpr int light_digits = 9, error_digits = 5;

void lay_out(OrientedTable& table, const CrystalTableSettings& settings, const SkyGrid& grid) {
  table.size_um = settings.size_um;
  for (const CrystalWave& wave : settings.waves) table.wavelength_nm.push_back(wave.wavelength_nm);
  for (int i = 0; i < sine_node_count; ++i) table.sine_elevation.push_back(sine_of_node(i));
  for (int i = 0; i <= grid.steps(); ++i) {
    table.elevation_deg.push_back(grid.elevation_deg(i));
    table.azimuth_deg.push_back(grid.azimuth_deg(i));
  }
  const std::size_t rows = table.size_um.size() * table.wavelength_nm.size();
  table.extinction_cross_section_m2.resize(rows * sine_node_count);
  table.forward_fraction.resize(rows * sine_node_count);
  table.mean_extinction_cross_section_m2.resize(rows);
  table.albedo.resize(rows);
  table.scattering_m2_per_sr.resize(table.size_um.size() * grid.size() * table.wavelength_nm.size());
  table.relative_error.resize(table.size_um.size() * grid.size());
}

constexpr double m2_from_um2 = 1e-12;

/// What goes straight on changes little and evenly with the wavelength, so it is traced at three of them, with rays enough.
class Straight {
 public:
  Straight(const CrystalPopulation& crystals, const std::vector<CrystalWave>& waves, const MapOptions& options,
           const std::vector<double>& sines, double map_rays, std::size_t size)
      : shadow_um2_(sines.size()) {
    MapOptions longer = options;
    longer.events = straight_events;
    pilots_ = {0};
    if (waves.size() > 2) pilots_.push_back(waves.size() / 2);
    if (waves.size() > 1) pilots_.push_back(waves.size() - 1);
    for (const std::size_t pilot : pilots_) n_.push_back(waves[pilot].n);
    share_.resize(pilots_.size() * sines.size());
    for_each(sines.size() * pilots_.size(), [&](std::size_t i) {
      const std::size_t sine = i / pilots_.size(), pilot = i % pilots_.size();
      // The same numbers at all wavelengths and sines: what they differ in is then physics.
      RandomColumns random(account_seed, size, 0);
      const RayAccount account = account_of(crystals, waves[pilots_[pilot]], longer, sines[sine], straight_rays(map_rays), random);
      share_[i] = account.straight / account.shadow;
      if (pilot == 0) shadow_um2_[sine] = account.shadow;
    });
  }
  double shadow_um2(std::size_t sine) const { return shadow_um2_[sine]; }
  /// Of the shadow: the parabola through the pilots, by the index.
  double share(std::size_t sine, double n) const {
    double sum = 0;
    for (std::size_t i = 0; i < n_.size(); ++i) {
      double factor = share_[sine * n_.size() + i];
      for (std::size_t k = 0; k < n_.size(); ++k)
        if (k != i && n_[k] != n_[i]) factor *= (n - n_[k]) / (n_[i] - n_[k]);
      sum += factor;
    }
    return distinct() ? std::clamp(sum, 0.0, 1.0) : share_[sine * n_.size()];
  }

 private:
  /// False for an ice whose index is the same at two pilots: no parabola.
  bool distinct() const {
    for (std::size_t i = 1; i < n_.size(); ++i)
      for (std::size_t k = 0; k < i; ++k)
        if (std::fabs(n_[i] - n_[k]) < 1e-6) return false;
    return true;
  }

  std::vector<std::size_t> pilots_;
  std::vector<double> n_, share_, shadow_um2_;  // share: [sine][pilot]
};

/// Extinction, what of it goes straight on, and the albedo of one row.
void account_row(const CrystalPopulation& crystals, const CrystalWave& wave, const MapOptions& options, bool diffraction,
                 const Straight& straight, std::size_t size, std::size_t wavelength, OrientedTable& table) {
  const std::size_t row = table.row(size, wavelength);
  double stopped = 0, absorbed = 0, width_before = 0;
  const auto& sines = table.sine_elevation;
  for (std::size_t i = 0; i < sines.size(); ++i) {
    const double shadow = straight.shadow_um2(i), extinction = (diffraction ? 2 : 1) * shadow;
    double forward = options.keep_straight ? 0 : straight.share(i, wave.n) * shadow;
    if (diffraction && !options.diffracted_light) forward += shadow;
    table.extinction_cross_section_m2[row * sines.size() + i] = m2_from_um2 * extinction;
    table.forward_fraction[row * sines.size() + i] = forward / extinction;
    RandomColumns random(account_seed, size, 1);
    const RayAccount account = account_of(crystals, wave, options, sines[i], absorbed_rays, random);
    // Directions are uniform in the sine; trapezoids.
    const double width_after = i + 1 < sines.size() ? sines[i + 1] - sines[i] : 0, width = 0.5 * (width_before + width_after);
    stopped += width * (extinction - forward);
    absorbed += width * account.absorbed;
    width_before = width_after;
  }
  const double mean_square = std::exp(options.size_spread * options.size_spread);
  table.mean_extinction_cross_section_m2[row] =
      m2_from_um2 * (diffraction ? 2 : 1) * mean_square * crystals.mean_projected_area_um2();
  table.albedo[row] = 1 - absorbed / stopped;
}

}  // namespace

MapOptions map_options_of(const CrystalTableSettings& settings, const CrystalPopulation& crystals) {
  const bool narrow = is_diffraction_narrow(crystals);
  MapOptions options;
  options.blur = settings.diffraction;
  // Where diffraction is wider than the sun's disc, light that goes straight on is blurred with it and stays in the map.
  options.keep_straight = !settings.remove_forward || (settings.diffraction && !narrow);
  options.diffracted_light = settings.diffraction && !(settings.remove_forward && narrow);
  options.size_spread = settings.size_spread;
  options.paths = settings.map_paths;
  return options;
}

OrientedTable tabulate_oriented_crystals(const CrystalTableSettings& settings, double sun_elevation_deg, double sun_angular_radius_deg,
                                         const std::function<void(double)>& progress) {
  const SkyGrid grid(settings.map_step_deg);
  OrientedTable table;
  table.sun_elevation_deg = sun_elevation_deg;
  table.sun_angular_radius_deg = sun_angular_radius_deg;
  lay_out(table, settings, grid);
  const std::size_t waves = settings.waves.size();
  Work work(progress, static_cast<double>(settings.size_um.size() * waves));
  for (std::size_t size = 0; size < settings.size_um.size(); ++size) {
    const CrystalPopulation crystals(settings.crystals, settings.size_um[size]);
    const MapOptions options = map_options_of(settings, crystals);
    MapOptions map_options = options;
    map_options.events = std::min(std::max(1, settings.map_paths.last_event()),
                                  sufficient_events(crystals, settings.waves[waves / 2], std::sin(radians(sun_elevation_deg))));
    const double mean_square = std::exp(settings.size_spread * settings.size_spread);
    const Straight straight(crystals, settings.waves, options, table.sine_elevation, settings.rays, size);
    std::vector<std::vector<float>> light(waves);  // by cell, a plane for each wavelength
    std::vector<double> scale(waves);
    SumInOrder all_light(waves, grid.size()), all_squares(waves, grid.size());
    for_each(waves, [&](std::size_t wavelength) {
      const CrystalWave& wave = settings.waves[wavelength];
      const SunLight sun(sun_elevation_deg, sun_angular_radius_deg, wave.wavelength_nm, settings.disc);
      std::vector<MapCell> cells(grid.size());
      RandomColumns random(map_seed, wavelength, static_cast<std::uint32_t>(size));
      RayAccount account;
      const double rays = add_rays(crystals, wave, map_options, sun, grid, settings.rays, random, cells, account);
      scale[wavelength] = m2_from_um2 * mean_square / rays;
      std::vector<float> squares(grid.size());
      light[wavelength].resize(grid.size());
      for (std::size_t at = 0; at < cells.size(); ++at) {
        light[wavelength][at] = cells[at].light;
        squares[at] = cells[at].squares;
      }
      all_light.add(wavelength, light[wavelength]);
      all_squares.add(wavelength, std::move(squares));
      account_row(crystals, wave, options, settings.diffraction, straight, size, wavelength, table);
      work.done(0.9);
    });
    const MapSmoother smoother(grid, all_light.sum(), all_squares.sum(), settings.map_noise);
    for (std::size_t at = 0; at < grid.size(); ++at)
      table.relative_error[size * grid.size() + at] = rounded(smoother.relative_error()[at], error_digits);
    for_each(waves, [&](std::size_t wavelength) {
      smoother.smooth(light[wavelength]);
      work.done(0.1);
    });
    for_each(grid.row(), [&](std::size_t row) {
      for (std::size_t at = row * grid.row(); at < (row + 1) * grid.row(); ++at)
        for (std::size_t wavelength = 0; wavelength < waves; ++wavelength)
          table.scattering_m2_per_sr[(size * grid.size() + at) * waves + wavelength] =
              rounded(static_cast<float>(scale[wavelength] * light[wavelength][at]), light_digits);
    });
  }
  return table;
}

}  // namespace arcus::phase
