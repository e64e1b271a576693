#include "media/author/water_field.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "media/author/droplets.h"
#include "media/author/fill.h"
#include "phase/base/error.h"
#include "phase/settings/number_text.h"
#include "phase/species/recipe.h"

namespace arcus::media {
namespace {

/// Six digits: what a float holds.
std::string words(double x) {
  if (std::isnan(x)) return "NaN";
  if (std::isinf(x)) return x < 0 ? "-infinity" : "infinity";
  char text[40];
  std::snprintf(text, sizeof text, "%.6g", x);
  return text;
}

std::string place_words(const WaterField& field, const Coord& c) {
  const auto z = static_cast<std::size_t>(c.z);
  return field.where + ": cell (" + std::to_string(c.x) + ", " + std::to_string(c.y) + ", " + std::to_string(c.z) + ") at x = " +
         words(field.first_x_m + c.x * field.step_x_m) + " m, y = " + words(field.first_y_m + c.y * field.step_y_m) +
         " m, z = " + words(0.5 * (field.level_m[z] + field.level_m[z + 1])) + " m";
}

template <class Visit>
void for_cells(const Coord& n, const Visit& visit) {
  for (int x = 0; x < n.x; ++x)
    for (int y = 0; y < n.y; ++y)
      for (int z = 0; z < n.z; ++z) visit(Coord{x, y, z});
}

/// Water and effective radius of every cell, checked.
struct Cells {
  std::vector<float> water_g_per_m3, radius_um;
  std::size_t negative = 0, too_small = 0, too_large = 0, cloudy = 0;
};

Cells cells_of(const WaterField& field, const DropletSettings& s) {
  Cells cells;
  cells.water_g_per_m3 = field.water_g_per_m3;
  cells.radius_um.resize(cells.water_g_per_m3.size());
  const float largest = *std::max_element(cells.water_g_per_m3.begin(), cells.water_g_per_m3.end());
  for_cells(field.count, [&](const Coord& c) {
    const std::size_t at = field.place(c);
    float& water = cells.water_g_per_m3[at];
    if (!std::isfinite(water) || water < -1e-6f * std::max(largest, 0.f))
      throw bad_input(place_words(field, c), words(water) + " g/m3 of water", "a finite value that is not negative expected",
                      std::isnan(water) ? "Write 0 where there is no cloud" : "");
    if (water < 0) ++cells.negative;
    if (!(water > s.least_water_g_per_m3)) {
      water = 0;
      return;
    }
    ++cells.cloudy;
    double radius = s.size_um;
    if (!field.radius_um.empty()) {
      radius = field.radius_um[at];
      if (!(radius > 0) || std::isinf(radius))
        throw bad_input(place_words(field, c), "an effective radius of " + words(radius) + " um beside " + words(water) + " g/m3 of water",
                        "a radius above 0 expected");
    } else if (!field.drops_per_cm3.empty() || s.drops_per_cm3 > 0) {
      const double drops = field.drops_per_cm3.empty() ? s.drops_per_cm3 : field.drops_per_cm3[at];
      if (!(drops > 0) || std::isinf(drops))
        throw bad_input(place_words(field, c), words(drops) + " droplets in a cm3 beside " + words(water) + " g/m3 of water",
                        "a number above 0 expected", "least_water_g_per_m3 leaves out thin water");
      radius = effective_radius_um(water, drops, s.variance);
    }
    if (radius < s.smallest_um) ++cells.too_small;
    if (radius > s.largest_um) ++cells.too_large;
    cells.radius_um[at] = static_cast<float>(std::clamp(radius, s.smallest_um, s.largest_um));
  });
  return cells;
}

/// The layers as even voxels.
struct Layers {
  double first_m = 0, height_m = 1;  // lower bound of the first, and how high they are
  int count = 0;
  bool are_even = true;
};

Layers layers_of(const WaterField& field, double height_m) {
  const std::vector<double>& z = field.level_m;
  const auto n = z.size() - 1;
  Layers layers{z.front(), (z.back() - z.front()) / static_cast<double>(n), static_cast<int>(n), true};
  double thinnest = layers.height_m;
  for (std::size_t k = 0; k < n; ++k) {
    const double thickness = z[k + 1] - z[k];
    thinnest = std::min(thinnest, thickness);
    if (std::fabs(thickness - layers.height_m) > 1e-3 * layers.height_m) layers.are_even = false;
  }
  if (height_m > 0 && std::fabs(height_m - layers.height_m) > 1e-6 * layers.height_m) layers.are_even = false;
  if (layers.are_even) return layers;
  layers.height_m = height_m > 0 ? height_m : thinnest;
  layers.count = static_cast<int>(std::ceil(std::min((z.back() - z.front()) / layers.height_m - 1e-6, 1e9)));
  return layers;
}

/// Mean water and size of a voxel that reaches over several layers.
struct Mixed {
  double water_g_per_m3 = 0, radius_um = 0;
};
Mixed mixed(const WaterField& field, const Cells& cells, const Coord& column, double bottom_m, double top_m) {
  const std::vector<double>& z = field.level_m;
  auto k = static_cast<std::size_t>(std::max<std::ptrdiff_t>(std::upper_bound(z.begin(), z.end(), bottom_m) - z.begin() - 1, 0));
  double water = 0, water_by_radius = 0;
  for (; k + 1 < z.size() && z[k] < top_m; ++k) {
    const std::size_t at = field.place({column.x, column.y, static_cast<int>(k)});
    const double overlap = std::min(top_m, z[k + 1]) - std::max(bottom_m, z[k]);
    if (overlap <= 0 || cells.water_g_per_m3[at] == 0) continue;
    water += overlap * cells.water_g_per_m3[at];
    water_by_radius += overlap * cells.water_g_per_m3[at] / cells.radius_um[at];
  }
  if (water == 0) return {};
  return {water / (top_m - bottom_m), water / water_by_radius};
}

std::string percent(std::size_t part, std::size_t whole) {
  return number_text(std::round(1000.0 * static_cast<double>(part) / static_cast<double>(whole)) / 10) + " % of the cells with water";
}

}  // namespace

void list_keys(Keys& keys, DropletSettings& droplets) {
  keys.number("number_per_cm3", droplets.drops_per_cm3, between(0, 1e5),
              "droplets in a cm3, the same everywhere; 0: by a variable of the file, or all of size_um");
  keys.number("variance", droplets.variance, between(1e-4, 0.3), "effective variance of the droplets' sizes at one place");
  keys.number("smallest_um", droplets.smallest_um, between(0.5, 50), "smaller effective radii count as this");
  keys.number("largest_um", droplets.largest_um, between(1, 200), "larger effective radii count as this");
  if (droplets.largest_um < droplets.smallest_um) keys.refuse("largest_um", number_text(droplets.largest_um), "must be at least smallest_um");
  keys.number("least_water_g_per_m3", droplets.least_water_g_per_m3, at_least(0), "cells with less water count as clear air");
  keys.number("layer_m", droplets.layer_m, at_least(0), "height of the voxels that uneven layers become; 0: that of the thinnest layer");
}

std::vector<double> bounds_between(const std::vector<double>& level_m, double alone_m) {
  if (level_m.size() == 1) return {level_m[0] - 0.5 * alone_m, level_m[0] + 0.5 * alone_m};
  std::vector<double> bounds;
  bounds.push_back(level_m[0] - 0.5 * (level_m[1] - level_m[0]));
  for (std::size_t k = 1; k < level_m.size(); ++k) bounds.push_back(0.5 * (level_m[k - 1] + level_m[k]));
  bounds.push_back(level_m.back() + 0.5 * (level_m.back() - level_m[level_m.size() - 2]));
  return bounds;
}

WaterSpecies species_of_water(const WaterField& field, const DropletSettings& settings) {
  const Cells cells = cells_of(field, settings);
  if (cells.cloudy == 0)
    throw bad_input(field.where, "no cell with more than " + number_text(settings.least_water_g_per_m3) + " g/m3 of water", "at least one expected",
                    "Another variable or time may be meant, or another unit");
  float smallest = static_cast<float>(settings.largest_um), largest = static_cast<float>(settings.smallest_um);
  for (std::size_t i = 0; i < cells.radius_um.size(); ++i) {
    if (cells.water_g_per_m3[i] == 0) continue;
    smallest = std::min(smallest, cells.radius_um[i]);
    largest = std::max(largest, cells.radius_um[i]);
  }
  const DropletExtinction extinction(settings.variance, smallest, std::max(largest, 1.01f * smallest));
  const Layers layers = layers_of(field, settings.layer_m);
  WaterSpecies result;
  result.species.world_from_index =
      Affine::translation(Vec3(field.first_x_m, field.first_y_m, layers.first_m + 0.5 * layers.height_m)) *
      Affine::scaling(Vec3(field.step_x_m, field.step_y_m, layers.height_m));
  fill({{0, 0, 0}, {field.count.x - 1, field.count.y - 1, layers.count - 1}},
       [&](const Coord& c) -> FilledVoxel {
         Mixed voxel;
         if (layers.are_even) {
           voxel = {cells.water_g_per_m3[field.place(c)], cells.radius_um[field.place(c)]};
         } else {
           const double bottom = layers.first_m + c.z * layers.height_m;
           voxel = mixed(field, cells, c, bottom, bottom + layers.height_m);
         }
         if (voxel.water_g_per_m3 <= 0) return {};
         return {extinction.per_m(voxel.water_g_per_m3, voxel.radius_um), voxel.radius_um};
       },
       "layer_m", result.species);
  result.species.recipe = droplet_recipe(settings.variance, smallest, largest);
  result.species.phase_id = phase::recipe_id(phase::recipe_from_text(result.species.recipe, "recipe of the droplets"));
  if (!layers.are_even)
    result.notes.push_back(std::to_string(field.count.z) + " uneven layers became " + std::to_string(layers.count) + " of " +
                           words(layers.height_m) + " m; every column keeps its water and optical depth");
  if (cells.negative > 0) result.notes.push_back(std::to_string(cells.negative) + " cells with water below 0 by rounding count as 0");
  if (cells.too_small > 0)
    result.notes.push_back(percent(cells.too_small, cells.cloudy) + " have an effective radius below smallest_um and get " +
                           number_text(settings.smallest_um) + " um");
  if (cells.too_large > 0)
    result.notes.push_back(percent(cells.too_large, cells.cloudy) + " have an effective radius above largest_um and get " +
                           number_text(settings.largest_um) + " um");
  return result;
}

}  // namespace arcus::media
