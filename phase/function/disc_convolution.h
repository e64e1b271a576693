#pragma once
// Phase functions averaged over the sun's limb-darkened disc: what a direction receives from the whole disc, where
// the phase function alone tells what it receives from the disc's centre.

#include <array>
#include <span>
#include <vector>

#include "phase/function/wavelength_grid.h"
#include "phase/optics/sun_disc.h"

namespace arcus::phase {

/// A linear map of the values at angle nodes: exact, up to a quadrature error of about 1e-5, for
/// functions that are linear in s = sin²(θ/2) between the nodes. A constant stays what it is.
class DiscConvolution {
 public:
  /// Angles ascending from 0 to 180° [deg].
  DiscConvolution(const std::vector<double>& angle_deg, const DiscProfile& disc);

  /// values and the result: [row][angle][wavelength], wavelength fastest, at the nodes of the grid.
  void apply(std::span<const float> values, int rows, const WavelengthGrid& wavelengths,
             std::span<float> result) const;

 private:
  /// The mean at one node as a sum over its neighbours, one set of weights for each power of mu in
  /// the disc's radiance.
  struct Stencil {
    int first = 0;                              // angle node of the first weight
    std::vector<std::array<double, 6>> weight;  // [neighbour][power]
  };
  Stencil stencil_at(int node) const;

  DiscProfile disc_;
  std::vector<double> angle_rad_;
  std::vector<Stencil> stencils_;  // [angle]
};

}  // namespace arcus::phase
