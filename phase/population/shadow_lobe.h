#pragma once
// What diffraction by randomly oriented crystals does to light: the mean of the Airy patterns of their shadows
// (silhouette_diffraction.h). It is the lobe of the light that passes beside them, and it blurs what rays leave them.

#include <vector>

#include "phase/crystal/crystal_population.h"
#include "phase/crystal/silhouette_diffraction.h"
#include "phase/population/hat_nodes.h"

namespace arcus::phase {

/// Areas that stand for the shadows of all crystals [um2], each for an equal share of the light that meets them. scales: factors of
/// length, each for an equal share of the light.
std::vector<double> shadows_of(const CrystalPopulation& crystals, const std::vector<double>& scales);

class ShadowLobe {
 public:
  ShadowLobe(const std::vector<double>& shadow_um2, double wavelength_nm);

  /// Share of the light within an angle, by sin² of its half.
  double share_within(double sin2_half) const;

  /// Light of power 1 so distributed, at the nodes.
  std::vector<double> at_nodes(const HatNodes& nodes) const;

  /// Values per sr at the nodes, each direction's light spread as the lobe: means over circles that stand for equal shares of it.
  std::vector<double> blurred(const HatNodes& nodes, const std::vector<double>& values) const;

 private:
  std::vector<SilhouetteDiffraction> patterns_;
};

}  // namespace arcus::phase
