#pragma once
// arcus phase plot of crystals: the whole sky, and which ray paths make a place of it.

#include <CLI/App.hpp>

#include <string>
#include <vector>

#include "phase/species/recipe.h"

namespace arcus::tools {

/// What only the sky has; the rest is shared with the curves.
struct SkyCommand {
  std::vector<std::string> recipes;  ///< files
  std::string output, cache_folder;
  double size_um = 0;                ///< 0: each recipe's middle node
  double sun_radius_deg = 0.2666;
  bool quiet = false;

  double sun_elevation_deg = 20;
  std::string weights;
  bool below = false, label = false, plain = false, exact_path = false, json = false;
  std::string projection = "equidistant";
  double decades = 3.5, exposure_ev = 0;
  int size_px = 1000;
  std::vector<std::string> ray_paths, without_paths;
  std::string paths_at;
  double radius_deg = 0.5;
  double rays_million = 0, map_step_deg = 0;  ///< 0: the recipe's
};

/// The options beside those that are shared.
void add_sky_options(CLI::App& app, SkyCommand& command);

/// recipes: those of the files, all of crystals.
void run_sky(const SkyCommand& command, std::vector<phase::Recipe> recipes);

}  // namespace arcus::tools
