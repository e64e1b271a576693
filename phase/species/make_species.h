#pragma once
// From a recipe to a species: closed forms at once, tables from the cache or computed on all cores.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "phase/species/recipe.h"
#include "phase/species/species.h"

namespace arcus::phase {

struct SpeciesOptions {
  /// Radius of the sun's disc that phase functions are averaged over beside their own values [rad]; 0: they are not.
  double sun_angular_radius_rad = 0;
  /// How bright that disc is from its centre to its edge.
  DiscKind disc = DiscKind::limb_darkened;
  /// How high the sun stands [deg]: oriented crystals get a map of the sky for it, and without it none.
  std::optional<double> sun_elevation_deg;
  /// Cross-sections by size node that extinction coefficients refer to, where those are not the recipe's own; see Species. Spheres alone.
  std::vector<double> counted_m2;
  /// Where computed tables are kept; empty: nowhere. default_cache_folder() is where users expect them.
  std::string cache_folder;
  /// Gets warnings, and what takes long; may be empty.
  std::function<void(std::string_view)> log;
  /// Gets the share of a computation that is done, 0 to 1, from one thread at a time; may be empty.
  std::function<void(double)> progress;
};

/// The species of a recipe. Throws bad_input for what cannot be computed, with the key that is wrong.
std::shared_ptr<const Species> make_species(const Recipe& recipe, const SpeciesOptions& options);

/// The table of a recipe of a type that has one (mie, rain, crystals that lie at random, table): from the cache, or computed and kept.
ScatteringTable table_of(const Recipe& recipe, const SpeciesOptions& options);

/// The same, computed; what a cache keeps and `arcus phase compute` writes.
ScatteringTable compute_table(const Recipe& recipe, const std::function<void(double)>& progress = {});

}  // namespace arcus::phase
