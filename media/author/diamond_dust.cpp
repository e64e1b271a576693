#include "media/author/diamond_dust.h"

#include <algorithm>
#include <cmath>

#include "media/author/fill.h"
#include "media/author/noise.h"
#include "media/author/smooth_step.h"
#include "phase/base/error.h"

namespace arcus::media {

void list_keys(Keys& keys, DiamondDustSettings& dust) {
  keys.text("name", dust.name, "of the species NAME_HABIT: grids NAME_HABIT.extinction and NAME_HABIT.size");
  keys.vector3("centre_m", dust.centre_m, "middle of the domain, on the ground");
  keys.numbers("size_m", dust.size_m, above(0), 1, 2, "of the domain along x and y; one number: both");
  keys.number("depth_m", dust.depth_m, above(0), "of the layer over the ground; its upper half thins out");
  keys.number("voxel_m", dust.voxel_m, above(0), "edge of the voxels");
  keys.number("number_per_l", dust.number_per_l, above_up_to(0, 1e6), "crystals in a litre of air in the lower half, mean over the domain");
  keys.number("optical_depth", dust.optical_depth, at_least(0), "vertical, at 550 nm, mean over the domain; above 0 it decides the number");
  keys.numbers("crystal_um", dust.crystal_um, between(5, 5000), 1, 2, "maximum dimension at the ground and at the top; one number: both");
  keys.number("temperature_c", dust.temperature_c, between(-90, 0), "of the air [C], where by_temperature asks for it");
  keys.number("patchiness", dust.patchiness, between(0, 2), "standard deviation of ln N from place to place");
  keys.number("patch_m", dust.patch_m, above(0), "size of the largest patches");
  keys.integer("seed", dust.seed, between(0, 9e14), "another seed, other patches");
  list_keys(keys, dust.crystals);
}

AuthoredIce author_diamond_dust(const DiamondDustSettings& settings) {
  const IceMixture mixture(settings.crystals);
  const Noise patches(static_cast<std::uint64_t>(settings.seed) * 13 + 1);
  const double h = settings.voxel_m, t = settings.temperature_c, spread = settings.patchiness;
  const double half_x = 0.5 * settings.size_m[0], half_y = 0.5 * settings.size_m.back();
  NewSpecies ice;
  ice.world_from_index = Affine::translation(settings.centre_m) * Affine::scaling(Vec3(h)) * Affine::translation(Vec3(0.5));
  const auto reach = [&](double width) { return static_cast<int>(std::ceil(std::min(width / h, 1e9))); };
  const int x = reach(half_x), y = reach(half_y);
  fill({{-x, -y, 0}, {x - 1, y - 1, reach(settings.depth_m) - 1}},
       [&](const Coord& c) -> FilledVoxel {
         const Vec3 p = Vec3(c.x + 0.5, c.y + 0.5, c.z + 0.5) * h;
         const double height = p.z / settings.depth_m;
         if (height >= 1 || std::fabs(p.x) > half_x || std::fabs(p.y) > half_y) return {};
         const double size_um = settings.crystal_um[0] + height * (settings.crystal_um.back() - settings.crystal_um[0]);
         const double patch = std::exp(spread * patches.fractal(p * (1 / settings.patch_m), 4, 0.55) - 0.5 * spread * spread);
         const double per_m3 = 1e3 * settings.number_per_l * patch * smooth_step((1 - height) / 0.5);
         return {per_m3 / mixture.crystals_per_m3(1, size_um, t), size_um};
       },
       "voxel_m", ice);
  if (ice.extinction.empty())
    throw bad_input("diamond dust", "no voxel with crystals", "at least one expected", "The voxels may be larger than the layer is deep");
  return author_ice(ice, mixture, {settings.name, settings.size_m[0] * settings.size_m.back(), settings.optical_depth, [t](double) { return t; }});
}

}  // namespace arcus::media
