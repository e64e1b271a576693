#include "media/author/box.h"

#include <algorithm>
#include <cmath>

#include "phase/base/error.h"
#include "phase/settings/number_text.h"
#include "phase/settings/toml_text.h"

namespace arcus::media {
namespace {

constexpr double most_voxels = 5e8;

/// Number of voxels along each axis.
Coord counts_of(const BoxSettings& settings) {
  Vec3 counts(0);
  if (settings.voxels.size() == 1) {
    const Vec3& size = settings.size_m;
    const double edge = std::min({size.x, size.y, size.z}) / settings.voxels[0];
    for (int axis = 0; axis < 3; ++axis) counts[axis] = std::max(1.0, std::round(size[axis] / edge));
  } else {
    for (int axis = 0; axis < 3; ++axis) counts[axis] = std::round(settings.voxels[static_cast<std::size_t>(axis)]);
  }
  if (counts.x * counts.y * counts.z > most_voxels)
    throw bad_input("voxels", number_text(counts.x * counts.y * counts.z) + " voxels", "at most 5e8 expected");
  return {static_cast<int>(counts.x), static_cast<int>(counts.y), static_cast<int>(counts.z)};
}

}  // namespace

void list_keys(Keys& keys, BoxSettings& box) {
  keys.text("name", box.name, "of the species: its grid is NAME.extinction");
  keys.vector3("centre_m", box.centre_m, "middle of the block");
  keys.vector3("size_m", box.size_m, "lengths of its edges; each above 0");
  for (int axis = 0; axis < 3; ++axis)
    if (!(box.size_m[axis] > 0) && !keys.documents()) keys.refuse("size_m", number_text(box.size_m[axis]), "must be above 0");
  keys.number("extinction_per_m", box.extinction_per_m, at_least(0), "extinction at 550 nm, diffraction included");
  keys.number("optical_depth", box.optical_depth, at_least(0),
              "optical depth along z at 550 nm; above 0 it decides the extinction");
  keys.numbers("voxels", box.voxels, between(1, 100000), 1, 3,
               "number of voxels along x, y and z, or one number: along the shortest edge, with cubes");
  if (box.voxels.size() == 2) keys.refuse("voxels", "2 numbers", "must be one or three");
  keys.number("size_um", box.size_um, above(0), "size of all particles");
  keys.word_or_table("phase", box.phase_file, box.phase,
                     "recipe of the phase functions: a table of recipe keys or the name of a recipe file");
}

NewSpecies author_box(const BoxSettings& settings, const std::string& folder) {
  const Coord n = counts_of(settings);
  const Vec3 voxel_m(settings.size_m.x / n.x, settings.size_m.y / n.y, settings.size_m.z / n.z);
  const double extinction =
      settings.optical_depth > 0 ? settings.optical_depth / settings.size_m.z : settings.extinction_per_m;

  phase::Recipe recipe =
      settings.phase_file.empty() ? settings.phase : phase::recipe_from_file(path_from(folder, settings.phase_file));
  if (settings.phase_file.empty()) phase::resolve_files(recipe, folder);
  phase::make_files_absolute(recipe);
  NewSpecies species;
  species.name = settings.name;
  species.recipe = text_of(recipe);
  species.phase_id = phase::recipe_id(recipe);
  species.size_um = static_cast<float>(settings.size_um);
  // A voxel's value sits in the middle of its part of the block.
  species.world_from_index = Affine::translation(settings.centre_m - settings.size_m * 0.5) * Affine::scaling(voxel_m) *
                             Affine::translation(Vec3(0.5));
  constexpr int edge = SparseGrid::brick_edge;
  for (int x = 0; x < n.x; x += edge)
    for (int y = 0; y < n.y; y += edge)
      for (int z = 0; z < n.z; z += edge) {
        NewBrick brick{{x, y, z}, {}};
        for (int i = 0; i < SparseGrid::brick_voxels; ++i)
          if (x + (i >> 6) < n.x && y + (i >> 3 & 7) < n.y && z + (i & 7) < n.z)
            brick.values[static_cast<std::size_t>(i)] = static_cast<float>(extinction);
        species.extinction.push_back(brick);
      }
  return species;
}

}  // namespace arcus::media
