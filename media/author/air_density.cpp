#include "media/author/air_density.h"

#include <algorithm>
#include <cmath>

namespace arcus::media {
namespace {

constexpr double gas_constant = 287.05287;  // of dry air [J/(kg K)]
constexpr double gravity = 9.80665;         // [m/s²]
constexpr double lapse_k_per_m = 6.5e-3, tropopause_m = 11000;

}  // namespace

double air_density_kg_per_m3(double pressure_pa, double temperature_k) {
  return pressure_pa / (gas_constant * temperature_k);
}

double standard_air_density_kg_per_m3(double height_m) {
  const double below_m = std::min(height_m, tropopause_m), above_m = std::clamp(height_m - tropopause_m, 0.0, 9000.0);
  const double temperature_k = 288.15 - lapse_k_per_m * below_m;
  const double pressure_pa = 101325 * std::pow(temperature_k / 288.15, gravity / (gas_constant * lapse_k_per_m)) *
                             std::exp(-gravity * above_m / (gas_constant * temperature_k));
  return air_density_kg_per_m3(pressure_pa, temperature_k);
}

}  // namespace arcus::media
