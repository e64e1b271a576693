#include "media/author/cirrus.h"

#include <algorithm>
#include <cmath>

#include "media/author/air_density.h"
#include "media/author/fall_streaks.h"
#include "media/author/fill.h"
#include "media/author/ice_climate.h"
#include "media/author/noise.h"
#include "media/author/smooth_step.h"
#include "phase/base/error.h"
#include "phase/base/frame.h"
#include "phase/settings/number_text.h"

namespace arcus::media {
namespace {

/// What a kind means where the settings say 0.
struct Kind {
  double cover, cell_m, cell_depth_m;
  double contrast;     ///< of the fibres: standard deviation of ln IWC
  double billows;      ///< how deep the tops of cells are cut, in depths of the cells
  double least_reach;  ///< how far the weakest streaks go on the way to the base
  bool ends_inside;    ///< thins out towards the border of the domain
};
Kind kind_of(const CirrusSettings& s) {
  Kind kind = s.kind == "uncinus"    ? Kind{0.12, 2500, 500, 0.6, 0.5, 0.4, true}
              : s.kind == "fibratus" ? Kind{0.4, 3000, 250, 0.8, 0.2, 0.4, true}
                                     : Kind{1, 6000, 250, 0.2, 0.1, 0.8, false};
  if (s.cover > 0) kind.cover = s.cover;
  if (s.cell_m > 0) kind.cell_m = s.cell_m;
  if (s.cell_depth_m > 0) kind.cell_depth_m = s.cell_depth_m;
  kind.contrast *= s.texture;
  kind.billows *= s.texture;
  return kind;
}

// Edges of clouds: from nothing to the full amount over this share of strength and depth.
constexpr double edge = 0.3;

/// The ice as a function of position relative to the middle of the domain on the ground.
class Cirrus {
 public:
  Cirrus(const CirrusSettings& s, const IceMixture& mixture)
      : s_(s),
        kind_(kind_of(s)),
        cell_base_m_(s.top_m - kind_.cell_depth_m),
        towards_(direction_of(s.shear_azimuth_deg, 0)),
        streaks_({1e-3 * s.shear_m_per_s_km, s.shear_azimuth_deg, s.shear_turn_deg}, cell_base_m_ - s.base_m,
                 [&](double depth_m) { return fall_speed_m_per_s(mixture, cell_base_m_ - depth_m); }),
        cells_(static_cast<std::uint64_t>(s.seed) * 11 + 1),
        fibres_(static_cast<std::uint64_t>(s.seed) * 11 + 2),
        billows_(static_cast<std::uint64_t>(s.seed) * 11 + 3) {
    find_threshold();
  }

  /// Mean of a voxel, whose middle is p: where streaks lie so flat that a voxel reaches over several fibres, one point would not do.
  FilledVoxel ice(const Vec3& p) const {
    const double half = 0.5 * s_.voxel_m;
    const double wide_m = length(drift_m(p.z - half) - drift_m(p.z + half));
    const int points = static_cast<int>(std::clamp(std::ceil(2 * wide_m / s_.fibre_m), 1.0, 12.0));
    double sum = 0, sum_of_sizes = 0;
    for (int i = 0; i < points; ++i) {
      const FilledVoxel one = ice_at(p + Vec3(0, 0, ((i + 0.5) / points - 0.5) * s_.voxel_m));
      sum += one.extinction_per_m;
      sum_of_sizes += one.extinction_per_m * one.size_um;
    }
    // What is thinner would never be seen.
    if (sum < 2e-3 * points * s_.ice_factor * mean_ice_g_per_m3(temperature_c(s_, p.z))) return {};
    return {sum / points, sum_of_sizes / sum};
  }

 private:
  double fall_speed_m_per_s(const IceMixture& mixture, double height_m) const {
    if (s_.fall_speed_m_per_s > 0) return s_.fall_speed_m_per_s;
    return mixture.fall_speed_m_per_s(crystal_size_um(s_, height_m), standard_air_density_kg_per_m3(height_m), temperature_c(s_, height_m));
  }
  Vec3 drift_m(double height_m) const { return streaks_.drift_m(std::max(0.0, cell_base_m_ - height_m)); }

  /// Ice water content [g/m³] in place of extinction.
  FilledVoxel ice_at(const Vec3& p) const {
    if (p.z <= s_.base_m || p.z >= s_.top_m) return {};
    const double border = from_border(p);
    if (border <= 0) return {};
    const double depth = std::max(0.0, cell_base_m_ - p.z);
    // Where and when these crystals left their cell. Cells travel with the wind at their height.
    const Vec3 start = Vec3(p.x, p.y, 0) - streaks_.drift_m(depth);
    const double lives = s_.cell_life_min > 0 ? streaks_.time_s(depth) / (60 * s_.cell_life_min) : 0;
    const double strength = strength_of(start, lives);
    if (strength <= 0) return {};
    const double width = std::sqrt(strength);
    double amount = smooth_step(strength / edge), left = 1;
    if (p.z > cell_base_m_) {
      const double height = (p.z - cell_base_m_) / kind_.cell_depth_m;
      const double billow = kind_.billows > 0 ? std::fabs(billows_.fractal(p * (2 / kind_.cell_depth_m), 3, 0.55)) : 0;
      const double cut = kind_.billows * std::min(1.0, 2 * height) * (0.75 - 0.75 * std::min(billow, 1.6));
      amount *= smooth_step((width - height - cut) / edge);
    } else {
      // Weak streaks are gone first.
      amount *= smooth_step(width / edge);
      const double reach = kind_.least_reach + (1 - kind_.least_reach) * width;
      left = smooth_step((reach - depth / (cell_base_m_ - s_.base_m)) / edge);
    }
    if (amount * left <= 0) return {};
    const double ice = s_.ice_factor * mean_ice_g_per_m3(temperature_c(s_, p.z)) * amount * left * border * fibres(start, lives);
    // As many crystals, each with less ice.
    return {ice, crystal_size_um(s_, p.z) * std::cbrt(std::max(left, 0.03))};
  }

  /// Log-normal with mean 1: fibres change none of the ice in all. Long along the shear, so that they stay fibres where streaks lie flat.
  double fibres(const Vec3& start, double lives) const {
    if (kind_.contrast <= 0) return 1;
    const double along = dot(start, towards_), across = start.x * towards_.y - start.y * towards_.x;
    const double value = fibres_.fractal(Vec3(along / 3, across, 0) * (1 / s_.fibre_m) + Vec3(0, 0, 2 * lives), 3, 0.6);
    return std::exp(kind_.contrast * value - 0.5 * kind_.contrast * kind_.contrast);
  }

  double field(const Vec3& start, double lives) const {
    return cells_.fractal(start * (1 / kind_.cell_m) + Vec3(0, 0, 0.37 + lives), 3, 0.45);
  }
  /// From 0 at the rim of a cell to 1 in the middle of the strongest; below 0 outside.
  double strength_of(const Vec3& start, double lives) const {
    if (kind_.cover >= 1) return 1;
    return std::min(1.0, (field(start, lives) - threshold_) / (largest_ - threshold_));
  }
  /// 1 inside, 0 at the border of a domain in which clouds end.
  double from_border(const Vec3& p) const {
    const double wide_x = s_.size_m[0], wide_y = s_.size_m.back();
    const double share = std::min(0.5 - std::fabs(p.x) / wide_x, 0.5 - std::fabs(p.y) / wide_y);
    return kind_.ends_inside ? smooth_step(share / 0.12) : share >= 0 ? 1 : 0;
  }
  /// The threshold above which is the wanted share of the domain.
  void find_threshold() {
    constexpr int n = 256;
    std::vector<double> values;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        values.push_back(field(Vec3(((i + 0.5) / n - 0.5) * s_.size_m[0], ((j + 0.5) / n - 0.5) * s_.size_m.back(), 0), 0));
    std::sort(values.begin(), values.end());
    threshold_ = values[static_cast<std::size_t>((1 - std::min(kind_.cover, 1.0)) * static_cast<double>(values.size() - 1))];
    largest_ = std::max(values.back(), threshold_ + 1e-6);
  }

  const CirrusSettings& s_;
  Kind kind_;
  double cell_base_m_;
  Vec3 towards_;
  FallStreaks streaks_;
  Noise cells_, fibres_, billows_;
  double threshold_ = 0, largest_ = 1;
};

}  // namespace

double temperature_c(const CirrusSettings& settings, double height_m) {
  return settings.ground_temperature_c - 1e-3 * settings.lapse_k_per_km * height_m;
}

double crystal_size_um(const CirrusSettings& settings, double height_m) {
  return settings.length_over_width * mean_width_um(temperature_c(settings, height_m));
}

void list_keys(Keys& keys, CirrusSettings& cirrus) {
  keys.choice("kind", cirrus.kind, {"uncinus", "fibratus", "cirrostratus"},
              "hooks with tufted heads, straight fibres, or a sheet; decides what is 0 below");
  keys.text("name", cirrus.name, "of the species NAME_HABIT: grids NAME_HABIT.extinction and NAME_HABIT.size");
  keys.vector3("centre_m", cirrus.centre_m, "middle of the domain, on the ground");
  keys.numbers("size_m", cirrus.size_m, above(0), 1, 2, "of the domain along x and y; one number: both");
  keys.number("base_m", cirrus.base_m, at_least(0), "height over the ground at which the longest streaks end");
  keys.number("top_m", cirrus.top_m, above_up_to(0, 20000), "height over the ground of the highest cells");
  keys.number("voxel_m", cirrus.voxel_m, above(0), "edge of the voxels");
  keys.number("ground_temperature_c", cirrus.ground_temperature_c, between(-90, 60), "at the ground [C]");
  keys.number("lapse_k_per_km", cirrus.lapse_k_per_km, between(-10, 15), "how fast it gets colder with height");
  keys.number("ice_factor", cirrus.ice_factor, above_up_to(0, 100), "ice water content over the mean of such a temperature");
  keys.number("optical_depth", cirrus.optical_depth, at_least(0),
              "vertical, at 550 nm, mean over the domain; above 0 it decides how much ice there is");
  keys.number("length_over_width", cirrus.length_over_width, between(0.2, 10),
              "maximum dimension of the crystals over the mean width of such a temperature");
  keys.number("cover", cirrus.cover, between(0, 1), "share of the domain under cells; 0: 0.12 for uncinus, 0.4 for fibratus, 1 for cirrostratus");
  keys.number("cell_m", cirrus.cell_m, at_least(0), "distance between cells; 0: 2500 for uncinus, 3000 for fibratus, 6000 for cirrostratus with cover below 1");
  keys.number("cell_depth_m", cirrus.cell_depth_m, at_least(0), "of the layer of cells below the top; 0: 500 for uncinus, 250 for the others");
  keys.number("cell_life_min", cirrus.cell_life_min, at_least(0), "how long a cell snows, which limits the length of streaks; 0: for ever");
  keys.number("shear_m_per_s_km", cirrus.shear_m_per_s_km, between(0, 50), "wind relative to the cells at 1 km below them; it grows evenly with depth");
  keys.number("shear_azimuth_deg", cirrus.shear_azimuth_deg, any(), "compass direction to which it draws the streaks");
  keys.number("shear_turn_deg", cirrus.shear_turn_deg, between(-180, 180), "by which it turns clockwise down to the base");
  keys.number("fall_speed_m_per_s", cirrus.fall_speed_m_per_s, between(0, 5), "of the crystals; 0: by size, shape and air");
  keys.number("fibre_m", cirrus.fibre_m, above(0), "width of the fibres in a streak");
  keys.number("texture", cirrus.texture, between(0, 3), "strength of fibres and of the billows of cells: 1 as usual, 0 smooth");
  keys.integer("seed", cirrus.seed, between(0, 9e14), "another seed, another cloud");
  list_keys(keys, cirrus.crystals);
  if (keys.documents()) return;
  if (!(cirrus.top_m > cirrus.base_m)) keys.refuse("top_m", number_text(cirrus.top_m), "must be above base_m");
  if (const double depth = kind_of(cirrus).cell_depth_m; !(depth < cirrus.top_m - cirrus.base_m))
    keys.refuse("cell_depth_m", number_text(depth), "must be less than top_m - base_m");
  for (const double height : {cirrus.base_m, cirrus.top_m})
    if (const double t = temperature_c(cirrus, height); !(t < 0))
      keys.refuse("ground_temperature_c", number_text(t) + " C at " + number_text(height) + " m", "below 0 C expected in a cloud of ice");
}

AuthoredIce author_cirrus(const CirrusSettings& settings) {
  const IceMixture mixture(settings.crystals);
  const Cirrus cirrus(settings, mixture);
  const double h = settings.voxel_m;
  NewSpecies ice;
  // Voxel (i, j, 0) is the first above the base.
  ice.world_from_index = Affine::translation(settings.centre_m + Vec3(0, 0, settings.base_m)) * Affine::scaling(Vec3(h)) *
                         Affine::translation(Vec3(0.5));
  const auto reach = [&](double width) { return static_cast<int>(std::ceil(std::min(width / h, 1e9))); };
  const int x = reach(0.5 * settings.size_m[0]), y = reach(0.5 * settings.size_m.back()), z = reach(settings.top_m - settings.base_m);
  fill({{-x, -y, 0}, {x - 1, y - 1, z - 1}},
       [&](const Coord& c) { return cirrus.ice(Vec3(c.x + 0.5, c.y + 0.5, c.z + 0.5) * h + Vec3(0, 0, settings.base_m)); },
       "voxel_m", ice);
  if (ice.extinction.empty())
    throw bad_input("cirrus", "no voxel with ice", "at least one expected", "The voxels may be larger than the cloud, or cover too small");
  return author_ice(ice, mixture,
                    {settings.name, settings.size_m[0] * settings.size_m.back(), settings.optical_depth,
                     [&](double z_m) { return temperature_c(settings, z_m - settings.centre_m.z); }});
}

}  // namespace arcus::media
