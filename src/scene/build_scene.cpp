#include "src/scene/build_scene.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "media/grid/stored_medium.h"
#include "media/tracking/collision_walk.h"
#include "phase/base/error.h"
#include "phase/settings/number_text.h"
#include "phase/settings/toml_text.h"
#include "phase/species/make_species.h"
#include "src/film/image_file.h"
#include "src/scene/colour_basis.h"
#include "src/scene/colour_spectrum.h"
#include "src/scene/droplets_from_medium.h"
#include "src/scene/sky_picture.h"

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

/// How particles of a recipe are by geometric optics, and what an extinction by the recipe itself means for them.
void make_geometric(phase::Recipe& recipe, phase::SpeciesOptions& options, const std::string& where) {
  if (!recipe.is_sphere()) throw bad_input(where, "a phase function of type '" + recipe.type + "'", "drops expected: type mie or rain");
  if (recipe.optics == "geometric") return;
  options.counted_m2 = phase::cross_sections_at_550_nm_m2(phase::table_of(recipe, options));
  recipe.optics = "geometric";
}

/// Species that were made once, by their recipe: several media of a scene may share one.
using MadeSpecies = std::map<std::string, std::shared_ptr<const phase::Species>>;

/// One grid of a medium, and what it holds.
struct Kind {
  media::Component component;  ///< without species
  phase::Recipe recipe;
};

std::vector<Kind> read_medium(const MediumSettings& settings, const SceneSettings& scene, const BuildOptions& options) {
  const std::string where = name_of(settings, scene);
  media::StoredMedia stored = media::read_media(path_from(scene.folder, settings.vdb), settings.grid);
  for (const std::string& note : stored.notes)
    if (options.log) options.log(note);
  std::vector<Kind> kinds;
  for (media::StoredMedium& one : stored.media) {
    Kind kind{{}, recipe_of(settings, one, where, scene.folder)};
    media::Component& component = kind.component;
    component.name = one.name;
    component.grid = one.grid;
    component.world_from_index = placement(settings) * one.world_from_index;
    component.interpolation =
        settings.interpolation == "nearest" ? media::Interpolation::nearest : media::Interpolation::linear;
    component.extinction_scale = one.is_species ? 1 : static_cast<float>(settings.extinction_per_m);
    component.albedo_scale = static_cast<float>(settings.albedo);
    component.size_um = one.size_um;
    if (one.is_species && settings.extinction_per_m != 1)
      throw bad_input(where + ": extinction_per_m", number_text(settings.extinction_per_m),
                      "must be left out: the grids of a species are in 1/m");
    kinds.push_back(std::move(kind));
  }
  return kinds;
}

/// Where the grid has no sizes and nobody says one.
void choose_size(media::Component& component, const std::vector<double>& size_nodes_um, const std::string& where, const BuildOptions& options) {
  if (component.size_um != 0 || component.grid->has_size()) return;
  if (size_nodes_um.size() > 1 && options.log)
    options.log(where + ": the grid has no sizes; all particles get the recipe's middle size node");
  component.size_um = static_cast<float>(size_nodes_um[size_nodes_um.size() / 2]);
}

phase::SpeciesOptions species_options(const SceneSettings& scene, const BuildOptions& options) {
  phase::SpeciesOptions result;
  result.sun_angular_radius_rad = radians(scene.sun.angular_radius_deg);
  result.disc = scene.sun.disc();
  if (scene.sun.irradiance_scale > 0) result.sun_elevation_deg = scene.sun.elevation_deg;
  result.cache_folder = options.cache_folder;
  result.log = options.log;
  return result;
}

void add_medium(const MediumSettings& settings, const SceneSettings& scene, const BuildOptions& options, MadeSpecies& made,
                std::vector<media::Component>& components) {
  const std::string where = name_of(settings, scene);
  for (Kind& kind : read_medium(settings, scene, options)) {
    phase::SpeciesOptions with = species_options(scene, options);
    if (settings.is_geometric) make_geometric(kind.recipe, with, where);
    auto& species = made[text_of(kind.recipe) + (settings.is_geometric ? " by rays" : "")];
    if (!species) species = phase::make_species(kind.recipe, with);
    kind.component.species = species;
    choose_size(kind.component, species->size_nodes_um(), where, options);
    components.push_back(std::move(kind.component));
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

/// Such a medium is not there itself.
bool is_shown_as_drops(const MediumSettings& medium, const SceneSettings& scene) {
  return !medium.name.empty() &&
         std::any_of(scene.droplets.begin(), scene.droplets.end(), [&](const DropletsSettings& drops) { return drops.medium == medium.name; });
}

/// The medium of that name.
const MediumSettings& medium_of(const DropletsSettings& drops, const SceneSettings& scene, const std::string& where) {
  std::vector<std::string> names;
  for (const MediumSettings& medium : scene.media) {
    if (medium.name == drops.medium) return medium;
    if (!medium.name.empty()) names.push_back(medium.name);
  }
  throw bad_input(where + ": medium", "'" + drops.medium + "'", "the name of a [[medium]] of the scene expected" + (names.empty() ? "" : ": " + list_of(names)));
}

/// Drops that stand for a medium; `material` becomes what they are made of.
PieceGroup drops_of_medium(const DropletsSettings& drops, const SceneSettings& scene, const std::string& where, const BuildOptions& options,
                           MaterialSettings& material) {
  std::vector<DropSource> sources;
  for (Kind& kind : read_medium(medium_of(drops, scene, where), scene, options)) {
    const phase::Recipe& recipe = kind.recipe;
    if (!recipe.is_sphere())
      throw bad_input(where + ": medium", "'" + drops.medium + "' with a phase function of type '" + recipe.type + "'",
                      "a medium of drops expected: type mie or rain");
    if (!sources.empty() && recipe.material != material.index)
      throw bad_input(where + ": medium", "'" + drops.medium + "' with drops of '" + material.index + "' and of '" + recipe.material + "'",
                      "drops of one material expected", "Choose one with the medium's key `grid`");
    material.index = recipe.material;
    material.index_constant = recipe.index;
    choose_size(kind.component, recipe.size_um, where, options);
    sources.push_back({std::move(kind.component), recipe.distribution, recipe.size_um,
                       phase::cross_sections_at_550_nm_m2(phase::table_of(recipe, species_options(scene, options)))});
  }
  DrawnDrops drawn = drops_from_medium(sources, drops.count, drops.seed, where);
  if (options.log) {
    char text[100];
    std::snprintf(text, sizeof text, ": %lld drops for %.4g, enlarged %.4g times", drops.count, drawn.number_meant, drawn.enlargement);
    options.log(where + text);
  }
  material.enlargement = drawn.enlargement;
  return std::move(drawn.group);
}

SurfaceInputs surface_inputs() {
  return {spectrum_of_colour, read_colours, read_heights, [made = std::shared_ptr<const ThreeSpectra>()]() mutable {
            if (!made) made = std::make_shared<const ThreeSpectra>(reflectance_basis());
            return made;
          }};
}

/// A camera under the land sees its underside: a mistake.
void check_camera_above(const Terrain& terrain, const SurfaceSettings& surface, const SceneSettings& scene) {
  const Vec3& eye = scene.camera.position_m;
  const auto land_m = terrain.height_m(eye.x, eye.y);
  if (land_m && !(eye.z > *land_m))
    throw bad_input(scene.path + ": camera.position_m", "a place " + number_text(std::round(100 * (*land_m - eye.z)) / 100) + " m below the land of surface '" + surface.name + "'",
                    "a height above " + number_text(std::round(100 * *land_m) / 100) + " m there expected");
}

Surfaces make_surfaces(const SceneSettings& scene, const BuildOptions& options) {
  SurfaceParts parts;
  const SurfaceInputs inputs = surface_inputs();
  for (const SurfaceSettings& surface : scene.surfaces) {
    parts.add(surface, scene.folder, inputs);
    if (surface.shape.type == "terrain") check_camera_above(*parts.groups.back().terrain, surface, scene);
  }
  for (std::size_t i = 0; i < scene.droplets.size(); ++i) {
    const DropletsSettings& drops = scene.droplets[i];
    const std::string where = scene.path + ": droplets[" + std::to_string(i) + "]";
    MaterialSettings material = drops.material;
    material.enlargement = drops.scale;
    PieceGroup group = drops.medium.empty() ? drops_in_box(drops, where) : drops_of_medium(drops, scene, where, options, material);
    parts.add(std::move(group), make_material(material, scene.folder, inputs, where));
  }
  return Surfaces(std::move(parts), scene.render.intersector == "exhaustive");
}

/// Around all that light of the air may fall on, or shadows reach: what is there, the camera, and down to the ground away from the sun.
media::Box air_region_m(const Scene& scene, const Vec3& camera_m) {
  constexpr double farthest_shadow_m = 40000;
  media::Box region = scene.medium->bounds_m();
  region.include(scene.surfaces.bounds_m());
  if (!region.is_empty() && region.high.z > 0) {
    const Vec3 to_sun = scene.sun.to_centre();
    const double level = std::hypot(to_sun.x, to_sun.y);
    const double reach_m = to_sun.z > 0 ? std::min(farthest_shadow_m, region.high.z * level / to_sun.z) : farthest_shadow_m;
    const Vec3 away = level > 0 ? Vec3(to_sun.x, to_sun.y, 0) * (-reach_m / level) : Vec3(0, 0, 0);
    const media::Box there = region;
    region.include(Vec3(there.low.x, there.low.y, 0) + away);
    region.include(Vec3(there.high.x, there.high.y, 0) + away);
    region.low.z = std::min(region.low.z, 0.0);
  }
  region.include(camera_m);
  return region;
}

void add_air(const SceneSettings& settings, const BuildOptions& options, Scene& scene) {
  const SkySettings& sky = settings.sky;
  const media::AirSettings air = air_of(sky);
  if (air.haze_depth_550 < 0)
    throw bad_input(settings.path + ": sky.haze_visibility_m", number_text(sky.haze.visibility_m), "farther than one sees through clean air",
                    "Leave haze out, or say haze_optical_depth");
  scene.air.emplace(air);
  if (scene.air->height_m(settings.camera.position_m) < 0)
    throw bad_input(settings.path + ": camera.position_m", "a place below sea level", "a height above 0 over the round planet expected: the air of a clear sky ends there",
                    "z = 0 is sea level under the origin; far from it the planet curves away below");
  if (air.haze_depth_550 > 0) scene.haze = std::make_shared<const media::Haze>(sky.haze.type, species_options(settings, options));
  if (sky.ground_albedo > 0) scene.ground.emplace(Matte(sky.ground_albedo));
  if (sky.method != "table" || !scene.sun.is_on()) return;
  scene.air_region_m = air_region_m(scene, settings.camera.position_m);
  // From higher up one sees farther around the planet than the table's light is known, and its heights are too far apart.
  constexpr double highest_tabulated_m = 20000;
  const double highest_m = std::max(scene.air_region_m.high.z, scene.air->height_m(settings.camera.position_m));
  if (highest_m > highest_tabulated_m) {
    if (options.log) options.log(settings.path + ": sky: the scene or its camera reaches " + number_text(std::round(highest_m / 1000)) + " km up, where the table of the sky does not hold: all air is traced");
    return;
  }
  constexpr double above_region_m = 2000;  // level surfaces reach farther, where the planet curves away from them
  const media::SkySettings light{scene.sun.to_centre(), scene.sun.angular_radius_rad(), sky.ground_albedo};
  const media::Box& region = scene.air_region_m;
  const double farthest_m = std::max(std::hypot(region.low.x, region.low.y), std::hypot(region.high.x, region.high.y));
  scene.sky_table = std::make_unique<const media::SkyTable>(*scene.air, scene.haze, light, region.high.z + above_region_m, farthest_m);
}

}  // namespace

Scene build_scene(const SceneSettings& settings, const BuildOptions& options) {
  std::vector<media::Component> components;
  MadeSpecies made;
  for (const MediumSettings& medium : settings.media)
    if (!is_shown_as_drops(medium, settings)) add_medium(medium, settings, options, made, components);
  auto medium = std::make_unique<const media::Medium>(std::move(components));
  report_depth(*medium, options);
  const Curve irradiance = sun_irradiance(settings.sun, settings.folder);
  Scene scene{.medium = std::move(medium),
              .sun = Sun(settings.sun, irradiance),
              .sky = Sky(settings.sky, irradiance, read_sky_picture(settings, irradiance)),
              .surfaces = make_surfaces(settings, options),
              .camera = make_camera(settings.camera)};
  if (settings.sky.type == "clear") add_air(settings, options, scene);
  return scene;
}

}  // namespace arcus::render
