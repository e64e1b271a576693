#pragma once
// The scattering of whole populations of spheres at one wavelength. Single spheres are computed in blocks, and each
// block is added to the sums of every size node while it is in the cache.

#include <complex>
#include <cstddef>
#include <memory>
#include <vector>

#include "phase/population/sizes.h"

namespace arcus::phase {

/// Elements of the scattering matrix, in this order: p11, p12, p33, p34.
inline constexpr std::size_t matrix_elements = 4;

/// Means over the populations of all size nodes at one wavelength.
struct PopulationMeans {
  std::vector<double> extinction_m2, scattering_m2;  ///< [size] mean cross-sections of a particle
  std::vector<double> asymmetry;                     ///< [size] mean cosine of the scattering angle
  /// [size][element][angle], angle fastest [1/sr]: mean differential cross-section over mean scattering cross-section.
  /// What has the integral 1 over the sphere is the function itself, not an interpolant.
  std::vector<double> matrix;
};

/// Wave optics of populations of spheres in air, at a list of scattering angles. Immutable; threads can share one.
class SphereAverage {
 public:
  /// sizes: one a size node. angle_deg: 0 ... 180, ascending. shortest_wavelength_nm: of those that will be asked for.
  /// radii: spheres at each wavelength where waves are summed, see radius_grids. may_use_rays: false where the material
  /// is not one that large drops can be computed for by rays (see LargeDrop): waves are then summed for all.
  /// Throws bad_input where drops are too large for that (size parameter above 10⁵).
  SphereAverage(std::vector<Sizes> sizes, std::vector<double> angle_deg, double shortest_wavelength_nm,
                long long radii, bool may_use_rays);
  ~SphereAverage();

  /// relative_index: n + ik, relative to air. Runs on all cores of the caller's arena; the result does not depend on
  /// their number.
  PopulationMeans means(double wavelength_nm, std::complex<double> relative_index) const;

  /// Whether large drops of this index can be computed by rays.
  static bool rays_serve(std::complex<double> relative_index);

 private:
  struct Parts;
  std::unique_ptr<const Parts> parts_;
};

}  // namespace arcus::phase
