#include "media/air/haze.h"

#include <cmath>

#include "phase/base/error.h"
#include "phase/optics/air.h"
#include "phase/species/recipe.h"

namespace arcus::media {

double haze_depth_550(const HazeSettings& settings, double molecules_per_m3) {
  if (settings.visibility_m == 0) return settings.optical_depth;
  const double all_per_m = std::log(50.0) / settings.visibility_m;
  return (all_per_m - molecules_per_m3 * phase::air_scattering_cross_section_m2(550)) * settings.scale_height_m;
}

std::vector<HazeMode> haze_modes(const std::string& type) {
  const HazeMode soluble{"water-soluble", 0, 0.0306, 2.24, "", 1.399, 1.995e-3}, insoluble{"insoluble", 0, 0.471, 2.51, "", 1.530, 8e-3},
      soot{"soot", 0, 0.0118, 2.00, "", 1.75, 0.44}, fine_salt{"sea salt, accumulation", 0, 0.416, 2.03, "", 1.354, 3e-9},
      coarse_salt{"sea salt, coarse", 0, 3.49, 2.03, "", 1.354, 3e-9}, fine_dust{"mineral, nucleation", 0, 0.07, 1.95, "mineral", 0, 0},
      dust{"mineral, accumulation", 0, 0.39, 2.00, "mineral", 0, 0}, coarse_dust{"mineral, coarse", 0, 1.90, 2.15, "mineral", 0, 0};
  const auto of = [](HazeMode mode, double particles_per_cm3) {
    mode.particles_per_cm3 = particles_per_cm3;
    return mode;
  };
  if (type == "continental") return {of(soluble, 7000), of(insoluble, 0.4), of(soot, 8300)};
  if (type == "maritime") return {of(soluble, 1500), of(fine_salt, 20), of(coarse_salt, 3.2e-3)};
  if (type == "desert") return {of(soluble, 2000), of(fine_dust, 269.5), of(dust, 30.5), of(coarse_dust, 0.142)};
  throw bad_input("haze", "'" + type + "'", "continental, maritime or desert expected");
}

phase::Recipe recipe_of(const HazeMode& mode) {
  phase::Recipe recipe = phase::default_recipe("mie");
  const double s = std::log(mode.geometric_deviation);
  recipe.material = mode.material;
  if (mode.material.empty()) recipe.index = {mode.n, mode.k};
  recipe.size_um = {mode.median_um * std::exp(2.5 * s * s)};
  recipe.distribution.type = "lognormal";
  recipe.distribution.variance = std::expm1(s * s);
  return recipe;
}

Haze::Haze(const std::string& type, const phase::SpeciesOptions& options) {
  double sum = 0;
  for (const HazeMode& mode : haze_modes(type)) {
    const phase::Recipe recipe = recipe_of(mode);
    std::shared_ptr<const phase::Species> species = phase::make_species(recipe, options);
    const double extinction = mode.particles_per_cm3 * phase::cross_sections_at_550_nm_m2(*species->table())[0];
    sum += extinction;
    modes_.push_back({std::move(species), static_cast<float>(extinction), static_cast<float>(recipe.size_um[0])});
  }
  for (Mode& mode : modes_) mode.share /= static_cast<float>(sum);
}

Spectrum Haze::extinction_ratio(int mode, const Wavelengths& wavelengths) const {
  const Mode& one = modes_[static_cast<std::size_t>(mode)];
  return one.species->extinction_ratio(one.size_um, wavelengths) * one.share;
}

Spectrum Haze::albedo(int mode, const Wavelengths& wavelengths) const {
  const Mode& one = modes_[static_cast<std::size_t>(mode)];
  return one.species->albedo(one.size_um, wavelengths);
}

phase::PhaseFunction Haze::phase_function(int mode) const {
  const Mode& one = modes_[static_cast<std::size_t>(mode)];
  return one.species->phase_function(one.size_um, 0);  // it has one size node
}

}  // namespace arcus::media
