#include "media/author/rain.h"

#include <algorithm>
#include <cmath>

#include "media/author/fill.h"
#include "media/author/noise.h"
#include "media/author/smooth_step.h"
#include "phase/base/error.h"
#include "phase/base/frame.h"
#include "phase/base/units.h"
#include "phase/population/sizes.h"
#include "phase/settings/number_text.h"
#include "phase/settings/toml_text.h"
#include "phase/species/recipe.h"

namespace arcus::media {
namespace {

constexpr double water_kg_per_m3 = 1000;
// Rain below this share of the core's rate is left out: it stops a thousandth of the light at most.
constexpr double least_share = 1e-3;

/// The shower as a function of position.
class Shower {
 public:
  explicit Shower(const RainSettings& settings)
      : s_(settings),
        wind_(direction_of(settings.wind_azimuth_deg, 0)),
        streaks_(static_cast<std::uint64_t>(settings.seed) * 3 + 1),
        turbulence_(static_cast<std::uint64_t>(settings.seed) * 3 + 2) {
    fall_m_per_s_ = s_.fall_speed_m_per_s > 0 ? s_.fall_speed_m_per_s
                                              : fall_speed_m_per_s(drops(s_.rain_mm_per_hour).effective_radius_um);
  }

  RainDrops drops(double rain) const {
    if (s_.drops == "marshall_palmer") return marshall_palmer_drops(rain);
    return narrow_drops(rain, s_.radius_um * std::pow(rain / s_.rain_mm_per_hour, s_.radius_exponent));
  }

  /// How far drops have drifted along the wind at a depth below the base [m]: the wind grows evenly from 0 at the base, so
  /// streaks are parabolas.
  double drift_m(double depth_m) const {
    return 0.5 * s_.wind_m_per_s / fall_m_per_s_ * depth_m * depth_m / s_.cloud_base_m;
  }

  /// Rain rate at a position relative to the foot's middle [mm/h].
  double rain_mm_per_hour(const Vec3& p) const {
    const double depth = s_.cloud_base_m - p.z;
    if (depth < 0 || p.z < 0) return 0;
    // Where these drops left the cloud, along and across the wind.
    const double along = p.x * wind_.x + p.y * wind_.y - drift_m(depth), across = p.x * wind_.y - p.y * wind_.x;
    const double from_middle = std::hypot(along / s_.stretch, across);
    const double profile = smooth_step((s_.core_radius_m + s_.edge_width_m - from_middle) / s_.edge_width_m);
    if (profile == 0) return 0;
    // Streaks are the places in the cloud that rain more. They live for a while: the pattern changes with height, slowly.
    const double streak = streaks_.fractal(Vec3(along, across, 0.12 * depth) * (1 / s_.streak_width_m), 2, 0.5);
    const double eddy = turbulence_.fractal(p * (1 / s_.turbulence_scale_m), static_cast<int>(s_.octaves), 0.6);
    // Log-normal factors with mean 1: never negative, and the rain that falls in all stays the same.
    const double texture = std::exp(s_.streak_contrast * streak - 0.5 * s_.streak_contrast * s_.streak_contrast +
                                    s_.turbulence * eddy - 0.5 * s_.turbulence * s_.turbulence);
    const double onset = s_.base_fade_m > 0 ? smooth_step(depth / s_.base_fade_m) : 1;
    return evaporated(s_.rain_mm_per_hour * profile * texture, depth) * onset;
  }

 private:
  /// Rain evaporates at a rate in proportion to ∫ N(D) D dD = N₀/Λ² ~ R^0.42 (diffusion from drops of Marshall and Palmer's
  /// distribution), so R^0.58 falls evenly with depth: light rain is gone first.
  double evaporated(double rain, double depth) const {
    if (s_.virga_m <= 0) return rain;
    constexpr double power = 1 - 2 * 0.21;
    const double left = std::pow(rain, power) - depth / s_.virga_m;
    return left > 0 ? std::pow(left, 1 / power) : 0;
  }

  const RainSettings& s_;
  Vec3 wind_;
  Noise streaks_, turbulence_;
  double fall_m_per_s_ = 1;
};

std::string recipe_text(const RainSettings& settings, double smallest_um, double largest_um) {
  const bool is_narrow = settings.drops == "narrow";
  phase::Recipe recipe = phase::default_recipe("rain");
  recipe.distribution.type = is_narrow ? "gamma" : "marshall_palmer";
  recipe.distribution.variance = settings.variance;
  recipe.distribution.rain_mm_per_hour = 0;
  const double per_octave = settings.nodes_per_octave > 0 ? settings.nodes_per_octave : is_narrow ? 7 : 3;
  // On a lattice that all showers share, so that a like one finds its phase functions in the cache.
  const auto place_of = [&](double size_um) { return std::log2(size_um / 100) * per_octave; };
  const int first = static_cast<int>(std::floor(place_of(smallest_um) + 1e-6)), last = static_cast<int>(std::ceil(place_of(largest_um) - 1e-6));
  recipe.size_um.clear();
  for (int k = first; k <= last; ++k) recipe.size_um.push_back(std::round(1e4 * std::exp2(k / per_octave)) / 100);
  return text_of(recipe);
}

}  // namespace

void list_keys(Keys& keys, RainSettings& rain) {
  keys.text("name", rain.name, "of the species: grids NAME.extinction and NAME.size");
  keys.vector3("centre_m", rain.centre_m, "middle of the shaft on the ground, were there no wind");
  keys.number("core_radius_m", rain.core_radius_m, at_least(0), "full rain rate within, across the wind");
  keys.number("edge_width_m", rain.edge_width_m, above(0), "outside of the core the rain rate falls smoothly to nothing");
  keys.number("stretch", rain.stretch, above(0), "length along the wind over width across it");
  keys.number("cloud_base_m", rain.cloud_base_m, above(0), "height above the ground at which rain begins");
  keys.number("voxel_m", rain.voxel_m, above(0), "edge of the voxels");
  keys.number("rain_mm_per_hour", rain.rain_mm_per_hour, above_up_to(0, 500), "mean rain rate in the core at cloud base");
  keys.number("virga_m", rain.virga_m, at_least(0),
              "depth below cloud base at which rain of 1 mm/h has evaporated; 0: nothing evaporates");
  keys.number("base_fade_m", rain.base_fade_m, at_least(0), "rain sets in over this depth below the cloud base");
  keys.number("wind_m_per_s", rain.wind_m_per_s, at_least(0),
              "wind at the ground relative to the cloud; grows evenly with depth below the base");
  keys.number("wind_azimuth_deg", rain.wind_azimuth_deg, any(), "compass direction towards which it blows");
  keys.number("fall_speed_m_per_s", rain.fall_speed_m_per_s, at_least(0), "of the drops; 0: that of the core's drops");
  keys.number("streak_contrast", rain.streak_contrast, between(0, 2), "fall streaks: standard deviation of ln R");
  keys.number("streak_width_m", rain.streak_width_m, above(0), "width of the streaks");
  keys.number("turbulence", rain.turbulence, between(0, 2), "fluctuations in all directions: standard deviation of ln R");
  keys.number("turbulence_scale_m", rain.turbulence_scale_m, above(0), "size of the largest fluctuations");
  keys.integer("octaves", rain.octaves, between(1, 12), "each halves the size of the fluctuations");
  keys.integer("seed", rain.seed, between(0, 9e15), "another seed, another shower");
  keys.choice("drops", rain.drops, {"marshall_palmer", "narrow"},
              "size distribution: natural rain, or drops of nearly one size, which show supernumerary bows");
  if (keys.only_if(rain.drops == "narrow", "drops = narrow")) {
    keys.number("radius_um", rain.radius_um, between(40, 3000), "effective radius at the core's rain rate");
    keys.number("radius_exponent", rain.radius_exponent, between(0, 1),
                "the effective radius goes with the rain rate to this power");
    keys.number("variance", rain.variance, between(1e-4, 0.3), "effective variance of the sizes at one place");
  }
  keys.number("nodes_per_octave", rain.nodes_per_octave, between(0, 50),
              "phase functions for each doubling of the radius; 0: 3 for marshall_palmer, 7 for narrow");
}

double fall_speed_m_per_s(double radius_um) {
  const double r = std::min(m_from_um(radius_um), 3e-3), diameter_mm = 2e3 * r;
  if (r < 40e-6) return 1.19e8 * r * r * (8e3 / (1.19e8 * 40e-6));  // scaled by 1.7 so as to meet the next one
  if (diameter_mm < 0.6) return 8e3 * r;
  return 9.65 - 10.3 * std::exp(-0.6 * diameter_mm);
}

RainDrops marshall_palmer_drops(double rain_mm_per_hour) {
  constexpr double n0_per_m3_mm = 8000;
  const double slope_per_mm = phase::marshall_palmer_slope_per_mm(rain_mm_per_hour);
  return {pi * n0_per_m3_mm / (slope_per_mm * slope_per_mm * slope_per_mm) * 1e-6, um_from_mm(1.5 / slope_per_mm)};
}

RainDrops narrow_drops(double rain_mm_per_hour, double effective_radius_um) {
  const double flux_kg_per_m2_s = rain_mm_per_hour / 3600;  // 1 mm of water is 1 kg/m²
  const double water_kg_per_m3_of_air = flux_kg_per_m2_s / fall_speed_m_per_s(effective_radius_um);
  return {1.5 * water_kg_per_m3_of_air / (water_kg_per_m3 * m_from_um(effective_radius_um)), effective_radius_um};
}

AuthoredRain author_rain(const RainSettings& settings) {
  const Shower shower(settings);
  const double reach = settings.core_radius_m + settings.edge_width_m, h = settings.voxel_m;
  const Vec3 wind = direction_of(settings.wind_azimuth_deg, 0);
  Box box;  // all that the shaft and its drift can reach, relative to the foot's middle
  for (const double drift : {0.0, shower.drift_m(settings.cloud_base_m)}) {
    const double wide = reach * std::max(1.0, settings.stretch);
    box.include(Vec3(wind.x * drift - wide, wind.y * drift - wide, 0));
    box.include(Vec3(wind.x * drift + wide, wind.y * drift + wide, settings.cloud_base_m));
  }
  AuthoredRain result;
  // Voxel (i, j, k) stands in the middle of its cube; the ground is a face of the lowest ones.
  result.species.world_from_index =
      Affine::translation(settings.centre_m) * Affine::scaling(Vec3(h)) * Affine::translation(Vec3(0.5));
  result.species.name = settings.name;
  const auto index_of = [&](double metres) { return static_cast<int>(std::floor(std::clamp(metres / h, -1e9, 1e9))); };
  fill({{index_of(box.low.x), index_of(box.low.y), 0}, {index_of(box.high.x), index_of(box.high.y), index_of(box.high.z)}},
       [&](const Coord& c) -> FilledVoxel {
         const double rain = shower.rain_mm_per_hour(Vec3(c.x + 0.5, c.y + 0.5, c.z + 0.5) * h);
         if (rain < least_share * settings.rain_mm_per_hour) return {};
         const RainDrops drops = shower.drops(rain);
         return {drops.extinction_per_m, drops.effective_radius_um};
       },
       "voxel_m", result.species);
  if (result.species.extinction.empty())
    throw bad_input("rain", "no voxel with rain", "at least one expected",
                    "It evaporates at once (virga_m), or the voxels are larger than the shower");
  const FilledRange range = range_of(result.species);
  result.smallest_radius_um = range.smallest_size_um;
  result.largest_radius_um = range.largest_size_um;
  result.largest_extinction_per_m = range.largest_extinction_per_m;
  result.water_kg = m_from_um(range.extinction_times_size) * water_kg_per_m3 / 1.5 * h * h * h;
  result.species.recipe = recipe_text(settings, result.smallest_radius_um, result.largest_radius_um);
  result.species.phase_id = phase::recipe_id(phase::recipe_from_text(result.species.recipe, "recipe of the rain"));
  return result;
}

}  // namespace arcus::media
