#include "media/author/rain.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "media/author/noise.h"
#include "phase/base/error.h"
#include "phase/base/frame.h"
#include "phase/population/sizes.h"
#include "phase/settings/number_text.h"
#include "phase/settings/toml_text.h"
#include "phase/species/recipe.h"

namespace arcus::media {
namespace {

constexpr double water_kg_per_m3 = 998.2;
/// Rain below this share of the core's is left out.
constexpr double least_share = 0.003;
/// Fall speed of the drops that carry most of the rain (Atlas, Srivastava and Sekhon 1973, D = 2 mm) [m/s].
constexpr double fall_m_per_s = 6.5;
constexpr int edge = SparseGrid::brick_edge;

struct Drops {
  double extinction_per_m = 0, radius_um = 0, water_kg_per_m3 = 0;
};

Drops drops_of(double rain_mm_per_hour, const RainSettings& settings) {
  constexpr double n0_per_m4 = 8000 * 1e3;
  const double slope_per_m = 1e3 * phase::marshall_palmer_slope_per_mm(rain_mm_per_hour);
  Drops drops;
  drops.water_kg_per_m3 = pi * water_kg_per_m3 * n0_per_m4 / std::pow(slope_per_m, 4);
  drops.radius_um = settings.drops == "gamma"
                        ? settings.effective_radius_um * std::pow(rain_mm_per_hour / settings.rain_mm_per_hour, 0.21)
                        : phase::marshall_palmer_effective_radius_um(rain_mm_per_hour);
  drops.extinction_per_m = 1.5 * drops.water_kg_per_m3 / (water_kg_per_m3 * m_from_um(drops.radius_um));
  return drops;
}

double smooth_step(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// Rain rate at a place, over that in the core.
class RainField {
 public:
  explicit RainField(const RainSettings& settings)
      : settings_(settings), wind_(direction_of(settings.wind_azimuth_deg, 0)) {}

  double share(const Vec3& position_m) const {
    const double height_m = position_m.z - settings_.centre_m.z;
    if (height_m < 0 || height_m > settings_.cloud_base_m) return 0;
    // Where drops that are here now left the cloud: wind that grows linearly with height carries them along a parabola.
    const double below_m = settings_.cloud_base_m - height_m;
    const double mean_wind = settings_.wind_m_per_s * (1 + height_m / settings_.cloud_base_m) / 2;
    const Vec3 start = position_m - wind_ * (mean_wind * below_m / fall_m_per_s) +
                       wind_ * (settings_.wind_m_per_s / 2 * settings_.cloud_base_m / fall_m_per_s);
    const double x = (start.x - settings_.centre_m.x) / (settings_.width_m / 2);
    const double y = (start.y - settings_.centre_m.y) / (settings_.depth_m / 2);
    const auto seed = static_cast<std::uint32_t>(settings_.seed);
    // The border is ragged: noise moves it by some of its own width.
    const Vec3 plan(start.x / settings_.streak_size_m, start.y / settings_.streak_size_m, 0.5);
    const double ragged = 0.35 * settings_.edge * std::min(1.0, settings_.streaks) * fractal_noise(plan * 0.7, 3, 0.5, seed + 100);
    double share = smooth_step((1 - std::sqrt(x * x + y * y) + ragged) / settings_.edge);
    if (share <= 0) return 0;
    if (settings_.streaks > 0)  // log-normal, mean 1
      share *= std::exp(settings_.streaks * fractal_noise(plan, 4, 0.6, seed + 200) - 0.5 * settings_.streaks * settings_.streaks);
    if (settings_.turbulence > 0) {
      const double t = settings_.turbulence;
      share *= std::exp(t * fractal_noise(position_m / settings_.turbulence_size_m, 4, 0.6, seed + 300) - 0.5 * t * t);
    }
    share *= std::exp(-settings_.evaporation_per_km * 1e-3 * below_m);
    // Below the base the rain begins within a few voxels, softly and at uneven heights.
    const double ceiling_m = (0.04 + 0.04 * fractal_noise(plan * 0.5, 3, 0.5, seed + 400)) * settings_.cloud_base_m;
    return share * smooth_step((below_m - ceiling_m) / (0.12 * settings_.cloud_base_m));
  }

  /// Furthest that wind carries drops from above the middle of their path [m].
  Vec3 reach_m() const {
    const double most = settings_.wind_m_per_s / 2 * settings_.cloud_base_m / fall_m_per_s;
    return Vec3(std::fabs(wind_.x) * most, std::fabs(wind_.y) * most, 0);
  }

 private:
  const RainSettings& settings_;
  Vec3 wind_;
};

std::string recipe_of(const RainSettings& settings, double smallest_um, double largest_um) {
  phase::Recipe recipe = phase::default_recipe(settings.drops == "gamma" ? "mie" : "rain");
  if (settings.drops == "gamma") {
    recipe.distribution.type = "gamma";
    recipe.distribution.variance = settings.variance;
  }
  // Bows change slowly with the drops' size; narrow populations still want neighbours within a fifth of a width.
  const double ratio = settings.drops == "gamma" ? 1.1 : 1.2;
  const auto count = static_cast<std::size_t>(std::ceil(std::log(largest_um / smallest_um) / std::log(ratio))) + 1;
  recipe.size_um.clear();
  for (std::size_t i = 0; i < count; ++i)
    recipe.size_um.push_back(count == 1 ? largest_um
                                        : smallest_um * std::pow(largest_um / smallest_um, static_cast<double>(i) / static_cast<double>(count - 1)));
  // Three digits name a drop well enough, and equal showers share their tables.
  for (double& size : recipe.size_um) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", size);
    size = std::stod(text);
  }
  recipe.size_um.erase(std::unique(recipe.size_um.begin(), recipe.size_um.end()), recipe.size_um.end());
  return text_of(recipe);
}

}  // namespace

void list_keys(Keys& keys, RainSettings& rain) {
  keys.text("species", rain.species, "name of the species in the file");
  keys.number("rain_mm_per_hour", rain.rain_mm_per_hour, {.low = 0.01, .high = 500}, "rain rate in the core, under the cloud");
  keys.vector3("centre_m", rain.centre_m, "middle of the shaft at the ground; its z is the ground");
  keys.number("width_m", rain.width_m, above(0), "of the shaft, west to east");
  keys.number("depth_m", rain.depth_m, above(0), "of the shaft, south to north");
  keys.number("edge", rain.edge, above_up_to(0, 1), "share of the half widths over which the rain fades out");
  keys.number("cloud_base_m", rain.cloud_base_m, above(0), "above the ground: where the rain begins");
  keys.number("voxel_m", rain.voxel_m, above(0), "edge of a voxel");
  keys.number("wind_m_per_s", rain.wind_m_per_s, between(0, 100), "at the cloud base, none at the ground: streaks bend");
  keys.number("wind_azimuth_deg", rain.wind_azimuth_deg, any(), "compass azimuth to which the wind blows");
  keys.number("evaporation_per_km", rain.evaporation_per_km, between(0, 100),
              "virga: the rain rate falls by e^-evaporation in each kilometre below the base");
  keys.number("streaks", rain.streaks, between(0, 3), "strength of fall streaks; 0: none");
  keys.number("streak_size_m", rain.streak_size_m, above(0), "size of fall streaks");
  keys.number("turbulence", rain.turbulence, between(0, 3), "strength of the turbulent density; 0: none");
  keys.number("turbulence_size_m", rain.turbulence_size_m, above(0), "size of the largest eddies");
  keys.choice("drops", rain.drops, {"marshall_palmer", "gamma"},
              "marshall_palmer: as broad as in most rain; gamma: narrower, with brighter supernumeraries");
  if (keys.only_if(rain.drops == "gamma", "drops = gamma")) {
    keys.number("effective_radius_um", rain.effective_radius_um, between(10, 1500),
                "of the drops in the core; goes with the rain rate to the power 0.21");
    keys.number("variance", rain.variance, {.low = 0.001, .high = 0.4}, "effective variance of the drops");
  }
  keys.integer("seed", rain.seed, between(0, 4e9), "another seed, another shower of the same kind");
}

AuthoredRain author_rain(const RainSettings& settings) {
  const RainField field(settings);
  const Vec3 half = Vec3(settings.width_m / 2, settings.depth_m / 2, 0) * (1 + settings.edge) + field.reach_m();
  const auto voxels = [&](double metres) { return static_cast<int>(std::ceil(metres / settings.voxel_m / edge)); };
  if (half.x * half.y * 4 * settings.cloud_base_m / std::pow(settings.voxel_m, 3) > 2e9)
    throw bad_input("voxel_m", number_text(settings.voxel_m), "a shaft of at most 2e9 voxels expected",
                    "Make voxels larger or the shaft smaller");
  const int nx = 2 * voxels(half.x), ny = 2 * voxels(half.y), nz = voxels(settings.cloud_base_m);

  AuthoredRain result;
  NewSpecies& species = result.species;
  species.name = settings.species;
  species.world_from_index = Affine::translation(settings.centre_m) * Affine::scaling(Vec3(settings.voxel_m));

  struct Part {
    NewBrick extinction, size;
    double water_kg = 0, smallest = 1e9, largest = 0, most = 0;
  };
  std::vector<std::unique_ptr<Part>> parts(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny) * static_cast<std::size_t>(nz));
  const double voxel_m3 = std::pow(settings.voxel_m, 3);
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) {
    const int bz = static_cast<int>(i % static_cast<std::size_t>(nz));
    const int by = static_cast<int>(i / static_cast<std::size_t>(nz)) % ny;
    const int bx = static_cast<int>(i / static_cast<std::size_t>(nz) / static_cast<std::size_t>(ny));
    const Coord origin{(bx - nx / 2) * edge, (by - ny / 2) * edge, bz * edge};
    auto part = std::make_unique<Part>();
    part->extinction.origin = part->size.origin = origin;
    part->extinction.values.fill(0);
    part->size.values.fill(0);
    for (int v = 0; v < SparseGrid::brick_voxels; ++v) {
      const Vec3 index(origin.x + (v >> 6), origin.y + (v >> 3 & 7), origin.z + (v & 7));
      const double share = field.share(species.world_from_index.point(index));
      if (share < least_share) continue;
      const Drops drops = drops_of(share * settings.rain_mm_per_hour, settings);
      part->extinction.values[static_cast<std::size_t>(v)] = static_cast<float>(drops.extinction_per_m);
      part->size.values[static_cast<std::size_t>(v)] = static_cast<float>(drops.radius_um);
      part->water_kg += drops.water_kg_per_m3 * voxel_m3;
      part->smallest = std::min(part->smallest, drops.radius_um);
      part->largest = std::max(part->largest, drops.radius_um);
      part->most = std::max(part->most, drops.extinction_per_m);
    }
    if (part->largest > 0) parts[i] = std::move(part);
  });
  result.smallest_radius_um = 1e9;
  for (const auto& part : parts) {
    if (!part) continue;
    species.extinction.push_back(part->extinction);
    species.size.push_back(part->size);
    result.water_kg += part->water_kg;
    result.smallest_radius_um = std::min(result.smallest_radius_um, part->smallest);
    result.largest_radius_um = std::max(result.largest_radius_um, part->largest);
    result.largest_extinction_per_m = std::max(result.largest_extinction_per_m, part->most);
  }
  if (species.extinction.empty())
    throw bad_input("voxel_m", number_text(settings.voxel_m), "voxels smaller than the shaft expected");
  species.recipe = recipe_of(settings, result.smallest_radius_um, result.largest_radius_um);
  species.phase_id = phase::recipe_id(phase::recipe_from_text(species.recipe, "recipe"));
  return result;
}

}  // namespace arcus::media
