#include "phase/optics/air.h"

#include "phase/base/curve.h"
#include "phase/data/embedded.h"

namespace arcus::phase {

double air_scattering_cross_section_m2(double wavelength_nm) {
  const double um = wavelength_nm * 1e-3, square = um * um;
  constexpr double m2_from_1e_minus_28_cm2 = 1e-32;
  return m2_from_1e_minus_28_cm2 * (1.0455996 - 341.29061 / square - 0.90230850 * square) / (1 + 0.0027059889 / square - 85.968563 * square);
}

double air_depolarisation(double wavelength_nm) {
  const double um = wavelength_nm * 1e-3, inverse_square = 1 / (um * um);
  // Volumes in a hundred of dry air, with the King factor of each gas.
  constexpr double nitrogen = 78.084, oxygen = 20.946, argon = 0.934, carbon_dioxide = 0.036;
  const double king_nitrogen = 1.034 + 3.17e-4 * inverse_square;
  const double king_oxygen = 1.096 + 1.385e-3 * inverse_square + 1.448e-4 * inverse_square * inverse_square;
  constexpr double king_argon = 1, king_carbon_dioxide = 1.15;
  const double king = (nitrogen * king_nitrogen + oxygen * king_oxygen + argon * king_argon + carbon_dioxide * king_carbon_dioxide) /
                      (nitrogen + oxygen + argon + carbon_dioxide);
  return 6 * (king - 1) / (3 + 7 * king);
}

double ozone_absorption_cross_section_m2(double wavelength_nm) {
  static const Curve curve = [] {
    const Columns table = read_columns(data::ozone_cross_section(), "ozone_cross_section.csv");
    return Curve(table.named("wavelength_nm"), table.named("cross_section_m2"), "ozone_cross_section.csv");
  }();
  return curve(wavelength_nm);
}

}  // namespace arcus::phase
