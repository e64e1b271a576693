#include "media/author/ice_mixture.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "media/author/fill.h"
#include "media/author/ice_climate.h"
#include "phase/settings/number_text.h"
#include "phase/settings/toml_text.h"
#include "phase/species/recipe.h"

namespace arcus::media {
namespace {

/// The words of `habits`: those of recipes, and the ways of lying that have names of their own.
const std::vector<std::string> habit_words{"plate",    "column", "needle",       "prism",         "pyramid", "bullet",
                                           "triangle", "parry",  "random_plate", "random_column", "lowitz"};

phase::CrystalSettings crystals_named(const std::string& word) {
  const bool is_flat = word == "random_plate" || word == "lowitz", is_long = word == "random_column" || word == "parry";
  phase::CrystalSettings crystals = phase::crystals_of_habit(is_flat ? "plate" : is_long ? "column" : word);
  if (is_flat || is_long) crystals.orientation.type = word.starts_with("random") ? "random" : word;
  return crystals;
}

int lean_of(const phase::CrystalSettings& crystals) {
  return crystals.habit.aspect_ratio > 1 ? 1 : crystals.habit.aspect_ratio < 0.5 ? -1 : 0;
}

/// Element i of a list in which one number stands for all.
double of(const std::vector<double>& list, std::size_t i) { return list.size() == 1 ? list[0] : list[i]; }

// Thinner ice, by that in the thickest voxel, is hardly seen.
constexpr float least_share_seen = 0.05f;

/// Steps of √2 from 100 µm.
double on_lattice(double step) { return std::round(100 * std::exp2(0.5 * step)); }

}  // namespace

void list_keys(Keys& keys, IceMixtureSettings& mixture) {
  keys.choices("habits", mixture.habits, habit_words,
               "shapes, and how they lie; each becomes a species NAME_HABIT. random_plate and random_column tumble, parry is a column with a side face up, lowitz a plate that spins about a diagonal");
  if (mixture.habits.empty()) keys.refuse("habits", "none", "at least one expected");
  for (std::size_t i = 1; i < mixture.habits.size(); ++i)
    if (std::find(mixture.habits.begin(), mixture.habits.begin() + static_cast<std::ptrdiff_t>(i), mixture.habits[i]) != mixture.habits.begin() + static_cast<std::ptrdiff_t>(i))
      keys.refuse("habits", "'" + mixture.habits[i] + "' twice", "each once expected");
  const auto list = [&](const char* name, std::vector<double>& values, const Range& range, const char* meaning) {
    keys.numbers(name, values, range, 1, habit_words.size(), meaning);
    if (values.size() != 1 && values.size() != mixture.habits.size())
      keys.refuse(name, std::to_string(values.size()) + " numbers", "one, or one for each of " + std::to_string(mixture.habits.size()) + " habits expected");
  };
  list("shares", mixture.shares, above(0), "of the habits in the ice, in proportion; one number: equal");
  list("tilt_deg", mixture.tilt_deg, between(0, 90), "standard deviation of the tilt of those that are oriented; one number: all");
  list("aspect_ratio", mixture.aspect_ratio, between(0, 1000), "length over diameter; one number: all; 0: by habit");
  keys.number("aspect_spread", mixture.aspect_spread, between(0, 2), "standard deviation of the logarithm of the aspect ratio");
  keys.flag("by_temperature", mixture.by_temperature,
            "whether flat habits have a larger share between -9 and -40 C, and long ones above and below, than shares says");
  keys.integer("size_nodes", mixture.size_nodes, between(1, 8),
               "at most so many sizes have phase functions of their own; fewer where crystals are so large that halos no longer depend on it");
}

IceMixture::IceMixture(const IceMixtureSettings& settings) : settings_(settings) {
  double sum = 0;
  for (std::size_t i = 0; i < settings.habits.size(); ++i) sum += of(settings.shares, i);
  for (std::size_t i = 0; i < settings.habits.size(); ++i) {
    phase::CrystalSettings crystals = crystals_named(settings.habits[i]);
    if (const double aspect_ratio = of(settings.aspect_ratio, i); aspect_ratio > 0) crystals.habit.aspect_ratio = aspect_ratio;
    crystals.aspect_spread = settings.aspect_spread;
    crystals.orientation.tilt_deg = of(settings.tilt_deg, i);
    // Parry's crystals rock about their long axis as much as they tilt; Lowitz's spin about their diagonal all the way.
    crystals.orientation.roll_deg = crystals.orientation.type == "lowitz" ? 180 : crystals.orientation.tilt_deg;
    parts_.push_back({settings.habits[i], crystals, IceCrystals(crystals), of(settings.shares, i) / sum, lean_of(crystals)});
  }
}

double IceMixture::weight(const Part& part, double temperature_c) const {
  if (!settings_.by_temperature || part.lean == 0) return part.share;
  const double columns = columnar_share(temperature_c);
  return part.share * 2 * (part.lean > 0 ? columns : 1 - columns);
}

double IceMixture::share(std::size_t i, double temperature_c) const {
  double sum = 0;
  for (const Part& part : parts_) sum += weight(part, temperature_c);
  return weight(parts_[i], temperature_c) / sum;
}

double IceMixture::extinction_per_m(double ice_g_per_m3, double size_um, double temperature_c) const {
  double sum = 0;
  for (std::size_t i = 0; i < parts_.size(); ++i)
    sum += parts_[i].crystals.extinction_per_m(share(i, temperature_c) * ice_g_per_m3, size_um);
  return sum;
}

double IceMixture::fall_speed_m_per_s(double size_um, double air_kg_per_m3, double temperature_c) const {
  double sum = 0;
  for (std::size_t i = 0; i < parts_.size(); ++i)
    sum += share(i, temperature_c) * parts_[i].crystals.fall_speed_m_per_s(size_um, air_kg_per_m3, temperature_c);
  return sum;
}

double IceMixture::crystals_per_m3(double ice_g_per_m3, double size_um, double temperature_c) const {
  double sum = 0;
  for (std::size_t i = 0; i < parts_.size(); ++i) sum += 1e-3 * share(i, temperature_c) * ice_g_per_m3 / parts_[i].crystals.mass_kg(size_um);
  return sum;
}

std::string IceMixture::recipe(std::size_t i, double smallest_um, double largest_um) const {
  phase::Recipe recipe = phase::default_recipe("crystal");
  recipe.crystal = parts_[i].settings;
  const double first = std::floor(2 * std::log2(smallest_um / 100) + 0.5), last = std::max(first, std::floor(2 * std::log2(largest_um / 100) + 0.5));
  long long nodes = std::min(settings_.size_nodes, static_cast<long long>(last - first) + 1);
  if (phase::is_diffraction_narrow(phase::CrystalPopulation(recipe.crystal, smallest_um))) nodes = 1;
  recipe.size_um.clear();
  for (long long n = 0; n < nodes; ++n)
    recipe.size_um.push_back(on_lattice(nodes == 1 ? std::floor(0.5 * (first + last)) : std::round(first + (last - first) * static_cast<double>(n) / static_cast<double>(nodes - 1))));
  return text_of(recipe);
}

namespace {

/// The bricks of one part; ice thinner than floats can hold is left out.
void fill_part(const NewSpecies& ice, const IceMixture& mixture, std::size_t part, double factor, const IceUse& use, NewSpecies& species) {
  species.extinction.resize(ice.extinction.size());
  species.size.resize(ice.extinction.size());
  tbb::parallel_for(std::size_t{0}, ice.extinction.size(), [&](std::size_t b) {
    const NewBrick& content = ice.extinction[b];
    species.extinction[b] = {content.origin, {}};
    species.size[b] = {content.origin, {}};
    for (int i = 0; i < SparseGrid::brick_voxels; ++i) {
      const auto at = static_cast<std::size_t>(i);
      if (content.values[at] == 0) continue;
      const double z_m = ice.world_from_index.point(Vec3(content.origin.x + (i >> 6), content.origin.y + (i >> 3 & 7), content.origin.z + (i & 7))).z;
      const double size_um = ice.size[b].values[at];
      const double own = factor * content.values[at] * mixture.share(part, use.temperature_c(z_m));
      const auto extinction = static_cast<float>(mixture.parts()[part].crystals.extinction_per_m(own, size_um));
      if (extinction == 0) continue;
      species.extinction[b].values[at] = extinction;
      species.size[b].values[at] = ice.size[b].values[at];
    }
  });
}

}  // namespace

AuthoredIce author_ice(const NewSpecies& ice, const IceMixture& mixture, const IceUse& use) {
  const FilledRange range = range_of(ice);  // its extinction is ice
  const Affine& map = ice.world_from_index;
  const double volume_m3 = std::fabs(map.determinant());
  double ice_g = 0, extinction_m2 = 0, largest = 0;
  for (std::size_t b = 0; b < ice.extinction.size(); ++b)
    for (int i = 0; i < SparseGrid::brick_voxels; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const double content = ice.extinction[b].values[at];
      if (content == 0) continue;
      const Coord origin = ice.extinction[b].origin;
      const double z_m = map.point(Vec3(origin.x + (i >> 6), origin.y + (i >> 3 & 7), origin.z + (i & 7))).z;
      const double extinction = mixture.extinction_per_m(content, ice.size[b].values[at], use.temperature_c(z_m));
      ice_g += content * volume_m3;
      extinction_m2 += extinction * volume_m3;
      largest = std::max(largest, extinction);
    }
  const double factor = use.optical_depth > 0 ? use.optical_depth * use.area_m2 / extinction_m2 : 1;
  // Sizes of the last wisps need no phase functions of their own.
  FilledRange seen;
  seen.smallest_size_um = std::numeric_limits<float>::max();
  for (std::size_t b = 0; b < ice.extinction.size(); ++b)
    for (std::size_t i = 0; i < SparseGrid::brick_voxels; ++i) {
      if (ice.extinction[b].values[i] < least_share_seen * range.largest_extinction_per_m) continue;
      seen.smallest_size_um = std::min(seen.smallest_size_um, ice.size[b].values[i]);
      seen.largest_size_um = std::max(seen.largest_size_um, ice.size[b].values[i]);
    }
  AuthoredIce result;
  result.ice_kg = 1e-3 * factor * ice_g;
  result.mean_optical_depth = factor * extinction_m2 / use.area_m2;
  result.largest_extinction_per_m = static_cast<float>(factor * largest);
  result.smallest_size_um = range.smallest_size_um;
  result.largest_size_um = range.largest_size_um;
  for (std::size_t i = 0; i < mixture.parts().size(); ++i) {
    NewSpecies species;
    species.name = use.name + "_" + mixture.parts()[i].habit;
    species.world_from_index = map;
    fill_part(ice, mixture, i, factor, use, species);
    species.recipe = mixture.recipe(i, seen.smallest_size_um, seen.largest_size_um);
    species.phase_id = phase::recipe_id(phase::recipe_from_text(species.recipe, "recipe of the ice"));
    result.species.push_back(std::move(species));
  }
  return result;
}

}  // namespace arcus::media
