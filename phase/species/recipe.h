#pragma once
// A plain description of a kind of particle, from which its phase functions follow: everything that decides a table,
// and nothing else. Equal recipes have equal canonical texts (text_of) and equal ids.

#include <string>
#include <string_view>
#include <vector>

#include "phase/crystal/crystal_population.h"
#include "phase/optics/refractive_index.h"
#include "phase/population/sizes.h"
#include "phase/settings/keys.h"

namespace arcus::phase {

/// Which keys count depends on the type; a change of type while reading brings that type's defaults.
struct Recipe {
  std::string type = "mie";  ///< hg | isotropic | rayleigh | table | mie | rain | crystal

  double g = 0.85;                 ///< hg: mean cosine
  double depolarisation = 0.0279;  ///< rayleigh: of natural light scattered at 90°
  std::string file;                ///< table: see read_table_file

  // mie, rain and crystal
  std::string material = "water";  ///< water | ice | mineral | a file; empty: `index` holds
  ConstantIndexSettings index;
  /// Size nodes: effective radii, of crystals mean maximum dimensions (empty in a new Recipe: the defaults of its type).
  std::vector<double> size_um;
  std::vector<double> wavelength_nm;   ///< wavelength nodes, vacuum (empty: the default)
  std::string optics = "wave";         ///< wave | geometric
  std::string forward_lobe = "remove"; ///< remove | scatter

  // mie and rain
  SizesSettings distribution;
  long long radii = 30000;  ///< spheres that stand for the whole population, shared by all size nodes

  // crystal
  CrystalSettings crystal;
  double size_spread = 0;     ///< standard deviation of the logarithm of the sizes around a node (log-normal)
  /// Traced at each wavelength for a table or a map, in millions; 0: 1 for a table, 4 for a map.
  double rays_million = 0;
  double rays() const { return 1e6 * (rays_million > 0 ? rays_million : is_oriented() ? 4 : 1); }
  double map_step_deg = 0.1;  ///< oriented: between the nodes of the map of the sky
  double map_noise = 0.03;    ///< oriented: relative standard error of the map, up to which it is smoothed

  /// mie or rain: the kinds whose table this library computes.
  bool is_sphere() const { return type == "mie" || type == "rain"; }
  bool is_crystal() const { return type == "crystal"; }
  /// Crystals whose scattering depends on where the light comes from, and not on the angle alone.
  bool is_oriented() const { return is_crystal() && crystal.orientation.type != "random"; }
};
void list_keys(Keys&, Recipe&);

/// A recipe of that type with all its defaults; type as in Recipe.
Recipe default_recipe(std::string_view type);

/// Reads a recipe; `where` names the text in messages. File names in it stay as they are. Throws bad_input.
Recipe recipe_from_text(std::string_view text, std::string_view where);

/// Reads a recipe file; file names in it are relative to its folder.
Recipe recipe_from_file(const std::string& path);

/// Makes the file names in a recipe relative to `folder`, the place of the file that held it.
void resolve_files(Recipe& recipe, const std::string& folder);

/// File names that are found from any folder: for a recipe that goes into a file of its own.
void make_files_absolute(Recipe& recipe);

/// What `material` or `index` say. Throws bad_input where a file cannot be read.
RefractiveIndex refractive_index_of(const Recipe& recipe);

/// 32 hexadecimal digits that name the table of a recipe: a hash (XXH3-128) of its canonical text, with the values of
/// the optical constants and the content of files in place of file names, and of the version of the computation. Not
/// cryptographic. Throws bad_input where a file cannot be read.
std::string recipe_id(const Recipe& recipe);

}  // namespace arcus::phase
