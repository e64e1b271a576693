#include "phase/species/evaluate.h"

#include <algorithm>

#include "phase/base/error.h"
#include "phase/function/analytic.h"
#include "phase/population/average.h"
#include "phase/population/sizes.h"
#include "phase/settings/number_text.h"
#include "phase/species/make_species.h"

namespace arcus::phase {
namespace {

template <class Function>
MatrixRow closed_form(const Function& function, std::span<const double> angle_deg) {
  MatrixRow row;
  row.asymmetry = function.asymmetry();
  for (const double degrees : angle_deg) {
    const double sine = std::sin(0.5 * radians(degrees)), cosine = std::cos(0.5 * radians(degrees));
    row.p11.push_back(function.value_per_sr(HalfAngle{sine * sine, cosine * cosine}));
  }
  row.p12.assign(row.p11.size(), 0);
  row.p33 = row.p11;
  row.p34.assign(row.p11.size(), 0);
  return row;
}

/// Hansen and Travis (1974), eq. 2.15.
MatrixRow rayleigh(double depolarisation, std::span<const double> angle_deg) {
  MatrixRow row = closed_form(Rayleigh(depolarisation), angle_deg);
  const double share = (1 - depolarisation) / (1 + depolarisation / 2);
  for (std::size_t i = 0; i < angle_deg.size(); ++i) {
    const double cosine = std::cos(radians(angle_deg[i]));
    row.p12[i] = -3 / (16 * pi) * share * (1 - cosine * cosine);
    row.p33[i] = 3 / (8 * pi) * share * cosine;
  }
  return row;
}

MatrixRow spheres(const Recipe& recipe, double size_um, double wavelength_nm, std::span<const double> angle_deg) {
  std::vector<double> sorted(angle_deg.begin(), angle_deg.end());
  sorted.push_back(0);
  sorted.push_back(180);
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());

  const std::complex<double> index = refractive_index_of(recipe).relative_to_air(wavelength_nm);
  const SphereAverage average({Sizes(recipe.distribution, size_um)}, sorted, wavelength_nm, recipe.radii,
                              SphereAverage::rays_serve(index));
  const PopulationMeans means = average.means(wavelength_nm, index);

  MatrixRow row;
  row.extinction_m2 = means.extinction_m2[0];
  row.scattering_m2 = means.scattering_m2[0];
  row.asymmetry = means.asymmetry[0];
  std::vector<double>* const elements[matrix_elements] = {&row.p11, &row.p12, &row.p33, &row.p34};
  for (const double degrees : angle_deg) {
    const auto place = static_cast<std::size_t>(std::lower_bound(sorted.begin(), sorted.end(), degrees) - sorted.begin());
    for (std::size_t e = 0; e < matrix_elements; ++e) elements[e]->push_back(means.matrix[e * sorted.size() + place]);
  }
  return row;
}

MatrixRow crystals(const Recipe& recipe, double size_um, double wavelength_nm, std::span<const double> angle_deg) {
  Recipe single = recipe;
  single.size_um = {size_um};
  single.wavelength_nm = {wavelength_nm};
  const ScatteringTable table = compute_table(single);
  const std::vector<double>& nodes = table.scattering_angle_deg;
  MatrixRow row;
  row.extinction_m2 = table.extinction_cross_section_m2[0];
  row.scattering_m2 = table.scattering_cross_section_m2[0];
  row.asymmetry = table.asymmetry[0];
  row.forward_fraction = table.forward_fraction[0];
  for (const double degrees : angle_deg) {
    const auto upper = static_cast<std::size_t>(std::upper_bound(nodes.begin() + 1, nodes.end() - 1, degrees) - nodes.begin());
    const double s0 = sin2_half_deg(nodes[upper - 1]), s1 = sin2_half_deg(nodes[upper]);
    const double share = (sin2_half_deg(degrees) - s0) / (s1 - s0);
    const auto at = [&](const std::vector<float>& values) { return values[upper - 1] + share * (values[upper] - values[upper - 1]); };
    row.p11.push_back(at(table.p11));
    row.p12.push_back(at(table.p12));
  }
  row.p33.assign(row.p11.size(), 0);
  row.p34 = row.p33;
  return row;
}

}  // namespace

MatrixRow evaluate_recipe(const Recipe& recipe, double size_um, double wavelength_nm,
                          std::span<const double> angle_deg) {
  for (const double degrees : angle_deg)
    if (!(degrees >= 0 && degrees <= 180))
      throw bad_input("scattering angle", number_text(degrees), "0 to 180 degrees expected");
  if (recipe.type == "hg") return closed_form(HenyeyGreenstein(recipe.g), angle_deg);
  if (recipe.type == "isotropic") return closed_form(Isotropic(), angle_deg);
  if (recipe.type == "rayleigh") return rayleigh(recipe.depolarisation, angle_deg);
  if (recipe.is_sphere()) return spheres(recipe, size_um, wavelength_nm, angle_deg);
  if (recipe.is_crystal()) return crystals(recipe, size_um, wavelength_nm, angle_deg);
  throw bad_input("recipe", "type '" + recipe.type + "'", "a recipe whose functions are computed expected");
}

}  // namespace arcus::phase
