#include "media/author/droplets.h"

#include <algorithm>
#include <cmath>

#include "phase/base/units.h"
#include "phase/population/sizes.h"
#include "phase/settings/toml_text.h"
#include "phase/species/evaluate.h"

namespace arcus::media {
namespace {

constexpr double water_g_per_m3 = 1e6;
constexpr double wavelength_nm = 550;
constexpr long long radii = 400;  // Q within 0.5 %: extinction needs no resonances resolved

phase::Recipe recipe_of(double variance) {
  phase::Recipe recipe = phase::default_recipe("mie");
  recipe.distribution.type = "gamma";
  recipe.distribution.variance = variance;
  return recipe;
}

}  // namespace

double effective_radius_um(double liquid_g_per_m3, double drops_per_cm3, double variance) {
  const double cubic_metres_a_drop = liquid_g_per_m3 / water_g_per_m3 / (drops_per_cm3 * 1e6);
  return 1e6 * std::cbrt(cubic_metres_a_drop * 3 / (4 * pi) / ((1 - variance) * (1 - 2 * variance)));
}

DropletExtinction::DropletExtinction(double variance, double smallest_um, double largest_um) {
  constexpr int nodes = 12;
  phase::Recipe recipe = recipe_of(variance);
  recipe.radii = radii;
  first_ = std::log(smallest_um);
  per_node_ = std::max(std::log(largest_um / smallest_um) / (nodes - 1), 1e-9);
  for (int i = 0; i < nodes; ++i) {
    const double radius_um = std::exp(first_ + i * per_node_);
    const double angle_deg[] = {90};
    const double disc_m2 = pi * phase::Sizes(recipe.distribution, radius_um).mean_power_um(2) * 1e-12;
    efficiency_.push_back(phase::evaluate_recipe(recipe, radius_um, wavelength_nm, angle_deg).extinction_m2 / disc_m2);
  }
}

double DropletExtinction::efficiency(double effective_radius_um) const {
  const double place = std::clamp((std::log(effective_radius_um) - first_) / per_node_, 0.0, static_cast<double>(efficiency_.size() - 1));
  const auto node = std::min(static_cast<std::size_t>(place), efficiency_.size() - 2);
  const double share = place - static_cast<double>(node);
  return (1 - share) * efficiency_[node] + share * efficiency_[node + 1];
}

double DropletExtinction::per_m(double liquid_g_per_m3, double effective_radius_um) const {
  return 0.75 * efficiency(effective_radius_um) * liquid_g_per_m3 / water_g_per_m3 / (effective_radius_um * 1e-6);
}

std::string droplet_recipe(double variance, double smallest_um, double largest_um) {
  constexpr double per_octave = 7.5;
  phase::Recipe recipe = recipe_of(variance);
  const int first = static_cast<int>(std::floor(std::log2(smallest_um) * per_octave + 1e-6));
  const int last = std::max(first, static_cast<int>(std::ceil(std::log2(largest_um) * per_octave - 1e-6)));
  recipe.size_um.clear();
  for (int k = first; k <= last; ++k) recipe.size_um.push_back(std::round(1e3 * std::exp2(k / per_octave)) / 1e3);
  return text_of(recipe);
}

}  // namespace arcus::media
