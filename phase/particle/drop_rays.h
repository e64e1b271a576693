#pragma once
// Light rays through a transparent sphere: where each order leaves and how strong it is. Order 0 is
// reflected outside, order p crosses the sphere p times, so 2 makes the primary bow and 3 the
// secondary. H. C. van de Hulst, Light Scattering by Small Particles (1957), chapter 12.

#include <complex>
#include <optional>
#include <span>
#include <vector>

#include "phase/particle/scattering.h"

namespace arcus::phase {

/// Rays of one order at one real index n > 1. A ray is named by its angle of incidence, 0 (through
/// the centre) ... pi/2 (grazing); its distance from the axis is b = sin(incidence) radii.
class RaysOfOrder {
 public:
  RaysOfOrder(int order, double n);
  int order() const { return order_; }

  /// How far a ray is turned, counted through several revolutions [rad]: (p - 1) pi + 2 incidence -
  /// 2 p refraction.
  double turned_rad(double incidence_rad) const;
  double turned_slope(double incidence_rad) const;  ///< its derivative by the angle of incidence
  double turned_curvature(double incidence_rad) const;  ///< and the second
  double refraction_rad(double incidence_rad) const;

  /// Ray that is turned least (the bow), cos^2 = (n^2 - 1) / (p^2 - 1); none for p < 2 or n >= p.
  std::optional<double> bow_incidence_rad() const { return bow_; }
  /// The incidence between `low` and `high`, a range in which turned_rad is monotonic, of the ray
  /// turned by this much; none where no ray of the range is.
  std::optional<double> incidence_of(double turned_rad, double low_rad, double high_rad) const;

  /// Amplitude of the ray relative to the incoming one, without its spreading, phase and
  /// absorption.
  struct Amplitudes {
    double perpendicular, parallel;
  };
  Amplitudes amplitudes(double incidence_rad) const;

 private:
  int order_;
  double n_;
  std::optional<double> bow_;
};

/// Pure geometric optics of a sphere: rays up to an order, Fresnel's coefficients, no diffraction,
/// no interference. Averages over cells of the scattering angle, because the density at one angle
/// is infinite at a bow.
struct GeometricSphere {
  /// extinction 1 (what a ray hits); scattering is what leaves within the orders counted, so
  /// absorption and the orders left out are missing from it. backscatter: from the last cell.
  SphereEfficiencies efficiencies;
  /// Differential cross-section over pi r^2 [1/sr], mean over each cell: the integral of s11 over
  /// the sphere is the scattering efficiency. s12, s33 as in Bohren & Huffman; s34 is zero: rays of
  /// real index keep the phase.
  std::vector<double> s11, s12, s33;
  std::vector<double> order_share;  ///< scattered power of each order over the incoming
};

/// cell_edges_rad: ascending within 0 ... pi, at least two. relative_index as in mie_sphere with n
/// > 1 and weak absorption, which needs the size parameter; without absorption the result doesn't
/// depend on it.
GeometricSphere geometric_sphere(double size_parameter, std::complex<double> relative_index,
                                 std::span<const double> cell_edges_rad, int highest_order = 5);

}  // namespace arcus::phase
