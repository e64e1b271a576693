#include "media/author/cloud.h"

#include <algorithm>
#include <cmath>

#include "media/author/droplets.h"
#include "media/author/fill.h"
#include "media/author/noise.h"
#include "media/author/smooth_step.h"
#include "phase/base/error.h"
#include "phase/settings/number_text.h"
#include "phase/species/recipe.h"

namespace arcus::media {
namespace {

/// What a kind means where the settings say 0.
struct Kind {
  double depth_m, cover, cell_m, detail;
  double top_power;   ///< how the height of a cloud goes with its strength: small numbers make flat tops
  double least_top;   ///< height of the weakest cloud in the deepest one's depth
  bool ends_inside;   ///< clouds keep away from the border of the domain
};
Kind kind_of(const CloudSettings& s) {
  Kind kind = s.kind == "cumulus"         ? Kind{1000, 0.3, 1100, 0.55, 0.5, 0.0, true}
              : s.kind == "stratocumulus" ? Kind{350, 0.9, 900, 0.3, 0.5, 0.4, false}
                                          : Kind{300, 1.0, 1500, 0.12, 0.5, 0.8, false};
  if (s.depth_m > 0) kind.depth_m = s.depth_m;
  if (s.cover > 0) kind.cover = s.cover;
  if (s.cell_m > 0) kind.cell_m = s.cell_m;
  if (s.detail > 0) kind.detail = s.detail;
  return kind;
}

/// The cloud as a function of position; heights are over the base.
class Cloud {
 public:
  explicit Cloud(const CloudSettings& s)
      : s_(s),
        kind_(kind_of(s)),
        width_x_m_(s.size_m[0]),
        width_y_m_(s.size_m.back()),
        cells_(static_cast<std::uint64_t>(s.seed) * 5 + 1),
        billows_(static_cast<std::uint64_t>(s.seed) * 5 + 2) {
    find_threshold();
  }
  const Kind& kind() const { return kind_; }

  /// Liquid water [g/m³] at a place relative to the middle of the domain, z over the base.
  double liquid_g_per_m3(const Vec3& p) const {
    if (p.z <= 0 || p.z >= kind_.depth_m || std::fabs(p.x) > 0.5 * width_x_m_ || std::fabs(p.y) > 0.5 * width_y_m_) return 0;
    const double height = p.z / kind_.depth_m;
    // Billows grow with height: air rises smoothly and breaks up towards the top.
    const double size_m = 0.35 * std::min(kind_.depth_m, kind_.cell_m);
    const double rough = std::min(1.0, 0.35 + 1.3 * height);
    const double billow = std::fabs(billows_.fractal(p * (1 / size_m), static_cast<int>(s_.octaves), 0.55));
    // Above 0 inside. |noise| has its creases outward, as cauliflowers have.
    const double inside = top(p.x, p.y) - height - kind_.detail * rough * (0.75 - 0.75 * std::min(billow, 1.6));
    if (inside <= 0) return 0;
    // Mixing with dry air makes an edge of a few tens of metres.
    const double edge = smooth_step(inside * kind_.depth_m / 50);
    return s_.adiabatic_share * edge * adiabatic_g_per_m3(p.z);
  }
  double adiabatic_g_per_m3(double height_m) const { return 1e-3 * s_.liquid_gradient_g_per_m3_km * height_m; }

 private:
  /// A field with clouds where it is high; its highest places are near 2.
  double strength(double x, double y) const {
    return cells_.fractal(Vec3(x, y, 0.37 * kind_.cell_m) * (1 / kind_.cell_m), 3, 0.5) - border(x, y);
  }
  double border(double x, double y) const {
    if (!kind_.ends_inside) return 0;
    const double from_border = std::min(0.5 * width_x_m_ - std::fabs(x), 0.5 * width_y_m_ - std::fabs(y));
    const double width = std::min({0.5 * kind_.cell_m, 0.2 * width_x_m_, 0.2 * width_y_m_});
    return 4 * (1 - smooth_step(from_border / width));
  }
  /// Relative height that the cloud above a place would reach without billows.
  double top(double x, double y) const {
    const double above = (strength(x, y) - threshold_) / (largest_ - threshold_);
    if (above <= 0) return -1;
    return kind_.least_top + (1 - kind_.least_top) * std::pow(above, kind_.top_power);
  }
  /// The threshold that leaves the wanted share of the domain.
  void find_threshold() {
    constexpr int n = 256;
    std::vector<double> values;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) values.push_back(strength(((i + 0.5) / n - 0.5) * width_x_m_, ((j + 0.5) / n - 0.5) * width_y_m_));
    std::sort(values.begin(), values.end());
    const auto rank = static_cast<std::size_t>((1 - std::min(kind_.cover, 1.0)) * static_cast<double>(values.size() - 1));
    largest_ = values.back();
    threshold_ = kind_.cover >= 1 ? values.front() - 1 : values[rank];
  }

  const CloudSettings& s_;
  Kind kind_;
  double width_x_m_, width_y_m_;
  Noise cells_, billows_;
  double threshold_ = 0, largest_ = 1;
};

}  // namespace

void list_keys(Keys& keys, CloudSettings& cloud) {
  keys.choice("kind", cloud.kind, {"cumulus", "stratocumulus", "stratus"}, "single clouds, a deck of cells, or a smooth deck; decides what is 0 below");
  keys.text("name", cloud.name, "of the species: grids NAME.extinction and NAME.size");
  keys.vector3("centre_m", cloud.centre_m, "middle of the domain, on the ground");
  keys.numbers("size_m", cloud.size_m, above(0), 1, 2, "of the domain along x and y; one number: both");
  keys.number("base_m", cloud.base_m, at_least(0), "height of the condensation level above the ground");
  keys.number("depth_m", cloud.depth_m, at_least(0), "of the deepest cloud; 0: 1000 for cumulus, 350 for stratocumulus, 300 for stratus");
  keys.number("cover", cloud.cover, between(0, 1), "share of the domain under cloud; 0: 0.3 for cumulus, 0.9 for stratocumulus, 1 for stratus");
  keys.number("cell_m", cloud.cell_m, at_least(0), "distance between clouds, or cells of a deck; 0: 1100 for cumulus, 900 for stratocumulus, 1500 for stratus");
  keys.number("voxel_m", cloud.voxel_m, above(0), "edge of the voxels");
  keys.number("detail", cloud.detail, between(0, 1), "how deep billows go, in depths of the cloud; 0: 0.55 for cumulus, 0.3 for stratocumulus, 0.12 for stratus");
  keys.integer("octaves", cloud.octaves, between(1, 12), "each halves the size of the billows");
  keys.number("liquid_gradient_g_per_m3_km", cloud.liquid_gradient_g_per_m3_km, above_up_to(0, 5),
              "how adiabatic liquid water grows with height: 1 in cold air, 2.5 in warm");
  keys.number("adiabatic_share", cloud.adiabatic_share, above_up_to(0, 1), "of that liquid water in the core; the rest is lost by mixing");
  keys.number("drops_per_cm3", cloud.drops_per_cm3, above_up_to(0, 1e5), "number of droplets: 50 over sea, 300 and more over land");
  keys.number("variance", cloud.variance, between(1e-4, 0.3), "effective variance of the droplets' sizes at one place");
  keys.number("smallest_um", cloud.smallest_um, between(0.5, 50), "droplets near the base have at least this effective radius");
  keys.integer("seed", cloud.seed, between(0, 9e15), "another seed, another cloud");
}

NewSpecies author_cloud(const CloudSettings& settings) {
  const Cloud cloud(settings);
  const double h = settings.voxel_m, depth = cloud.kind().depth_m;
  const double largest_um = std::max(settings.smallest_um * 1.01,
                                     effective_radius_um(cloud.adiabatic_g_per_m3(depth), settings.drops_per_cm3, settings.variance));
  const DropletExtinction extinction(settings.variance, settings.smallest_um, largest_um);
  NewSpecies species;
  species.name = settings.name;
  // Voxel (i, j, 0) is the first above the base.
  species.world_from_index = Affine::translation(settings.centre_m + Vec3(0, 0, settings.base_m)) * Affine::scaling(Vec3(h)) *
                             Affine::translation(Vec3(0.5));
  const auto reach = [&](double width) { return static_cast<int>(std::ceil(std::min(0.5 * width / h, 1e9))); };
  const int x = reach(settings.size_m[0]), y = reach(settings.size_m.back()), z = static_cast<int>(std::ceil(std::min(depth / h, 1e9)));
  fill({{-x, -y, 0}, {x - 1, y - 1, z}},
       [&](const Coord& c) -> FilledVoxel {
         const Vec3 p = Vec3(c.x + 0.5, c.y + 0.5, c.z + 0.5) * h;
         const double liquid = cloud.liquid_g_per_m3(p);
         if (liquid <= 0) return {};
         // Droplets grow with the height, undiluted: mixing thins out their number, not their size.
         const double radius = std::max(settings.smallest_um,
                                        effective_radius_um(cloud.adiabatic_g_per_m3(p.z), settings.drops_per_cm3, settings.variance));
         return {extinction.per_m(liquid, radius), radius};
       },
       "voxel_m", species);
  if (species.extinction.empty())
    throw bad_input("cloud", "no voxel with liquid water", "at least one expected", "The voxels may be larger than the clouds, or cover too small");
  const FilledRange range = range_of(species);
  species.recipe = droplet_recipe(settings.variance, range.smallest_size_um, range.largest_size_um);
  species.phase_id = phase::recipe_id(phase::recipe_from_text(species.recipe, "recipe of the cloud"));
  return species;
}

}  // namespace arcus::media
