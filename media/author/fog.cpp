#include "media/author/fog.h"

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

/// What a kind means where the settings say 0. (Visibility is 3.9 over the extinction: 90 and 50 m.)
struct Kind {
  double top_m, liquid_g_per_m3, radius_um, radius_at_base_um;
  bool is_advection;
};
Kind kind_of(const FogSettings& s) {
  Kind kind = s.kind == "advection" ? Kind{200, 0.4, 10, 8, true} : Kind{60, 0.15, 7, 5, false};
  if (s.top_m > 0) kind.top_m = s.top_m;
  if (s.liquid_g_per_m3 > 0) kind.liquid_g_per_m3 = s.liquid_g_per_m3;
  if (s.radius_um > 0) kind.radius_um = s.radius_um;
  if (s.radius_at_base_um > 0) kind.radius_at_base_um = s.radius_at_base_um;
  return kind;
}

/// The fog as a function of position, z over its base.
class Fog {
 public:
  explicit Fog(const FogSettings& s)
      : s_(s),
        kind_(kind_of(s)),
        depth_m_(kind_.top_m - s.base_m),
        waves_m_(s.waves_m > 0 ? s.waves_m : 0.1 * depth_m_),
        patches_(static_cast<std::uint64_t>(s.seed) * 7 + 1),
        top_(static_cast<std::uint64_t>(s.seed) * 7 + 2) {}
  const Kind& kind() const { return kind_; }
  double highest_m() const { return depth_m_ + 4 * waves_m_; }

  /// Height over the base relative to the local top; above 1 there is nothing.
  double height(const Vec3& p) const {
    const double top = depth_m_ + waves_m_ * std::clamp(top_.fractal(Vec3(p.x, p.y, 0) * (1 / (3 * s_.patch_m)), 4, 0.5), -4.0, 4.0);
    return top > 0 ? p.z / (top * rim(p.x, p.y)) : 2;
  }
  double liquid_g_per_m3(const Vec3& p) const {
    const double z = height(p);
    if (!(z >= 0 && z < 1)) return 0;
    // Advection fog: even. Radiation fog: grows to two thirds of its height. Both end softly at the top.
    const double profile = (kind_.is_advection ? 1 : 0.5 + 0.5 * smooth_step(z / 0.65)) * smooth_step((1 - z) / 0.25);
    const double patch = patches_.fractal(p * (1 / s_.patch_m), 4, 0.55);
    return kind_.liquid_g_per_m3 * profile * std::exp(s_.patchiness * patch - 0.5 * s_.patchiness * s_.patchiness);
  }
  double radius_um(const Vec3& p) const {
    const double z = std::min(1.0, height(p));
    return kind_.radius_at_base_um + (kind_.radius_um - kind_.radius_at_base_um) * z;
  }

 private:
  /// Radiation fog lies in a hollow: its top sinks towards the rim of the domain.
  double rim(double x, double y) const {
    if (kind_.is_advection) return 1;
    const double from_rim = 1 - std::max(std::fabs(x) / (0.5 * s_.size_m[0]), std::fabs(y) / (0.5 * s_.size_m.back()));
    return std::max(1e-6, smooth_step(from_rim / 0.25));
  }

  const FogSettings& s_;
  Kind kind_;
  double depth_m_, waves_m_;
  Noise patches_, top_;
};

}  // namespace

void list_keys(Keys& keys, FogSettings& fog) {
  keys.choice("kind", fog.kind, {"radiation", "advection"}, "of a clear night in a hollow, or of damp air over cold water; decides what is 0 below");
  keys.text("name", fog.name, "of the species: grids NAME.extinction and NAME.size");
  keys.vector3("centre_m", fog.centre_m, "middle of the domain, on the ground");
  keys.numbers("size_m", fog.size_m, above(0), 1, 2, "of the domain along x and y; one number: both");
  keys.number("base_m", fog.base_m, at_least(0), "height above the ground where it begins");
  keys.number("top_m", fog.top_m, at_least(0), "mean height of its top; 0: 60 for radiation, 200 for advection");
  const double top = kind_of(fog).top_m;
  if (!(top > fog.base_m) && !keys.documents()) keys.refuse("top_m", number_text(top), "must be above base_m");
  keys.number("voxel_m", fog.voxel_m, above(0), "edge of the voxels");
  keys.number("liquid_g_per_m3", fog.liquid_g_per_m3, between(0, 5), "greatest liquid water of the mean profile; 0: 0.15 for radiation, 0.4 for advection");
  keys.number("radius_um", fog.radius_um, between(0, 50), "effective radius of the droplets at the top; 0: 7 for radiation, 10 for advection");
  keys.number("radius_at_base_um", fog.radius_at_base_um, between(0, 50), "and at the base; 0: 5 for radiation, 8 for advection");
  keys.number("variance", fog.variance, between(1e-4, 0.3), "effective variance of the droplets' sizes at one place");
  keys.number("patchiness", fog.patchiness, between(0, 2), "standard deviation of ln LWC from place to place");
  keys.number("patch_m", fog.patch_m, above(0), "size of the largest patches");
  keys.number("waves_m", fog.waves_m, at_least(0), "standard deviation of the top's height; 0: a tenth of the depth");
  keys.integer("seed", fog.seed, between(0, 9e15), "another seed, another fog");
}

NewSpecies author_fog(const FogSettings& settings) {
  const Fog fog(settings);
  const double h = settings.voxel_m;
  const auto [smallest_um, largest_um] = std::minmax(fog.kind().radius_um, fog.kind().radius_at_base_um);
  const DropletExtinction extinction(settings.variance, smallest_um, std::max(largest_um, smallest_um * 1.01));
  NewSpecies species;
  species.name = settings.name;
  species.world_from_index = Affine::translation(settings.centre_m + Vec3(0, 0, settings.base_m)) * Affine::scaling(Vec3(h)) *
                             Affine::translation(Vec3(0.5));
  const auto reach = [&](double width) { return static_cast<int>(std::ceil(std::min(width / h, 1e9))); };
  const int x = reach(0.5 * settings.size_m[0]), y = reach(0.5 * settings.size_m.back()), z = reach(fog.highest_m());
  fill({{-x, -y, 0}, {x - 1, y - 1, z}},
       [&](const Coord& c) -> FilledVoxel {
         const Vec3 p = Vec3(c.x + 0.5, c.y + 0.5, c.z + 0.5) * h;
         const double liquid = fog.liquid_g_per_m3(p);
         if (liquid <= 0) return {};
         const double radius = fog.radius_um(p);
         return {extinction.per_m(liquid, radius), radius};
       },
       "voxel_m", species);
  if (species.extinction.empty())
    throw bad_input("fog", "no voxel with liquid water", "at least one expected", "The voxels may be larger than the fog is deep");
  const FilledRange range = range_of(species);
  species.recipe = droplet_recipe(settings.variance, range.smallest_size_um, range.largest_size_um);
  species.phase_id = phase::recipe_id(phase::recipe_from_text(species.recipe, "recipe of the fog"));
  return species;
}

}  // namespace arcus::media
