#pragma once
// Crystals of one shape and any size: what they weigh, how much light they stop, and how fast they fall. All by their geometry.

#include "phase/crystal/crystal_population.h"

namespace arcus::media {

inline constexpr double solid_ice_kg_per_m3 = 917;

class IceCrystals {
 public:
  /// Throws bad_input as make_crystal does.
  explicit IceCrystals(const phase::CrystalSettings& crystals);

  /// Mass of one [kg]. Sizes are maximum dimensions, above 0.
  double mass_kg(double size_um) const;
  /// Extinction 2 N A [1/m] of N crystals that weigh as much: twice their shadow, since they diffract as much light as they meet. A is the mean
  /// shadow over all directions, a quarter of the surface (Cauchy), for oriented ones too. So it is 2 A IWC / (ρ V).
  double extinction_per_m(double ice_g_per_m3, double size_um) const;
  /// 3 V / (4 A), with which extinction is 3 IWC / (2 ρ r).
  double effective_radius_um(double size_um) const;
  /// In still air of that density and temperature, by A. J. Heymsfield and C. D. Westbrook, J. Atmos. Sci. 67, 2469 (2010): plates fall with
  /// their base, columns with their side, others with their mean shadow facing down.
  double fall_speed_m_per_s(double size_um, double air_kg_per_m3, double temperature_c) const;

 private:
  // Of crystals with the maximum dimension 1; means over the shapes.
  double volume_ = 0, mean_shadow_ = 0, lower_side_ = 0;
};

}  // namespace arcus::media
