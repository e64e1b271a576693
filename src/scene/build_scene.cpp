#include "src/scene/build_scene.h"

#include <cmath>
#include <cstdio>
#include <map>

#include "media/grid/stored_medium.h"
#include "media/tracking/collision_walk.h"
#include "phase/base/error.h"
#include "phase/settings/number_text.h"
#include "phase/settings/toml_text.h"
#include "phase/species/make_species.h"
#include "src/scene/colour_spectrum.h"

namespace arcus::render {
namespace {

media::Affine placement(const MediumSettings& settings) {
  return media::Affine::translation(settings.translate_m) * media::Affine::rotation_deg(settings.rotate_deg) *
         media::Affine::scaling(Vec3(settings.scale));
}

/// The recipe that a medium's particles follow: the scene's where it gives one, else the file's own.
phase::Recipe recipe_of(const MediumSettings& settings, const media::StoredMedium& stored, const std::string& where,
                        const std::string& folder) {
  if (settings.has_phase) {
    if (!settings.phase_file.empty()) return phase::recipe_from_file(path_from(folder, settings.phase_file));
    phase::Recipe recipe = settings.phase;
    phase::resolve_files(recipe, folder);
    return recipe;
  }
  if (stored.is_species) return phase::recipe_from_text(stored.recipe, where + ": recipe of " + stored.name);
  throw bad_input(where, "the plain density grid '" + stored.name + "' and no phase",
                  "a recipe of its phase functions expected in the scene",
                  "For instance: phase = { type = \"hg\", g = 0.85 }");
}

std::string name_of(const MediumSettings& settings, const SceneSettings& scene) {
  return scene.path + ": medium '" + (settings.name.empty() ? settings.vdb : settings.name) + "'";
}

/// Species that were made once, by their recipe: several media of a scene may share one.
using MadeSpecies = std::map<std::string, std::shared_ptr<const phase::Species>>;

void add_medium(const MediumSettings& settings, const SceneSettings& scene, const BuildOptions& options, MadeSpecies& made,
                std::vector<media::Component>& components) {
  const std::string where = name_of(settings, scene);
  const std::string path = path_from(scene.folder, settings.vdb);
  media::StoredMedia stored = media::read_media(path, settings.grid);
  for (const std::string& note : stored.notes)
    if (options.log) options.log(note);

  phase::SpeciesOptions species_options;
  species_options.sun_angular_radius_rad = radians(scene.sun.angular_radius_deg);
  if (scene.sun.irradiance_scale > 0) species_options.sun_elevation_deg = scene.sun.elevation_deg;
  species_options.cache_folder = options.cache_folder;
  species_options.log = options.log;
  for (media::StoredMedium& one : stored.media) {
    const phase::Recipe recipe = recipe_of(settings, one, where, scene.folder);
    media::Component component;
    component.name = one.name;
    auto& species = made[text_of(recipe)];
    if (!species) species = phase::make_species(recipe, species_options);
    component.species = species;
    component.grid = one.grid;
    component.world_from_index = placement(settings) * one.world_from_index;
    component.interpolation =
        settings.interpolation == "nearest" ? media::Interpolation::nearest : media::Interpolation::linear;
    component.extinction_scale = one.is_species ? 1 : static_cast<float>(settings.extinction_per_m);
    component.albedo_scale = static_cast<float>(settings.albedo);
    component.size_um = one.size_um;
    const std::vector<double>& sizes = component.species->size_nodes_um();
    if (!one.is_species && component.size_um == 0) {
      if (sizes.size() > 1 && options.log)
        options.log(where + ": the grid has no sizes; all particles get the recipe's middle size node");
      component.size_um = static_cast<float>(sizes[sizes.size() / 2]);
    }
    if (one.is_species && settings.extinction_per_m != 1)
      throw bad_input(where + ": extinction_per_m", number_text(settings.extinction_per_m),
                      "must be left out: the grids of a species are in 1/m");
    components.push_back(std::move(component));
  }
}

/// Tells what will not be seen, or nothing but white: the usual sign of a wrong unit.
void report_depth(const media::Medium& medium, const BuildOptions& options) {
  if (!options.log || medium.is_empty()) return;
  const media::Box& box = medium.bounds_m();
  char text[200];
  double depth[3];
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 direction(0, 0, 0), origin = box.centre();
    direction[axis] = 1;
    origin[axis] = box.low[axis];
    depth[axis] = media::majorant_depth(medium, {origin, direction});
  }
  std::snprintf(text, sizeof text, "media: %.4g x %.4g x %.4g m, optical depth through the middle at most %.3g, %.3g, %.3g",
                box.size().x, box.size().y, box.size().z, depth[0], depth[1], depth[2]);
  options.log(text);
}

Surfaces make_surfaces(const SceneSettings& scene) {
  SurfaceParts parts;
  for (const SurfaceSettings& surface : scene.surfaces) parts.add(surface, scene.folder, spectrum_of_colour);
  for (std::size_t i = 0; i < scene.droplets.size(); ++i) {
    const DropletsSettings& drops = scene.droplets[i];
    const std::string where = scene.path + ": droplets[" + std::to_string(i) + "]";
    parts.add(drops_in_box(drops, where), make_material(drops.material, scene.folder, spectrum_of_colour));
  }
  return Surfaces(std::move(parts), scene.render.intersector == "exhaustive");
}

}  // namespace

Scene build_scene(const SceneSettings& settings, const BuildOptions& options) {
  std::vector<media::Component> components;
  MadeSpecies made;
  for (const MediumSettings& medium : settings.media) add_medium(medium, settings, options, made, components);
  auto medium = std::make_unique<const media::Medium>(std::move(components));
  report_depth(*medium, options);
  const Curve irradiance = sun_irradiance(settings.sun, settings.folder);
  return Scene{.medium = std::move(medium),
               .sun = Sun(settings.sun, irradiance),
               .sky = Sky(settings.sky, irradiance),
               .surfaces = make_surfaces(settings),
               .camera = make_camera(settings.camera)};
}

}  // namespace arcus::render
