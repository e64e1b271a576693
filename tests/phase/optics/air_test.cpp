#include "phase/optics/air.h"

#include <gtest/gtest.h>

#include <cmath>

#include "phase/base/units.h"

namespace arcus::phase {
namespace {

/// (n - 1) of dry air at 15 °C and 1013.25 hPa: E. R. Peck and K. Reeder, Journal of the Optical Society of America 62, 958, 1972, with the
/// constants of Bodhaine et al. 1999, equation 18.
double refractivity(double nm) {
  const double s = 1e6 / (nm * nm);
  return 1e-8 * (8060.51 + 2480990 / (132.274 - s) + 17455.7 / (39.32957 - s));
}

// Rayleigh's law, with the King factor that belongs to the depolarisation.
TEST(Air, ScattersAsItsIndexOfRefractionSays) {
  for (const double nm : {380.0, 450.0, 550.0, 650.0, 780.0}) {
    const double n = 1 + refractivity(nm), m = nm * 1e-9, lorenz = (n * n - 1) / (n * n + 2);
    const double depolarisation = air_depolarisation(nm), king = (6 + 3 * depolarisation) / (6 - 7 * depolarisation);
    const double expected = 24 * std::pow(pi, 3) * lorenz * lorenz * king / (std::pow(m, 4) * std::pow(air_molecules_per_m3_at_sea_level, 2));
    EXPECT_NEAR(air_scattering_cross_section_m2(nm) / expected, 1, 1e-3) << nm;
  }
}

// A. T. Young, "Revised depolarization corrections for atmospheric extinction", Applied Optics 19, 3427, 1980: 0.0279 over the visible range.
TEST(Air, DepolarisesNearlyThreePercent) {
  EXPECT_NEAR(air_depolarisation(550), 0.0279, 6e-4);
  EXPECT_GT(air_depolarisation(400), air_depolarisation(700));
}

TEST(Air, OzoneAbsorbsInTheChappuisBand) {
  EXPECT_NEAR(ozone_absorption_cross_section_m2(605), 5.019e-25, 1e-28);
  EXPECT_GT(ozone_absorption_cross_section_m2(600), 20 * ozone_absorption_cross_section_m2(440));
  // 300 Dobson units: some 4 % of light at 600 nm, straight down.
  EXPECT_NEAR(ozone_absorption_cross_section_m2(600) * 300 * molecules_per_m2_in_dobson_unit, 0.039, 0.002);
}

}  // namespace
}  // namespace arcus::phase
