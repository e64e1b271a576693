#pragma once
// A whole scene as one plain struct: what the file says, complete with defaults. No object of the scene exists yet.

#include <span>
#include <string>
#include <vector>

#include "phase/settings/keys.h"
#include "phase/species/recipe.h"
#include "src/camera/camera.h"
#include "src/film/film.h"
#include "src/light/sky.h"
#include "src/light/sun.h"
#include "src/shape/droplets.h"
#include "src/shape/surfaces.h"

namespace arcus::render {

/// How a picture is computed.
struct RenderSettings {
  std::string integrator = "volume_path";  ///< volume_path | ray_cast | whitted | path | photon_map
  std::string intersector = "hierarchy";   ///< hierarchy | exhaustive
  long long samples_per_pixel = 64;
  long long max_bounces = 128;  ///< scatterings and reflections a path may have; 0: only what is seen directly
  long long seed = 1;
  // Of photon_map:
  long long photons = 1000000;  ///< sent in a pass towards mirrors and clear bodies, if there are any, and a quarter as many over the whole scene
  long long neighbours = 50;    ///< photons that a density is estimated from
  long long iterations = 0;     ///< of relaxation, at most; 0: none
  long long passes = 1;         ///< maps that are averaged, the later ones with fewer neighbours
  bool final_gather = true;     ///< light from matte to matte is looked up one bounce away
};
void list_keys(Keys& keys, RenderSettings& render);

/// One [[medium]]: a VDB file and what to make of it.
struct MediumSettings {
  std::string name;
  std::string vdb;                     ///< file, relative to the scene file
  std::string grid;                    ///< a plain density grid of that name; empty: the file's species, or its only grid
  double extinction_per_m = 1;         ///< of a plain density grid: per unit of density, at 550 nm
  double albedo = 1;                   ///< multiplies the recipe's own
  std::string phase_file;              ///< a recipe file, relative to the scene file
  phase::Recipe phase;                 ///< where there is no recipe file
  /// The same particles by geometric optics, as many of them: for comparison with explicit drops. Not a key.
  bool is_geometric = false;
  bool has_phase = false;              ///< the scene gives a recipe; otherwise the VDB's own counts
  std::string interpolation = "linear";
  double scale = 1;                    ///< applied after the grid's own transform, in this order:
  Vec3 rotate_deg{0, 0, 0};            ///< about x, then y, then z
  Vec3 translate_m{0, 0, 0};
};
void list_keys(Keys& keys, MediumSettings& medium);

struct SceneSettings {
  RenderSettings render;
  CameraSettings camera;
  FilmSettings film;
  SunSettings sun;
  SkySettings sky;
  std::vector<MediumSettings> media;
  std::vector<SurfaceSettings> surfaces;
  std::vector<DropletsSettings> droplets;
  std::string folder;  ///< of the scene file: relative paths start here; not a key
  std::string path;    ///< of the scene file, for messages; not a key
};
void list_keys(Keys& keys, SceneSettings& scene);

/// Reads a scene file. overrides: "table.key=VALUE". Throws bad_input with file, line and column.
SceneSettings read_scene(const std::string& path, std::span<const std::string> overrides);

}  // namespace arcus::render
