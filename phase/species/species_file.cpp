#include "phase/species/species_file.h"

#include <vector>

#include "phase/base/version.h"
#include "phase/species/netcdf_table.h"

namespace arcus::phase {
namespace {

constexpr int format = 1;

const char* const references =
    "Lorenz-Mie series: C. F. Bohren and D. R. Huffman, Absorption and Scattering of Light by Small Particles "
    "(Wiley 1983). Size distributions: J. E. Hansen and L. D. Travis, Space Sci. Rev. 16, 527 (1974); J. S. Marshall "
    "and W. McK. Palmer, J. Meteor. 5, 165 (1948). Water: M. Daimon and A. Masumura, Appl. Opt. 46, 3811 (2007); D. J. "
    "Segelstein, thesis, Univ. of Missouri-Kansas City (1981). Ice: S. G. Warren and R. E. Brandt, J. Geophys. Res. "
    "113, D14220 (2008). Air: B. Edlen, Metrologia 2, 71 (1966).";

/// Name, unit and meaning of every variable, and where it lies in a table: the one list for writing and reading.
using Variable = TableVariable;
constexpr Variable size_axis{"size_um", "um", "effective radius of the particles"};
constexpr Variable wavelength_axis{"wavelength_nm", "nm", "wavelength in vacuum"};
constexpr Variable angle_axis{"scattering_angle_deg", "degree", "scattering angle, 0 is straight on"};

template <class Table, class Action>
void for_each_cross_section(Table& t, const Action& action) {
  action(Variable{"extinction_cross_section", "m2", "mean extinction cross-section of a particle"},
         t.extinction_cross_section_m2);
  action(Variable{"scattering_cross_section", "m2", "mean scattering cross-section of a particle"},
         t.scattering_cross_section_m2);
  action(Variable{"asymmetry", "1", "mean cosine of the scattering angle"}, t.asymmetry);
  action(Variable{"forward_fraction", "1",
                  "share of the extinction that goes straight on: the lobe of P11 inside forward_angle_deg, or, where that is 0, light that is in no P11"},
         t.forward_fraction);
}

template <class Table, class Action>
void for_each_element(Table& t, const Action& action) {
  action(Variable{"P11", "sr-1", "scattering matrix element P11, integral over the sphere 1"}, t.p11);
  action(Variable{"P12", "sr-1", "scattering matrix element P12, normalised as P11"}, t.p12);
  action(Variable{"P33", "sr-1", "scattering matrix element P33, normalised as P11"}, t.p33);
  action(Variable{"P34", "sr-1", "scattering matrix element P34, normalised as P11"}, t.p34);
}

const std::vector<int> by_row{0, 1}, by_angle{0, 1, 2};

}  // namespace

void write_species_file(const std::string& path, const SpeciesFile& file) {
  const ScatteringTable& t = file.table;
  NetcdfTableWriter to(path);
  to.text("Conventions", "CF-1.8");
  to.text("title", "Light scattering by a population of particles");
  to.text("source", std::string("arcus ") + version);
  to.text("program_version", version);
  to.integer("arcus_format", format);
  to.text("recipe", file.recipe);
  to.text("recipe_id", file.recipe_id);
  to.text("references", references);
  to.text("comment",
          "Between angle nodes the elements are linear in sin(theta/2)^2; so interpolated, P11 integrates to 1. "
          "P22 = P11 and P44 = P33 for spheres; P33 and P34 of crystals are unknown and 0. The forward lobe is included where "
          "forward_angle_deg is above 0; where it is 0, P11 is of what does not go straight on. No disc of the sun.");
  to.number("forward_angle_deg", t.forward_angle_deg);
  to.number("normalisation_error", t.normalisation_error);
  to.number("angle_error", t.angle_error);
  to.axis(size_axis, t.size_um);
  to.axis(wavelength_axis, t.wavelength_nm);
  to.axis(angle_axis, t.scattering_angle_deg);
  for_each_cross_section(t, [&](const Variable& v, const auto& values) { to.variable(v, values, by_row); });
  for_each_element(t, [&](const Variable& v, const auto& values) { to.variable(v, values, by_angle); });
  to.commit();
}

SpeciesFile read_species_file(const std::string& path) {
  NetcdfTableReader from(path, "phase table", format);
  SpeciesFile file;
  ScatteringTable& t = file.table;
  from.axis(size_axis, t.size_um, 100000);
  from.axis(wavelength_axis, t.wavelength_nm, 100000);
  from.axis(angle_axis, t.scattering_angle_deg, 10000000);
  for_each_cross_section(t, [&](const Variable& v, auto& values) { from.variable(v, values, by_row); });
  for_each_element(t, [&](const Variable& v, auto& values) { from.variable(v, values, by_angle); });
  t.forward_angle_deg = from.number("forward_angle_deg");
  t.normalisation_error = from.number("normalisation_error");
  t.angle_error = from.number("angle_error");
  file.recipe = from.text("recipe");
  file.recipe_id = from.text("recipe_id");
  file.program_version = from.text("program_version");
  check_table(t, path);
  return file;
}

}  // namespace arcus::phase
