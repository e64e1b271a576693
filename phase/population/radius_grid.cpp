#include "phase/population/radius_grid.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "phase/base/units.h"
#include "phase/optics/refractive_index.h"

namespace arcus::phase {
namespace {

constexpr double neglected_share = 1e-5;  // of the geometric cross-section
/// Beyond this size parameter steps no longer grow: sphere and light that passes it interfere with a period of about one.
constexpr double even_from = 100;
/// Least density of radii between and beside the bulk of the populations, relative to that within.
constexpr double least_density = 0.05;
constexpr double smallest_step = 0.002;      // in the size parameter
/// Step of the grid of large drops in ln r where populations have their bulk: at most this, and this share of the
/// narrowest population's width. Its square goes into the height of bows: 0.1 to 0.2 % for all widths.
constexpr double widest_large_step = 0.03, large_step_share = 0.1;
constexpr double least_large_density = 0.25, full_large_density_from = 0.25;  // the latter: share of a peak

bool is_one_size(const Sizes::Range& range) { return range.low_um == range.high_um; }

/// Cross-section per step of ln r, at most 1: where a population has its bulk.
class Bulk {
 public:
  explicit Bulk(const Sizes& sizes) : sizes_(sizes), range_(sizes.range_um(neglected_share)) {
    for (int i = 0; i <= 200; ++i) peak_ = std::max(peak_, raw(range_.low_um * std::pow(range_.high_um / range_.low_um, i / 200.0)));
  }
  double at(double radius_um) const { return raw(radius_um) / peak_; }
  const Sizes::Range& range() const { return range_; }

 private:
  double raw(double r) const { return r * r * r * sizes_.number_per_um(r); }
  const Sizes& sizes_;
  Sizes::Range range_;
  double peak_ = 0;
};

/// The axis of ln r between two radii with a density of radii on it.
class Axis {
 public:
  /// density(radius in µm): per step of ln r, above 0.
  template <class Density>
  Axis(double low_um, double high_um, const Density& density) : low_um_(low_um), high_um_(high_um) {
    for (int i = 0; i < steps; ++i)
      cumulative_.push_back(cumulative_.back() + density(radius_at((i + 0.5) / steps)) * std::log(high_um / low_um) / steps);
  }
  double integral() const { return cumulative_.back(); }
  /// As many radii, both ends included, each pair with the same integral between them.
  std::vector<double> cut(long long count) const {
    std::vector<double> radii;
    std::size_t step = 0;
    for (long long i = 0; i < count; ++i) {
      const double target = integral() * static_cast<double>(i) / static_cast<double>(count - 1);
      while (step + 1 < steps && cumulative_[step + 1] < target) ++step;
      const double within = (target - cumulative_[step]) / (cumulative_[step + 1] - cumulative_[step]);
      radii.push_back(radius_at((static_cast<double>(step) + within) / steps));
    }
    radii.front() = low_um_;
    radii.back() = high_um_;
    return radii;
  }

 private:
  static constexpr int steps = 4000;
  double radius_at(double t) const { return low_um_ * std::pow(high_um_ / low_um_, t); }
  double low_um_, high_um_;
  std::vector<double> cumulative_{0};
};

/// Largest share of any population's peak that lies at a radius, at least `least`.
double bulk_at(std::span<const Bulk> bulks, double radius_um, double least) {
  for (const Bulk& bulk : bulks)
    if (radius_um >= bulk.range().low_um && radius_um <= bulk.range().high_um)
      least = std::max(least, bulk.at(radius_um));
  return least;
}

/// Share of a population's own radii, as densely as waves need them, that lies below the border.
double wave_share(const Bulk& bulk, double border_um, double um_per_x) {
  const auto density = [&](double r) { return std::max(bulk.at(r), least_density) * (1 + r / um_per_x / even_from); };
  const auto [low, high] = bulk.range();
  if (high <= border_um) return 1;
  if (low >= border_um) return 0;
  return Axis(low, border_um, density).integral() / Axis(low, high, density).integral();
}

std::vector<double> wave_radii(std::span<const Bulk> bulks, double low_um, double high_um, double um_per_x,
                               long long count) {
  const Axis axis(low_um, high_um, [&](double r) {
    return bulk_at(bulks, r, least_density) * (1 + r / um_per_x / even_from);
  });
  // Where the populations lie mostly beyond the border, their tails need fewer radii than a whole population: their ripple is
  // diluted by the share of the tail, and goes down with the root of the number or faster.
  double share = 0;
  for (const Bulk& bulk : bulks) share = std::max(share, wave_share(bulk, high_um, um_per_x));
  const auto enough = static_cast<long long>(std::ceil(std::sqrt(share) * static_cast<double>(count)));
  const double most = (high_um - low_um) / um_per_x / smallest_step;
  return axis.cut(std::clamp<long long>(enough, 2, std::max(16LL, static_cast<long long>(most))));
}

std::vector<double> large_radii(std::span<const Bulk> bulks, double low_um, double high_um, double step) {
  const Axis axis(low_um, high_um, [&](double r) {
    return std::clamp(bulk_at(bulks, r, 0) / full_large_density_from, least_large_density, 1.0);
  });
  return axis.cut(std::max(5LL, 1 + static_cast<long long>(std::ceil(axis.integral() / step))));
}

/// Populations of one radius each: every radius is there, and counts in its own population alone.
RadiusGrids grids_of_single_radii(std::span<const Sizes> sizes, double border_um) {
  RadiusGrids grids;
  for (const Sizes& size : sizes) {
    const double r = size.effective_radius_um();
    (r <= border_um ? grids.wave : grids.large).radius_um.push_back(r);
  }
  const std::size_t waves = grids.wave.radius_um.size(), larges = grids.large.radius_um.size();
  grids.wave.weight.assign(sizes.size() * waves, 0);
  grids.large.weight.assign(sizes.size() * larges, 0);
  grids.wave.relative_step.assign(waves, 0);
  grids.large.relative_step.assign(larges, 0);
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    if (i < waves) grids.wave.weight[i * waves + i] = 1;
    else grids.large.weight[i * larges + i - waves] = 1;
  }
  return grids;
}

/// Radii in the neglected tails of a population count nothing: most sums then meet few populations.
void add_weights(const Sizes& sizes, const Sizes::Range& range, RadiusGrid& grid) {
  if (grid.radius_um.empty()) return;
  std::vector<double> weight = sizes.weights(grid.radius_um);
  for (std::size_t i = 0; i < weight.size(); ++i)
    if (grid.radius_um[i] < range.low_um * (1 - 1e-9) || grid.radius_um[i] > range.high_um * (1 + 1e-9)) weight[i] = 0;
  grid.weight.insert(grid.weight.end(), weight.begin(), weight.end());
}

void add_steps(RadiusGrid& grid) {
  const std::vector<double>& radii = grid.radius_um;
  for (std::size_t i = 0; i < radii.size(); ++i) {
    const std::size_t before = i == 0 ? 0 : i - 1, after = std::min(i + 1, radii.size() - 1);
    grid.relative_step.push_back((radii[after] - radii[before]) / static_cast<double>(after - before) / radii[i]);
  }
}

double squared_radii(const RadiusGrid& grid, std::size_t size) {
  double sum = 0;
  for (std::size_t i = 0, n = grid.radius_um.size(); i < n; ++i)
    sum += grid.weight[size * n + i] * grid.radius_um[i] * grid.radius_um[i];
  return sum;
}

void scale(RadiusGrid& grid, std::size_t size, double factor) {
  for (std::size_t i = 0, n = grid.radius_um.size(); i < n; ++i) grid.weight[size * n + i] *= factor;
}

}  // namespace

RadiusGrids radius_grids(std::span<const Sizes> sizes, double wavelength_nm, double border_size_parameter,
                         long long radii) {
  assert(!sizes.empty() && radii >= 2);
  const double um_per_x = 1 / size_parameter(1, wavelength_nm);
  const double border_um = border_size_parameter * um_per_x;
  if (is_one_size(sizes[0].range_um(neglected_share))) return grids_of_single_radii(sizes, border_um);
  const std::vector<Bulk> bulks(sizes.begin(), sizes.end());
  double low_um = bulks[0].range().low_um, high_um = bulks[0].range().high_um;
  for (const Bulk& bulk : bulks) {
    low_um = std::min(low_um, bulk.range().low_um);
    high_um = std::max(high_um, bulk.range().high_um);
  }
  RadiusGrids grids;
  if (low_um < border_um)
    grids.wave.radius_um = wave_radii(bulks, low_um, std::min(high_um, border_um), um_per_x, radii);
  if (high_um > border_um) {
    double step = widest_large_step;
    for (const Sizes& size : sizes) step = std::min(step, large_step_share * std::sqrt(size.effective_variance()));
    grids.large.radius_um = large_radii(bulks, std::max(low_um, border_um), high_um, step);
  }
  add_steps(grids.wave);
  add_steps(grids.large);
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    add_weights(sizes[i], bulks[i].range(), grids.wave);
    add_weights(sizes[i], bulks[i].range(), grids.large);
    const double share = (squared_radii(grids.wave, i) + squared_radii(grids.large, i)) / sizes[i].mean_power_um(2);
    scale(grids.wave, i, 1 / share);
    scale(grids.large, i, 1 / share);
  }
  return grids;
}

}  // namespace arcus::phase
