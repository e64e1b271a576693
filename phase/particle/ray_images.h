#pragma once
// The rays that reach each scattering angle, with everything about them that doesn't depend on the
// size of the sphere. Near a bow two rays of one order merge; there the pair is described by the
// uniform approximation of C. Chester, B. Friedman and F. Ursell, Proc. Camb. Phil. Soc. 53, 599
// (1957), which V. Khare and H. M. Nussenzveig, Phys. Rev. Lett. 33, 976 (1974), applied to the
// rainbow: Airy's functions with the exact phases and amplitudes of both rays, complex rays on the
// dark side.

#include <complex>
#include <span>
#include <vector>

#include "phase/particle/drop_rays.h"

namespace arcus::phase {

/// One or two rays of one order towards one angle from one side. Amplitudes are those of Bohren &
/// Huffman's S1 (index 0) and S2 (1).
struct RayImage {
  int order = 0;
  int side = 1;  ///< +1: the part of the field with exp(+i l theta), -1: with exp(-i l theta)
  bool has_inner = false, has_outer = false;  ///< the bow's ray nearer to the axis; the one
                                              ///< farther, or of an order without bow

  /// A ray on its own: S = x amplitude phase exp(i x rate), times the share of the rays in its
  /// neighbourhood, whose slope and curvature by incidence enter as  share + i zone / x (slope
  /// amplitude_slope / amplitude + curvature).
  struct Ray {
    double incidence_rad = 0, cos_refraction = 1;
    double rate = 0;  ///< phase over x
    double amplitude[2] = {0, 0}, amplitude_slope[2] = {0, 0};
    double zone = 0;
    double ring = 0;  ///< distance from the axis in radii times the angle from the axis; 0 for rays
                      ///< that go through the axis
    std::complex<double> phase;
  };
  Ray inner, outer;

  /// Both rays near their bow: with z = x^(2/3) zeta,
  ///   S = phase exp(i x rate) (x^(7/6) g0 Ai(z) - i x^(5/6) g1 Ai'(z)).
  struct Pair {
    double zeta = 0, rate = 0;
    double g0[2] = {0, 0}, g1[2] = {0, 0};
    std::complex<double> phase;
  };
  bool is_pair() const { return has_inner && has_outer; }
  Pair pair;
};

/// Images of all orders at all angles.
struct RayImages {
  std::vector<RayImage> images;
  std::size_t angles = 0;
  std::vector<std::size_t> first;  ///< [order][angle]: where its images begin; they end where those
                                   ///< of the next angle or order begin
  std::span<const RayImage> at(int order, std::size_t angle) const {
    const std::size_t i = static_cast<std::size_t>(order) * angles + angle;
    return std::span(images).subspan(first[i], first[i + 1] - first[i]);
  }
};

/// angles_rad: 0 ... pi. least_size_parameter: the smallest sphere the images are for; it decides
/// how far the dark sides of the bows go. Images weaker than 1e-7 of x^2 are left out. Cost: about
/// a millisecond for each 1000 angles and order.
RayImages ray_images(double n, int highest_order, double least_size_parameter,
                     std::span<const double> angles_rad);

}  // namespace arcus::phase
