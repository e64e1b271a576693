#include "src/scene/settings.h"

#include <filesystem>

#include "phase/settings/toml_text.h"

namespace arcus::render {

void list_keys(Keys& keys, RenderSettings& render) {
  keys.choice("integrator", render.integrator, {"volume_path", "ray_cast", "whitted", "path", "photon_map"},
              "how light is followed. volume_path: paths through media and surfaces; path: surfaces alone; photon_map: from the sun and from the eye, "
              "for caustics; whitted: a tree of reflected and transmitted rays; ray_cast: the first surface without shadows");
  keys.choice("intersector", render.intersector, {"hierarchy", "exhaustive"},
              "how the first surface is found; exhaustive: by asking every one, for measurement alone");
  keys.integer("samples_per_pixel", render.samples_per_pixel, between(1, 4294967295.0), "paths a pixel");
  keys.integer("max_bounces", render.max_bounces, between(0, 1e9),
               "scatterings and reflections a path may have; 0: only what is seen directly");
  keys.integer("seed", render.seed, between(0, 9e15), "another seed, another noise");
  keys.integer("photons", render.photons, between(1, 1e9),
               "photon_map: sent in a pass towards mirrors and clear bodies, and a quarter as many over the whole scene; all of them without such bodies");
  keys.integer("neighbours", render.neighbours, between(1, 1000),
               "photon_map: photons around a place that its light is estimated from; 50 to 200, after relaxation 8 to 12");
  keys.integer("iterations", render.iterations, between(0, 1000), "photon_map: of photon relaxation, at most; 0: none");
  keys.integer("passes", render.passes, between(1, 10000),
               "photon_map: maps that are averaged, later ones with fewer neighbours: bias and noise fall together");
  keys.flag("final_gather", render.final_gather, "photon_map: light from matte to matte and within media is looked up one bounce away");
}

void list_keys(Keys& keys, MediumSettings& medium) {
  keys.text("name", medium.name, "for messages, and for droplets drawn from it");
  keys.text("vdb", medium.vdb, "OpenVDB file, relative to the scene file");
  if (medium.vdb.empty() && !keys.documents()) keys.refuse("vdb", "nothing", "the name of a .vdb file expected");
  keys.text("grid", medium.grid,
            "plain density grid of that name, or name[index]; without it the file's species are used, or its only grid");
  keys.number("extinction_per_m", medium.extinction_per_m, at_least(0),
              "of a plain density grid: extinction per unit of density at 550 nm, diffraction included [1/m]");
  keys.number("albedo", medium.albedo, between(0, 1), "multiplies the recipe's own single-scattering albedo");
  medium.has_phase = medium.has_phase || keys.is_given("phase");
  if (keys.only_if(medium.has_phase, "optional"))
    keys.word_or_table("phase", medium.phase_file, medium.phase,
                       "recipe of the phase functions: a table of recipe keys or the name of a recipe file");
  keys.choice("interpolation", medium.interpolation, {"linear", "nearest"}, "between the voxels");
  keys.number("scale", medium.scale, above(0), "applied after the grid's own transform");
  keys.vector3("rotate_deg", medium.rotate_deg, "applied after scale: about x, then y, then z");
  keys.vector3("translate_m", medium.translate_m, "applied last");
}

void list_keys(Keys& keys, SceneSettings& scene) {
  keys.table("render", scene.render, "how the picture is computed");
  keys.table("camera", scene.camera, "from where it is seen");
  keys.table("film", scene.film, "what is kept of the light");
  keys.table("sun", scene.sun, "the sun");
  keys.table("sky", scene.sky, "all other light from outside");
  keys.tables("medium", scene.media, "what scatters");
  keys.tables("surface", scene.surfaces, "what stands in it");
  keys.tables("droplets", scene.droplets, "explicit drops, for comparison with a medium");
}

SceneSettings read_scene(const std::string& path, std::span<const std::string> overrides) {
  SceneSettings scene;
  scene.path = path;
  scene.folder = std::filesystem::path(path).parent_path().string();
  read_toml_file(path, overrides, [&](Keys& keys) { list_keys(keys, scene); });
  return scene;
}

}  // namespace arcus::render
