#include "media/author/ice_crystals.h"

#include <cmath>

#include "phase/base/units.h"

namespace arcus::media {
namespace {

/// Dynamic viscosity of air [kg/(m s)] by Sutherland's law with the constants of ISO 2533:1975.
double air_viscosity(double temperature_k) { return 1.458e-6 * std::pow(temperature_k, 1.5) / (temperature_k + 110.4); }

}  // namespace

IceCrystals::IceCrystals(const phase::CrystalSettings& crystals) {
  const phase::CrystalPopulation population(crystals, 1);
  const std::string& lies = crystals.orientation.type;
  const auto count = static_cast<double>(population.shapes().size());
  for (const phase::CrystalShape& shape : population.shapes()) {
    volume_ += shape.volume() / count;
    mean_shadow_ += shape.mean_projected_area() / count;
    lower_side_ += (lies == "random"  ? shape.mean_projected_area()
                    : lies == "plate" ? shape.projected_area(Vec3(0, 0, 1))
                                      : shape.projected_area(Vec3(1, 0, 0))) / count;
  }
}

double IceCrystals::mass_kg(double size_um) const {
  return solid_ice_kg_per_m3 * volume_ * std::pow(m_from_um(size_um), 3);
}

double IceCrystals::extinction_per_m(double ice_g_per_m3, double size_um) const {
  return 2 * mean_shadow_ / (volume_ * m_from_um(size_um)) * 1e-3 * ice_g_per_m3 / solid_ice_kg_per_m3;
}

double IceCrystals::effective_radius_um(double size_um) const { return 0.75 * volume_ / mean_shadow_ * size_um; }

double IceCrystals::fall_speed_m_per_s(double size_um, double air_kg_per_m3, double temperature_c) const {
  constexpr double gravity = 9.80665, delta = 8, c = 0.35;  // the last two: fitted by Heymsfield and Westbrook
  const double viscosity = air_viscosity(temperature_c + 273.15);
  const double area_ratio = lower_side_ / (0.25 * pi);  // in the disc around it
  const double best = air_kg_per_m3 * 8 * mass_kg(size_um) * gravity / (viscosity * viscosity * pi * std::sqrt(area_ratio));
  const double root = std::sqrt(1 + 4 * std::sqrt(best) / (delta * delta * std::sqrt(c))) - 1;
  return 0.25 * delta * delta * root * root * viscosity / (air_kg_per_m3 * m_from_um(size_um));
}

}  // namespace arcus::media
