#include "phase/population/path_census.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "phase/base/units.h"

namespace arcus::phase {
namespace {

constexpr std::uint64_t census_seed = 0x706c616365;

}  // namespace

std::vector<CountedPath> paths_at(const CrystalTableSettings& settings, double sun_elevation_deg, double sun_angular_radius_deg,
                                  const SkyPlace& place, const std::vector<double>& weights,
                                  const std::function<FacePath(const FacePath&)>& name_of) {
  const CrystalPopulation crystals(settings.crystals, settings.size_um.front());
  MapOptions options = map_options_of(settings, crystals);
  options.events = sufficient_events(crystals, settings.waves[settings.waves.size() / 2], std::sin(radians(sun_elevation_deg)));
  std::vector<LightByPath> found(settings.waves.size());
  std::vector<double> rays(settings.waves.size());
  tbb::parallel_for(std::size_t{0}, settings.waves.size(), [&](std::size_t w) {
    if (!(weights[w] > 0)) return;
    const SunLight sun(sun_elevation_deg, sun_angular_radius_deg, settings.waves[w].wavelength_nm, settings.disc);
    RandomColumns random(census_seed, w, 0);
    rays[w] = add_paths(crystals, settings.waves[w], options, sun, place, settings.rays, random, found[w]);
  });
  // By name in the order of names: sums that depend on no hash table.
  const double half_sine = std::sin(0.5 * radians(place.radius_deg)), sr = 4 * pi * half_sine * half_sine;
  const double mean_square = std::exp(settings.size_spread * settings.size_spread);
  struct Sum {
    double light = 0, squares = 0;
  };
  std::map<FacePath, Sum> sums;
  for (std::size_t w = 0; w < found.size(); ++w) {
    std::map<FacePath, PathLight> ordered(found[w].begin(), found[w].end());
    for (const auto& [path, light] : ordered) {
      const double factor = 1e-12 * mean_square * weights[w] / (rays[w] * sr);
      Sum& sum = sums[name_of(path)];
      sum.light += factor * light.light_um2;
      sum.squares += factor * factor * light.squares_um4;
    }
  }
  std::vector<CountedPath> paths;
  for (const auto& [path, sum] : sums) paths.push_back({path, sum.light, std::sqrt(sum.squares) / sum.light});
  std::ranges::stable_sort(paths, [](const CountedPath& a, const CountedPath& b) { return a.light_m2_per_sr > b.light_m2_per_sr; });
  return paths;
}

}  // namespace arcus::phase
