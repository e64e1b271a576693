#pragma once
// Sums of the partial waves near the edge of a large sphere, order by order of Debye's expansion:
// what diffracts around it, grazes it, creeps along its surface and makes the glory. The sums over
// partial waves are Fourier series in the scattering angle.

#include <array>
#include <complex>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "phase/particle/edge_window.h"
#include "phase/particle/pair_transform.h"
#include "phase/particle/partial_waves.h"

namespace arcus::phase {

/// F(phi) = sum over l of c_l share_l sqrt(l + 1/2) exp(i (l + 1/2) phi), c_l twice the Mie
/// coefficient of one order, for both polarisations (first: perpendicular, b_l). Away from the axis
/// the amplitudes are
///   S(theta) = (exp(-i pi/4) F(theta) + exp(i pi/4) F(-theta)) / sqrt(2 pi sin theta).
/// A bow inside of the window is cut in two at its own ray, so that its two rays can be told apart.
///
/// From order `first_weak_order` on, waves and rays are added as powers: share is then the root of
/// the window, and power() is what counts.
class EdgeWaves {
 public:
  /// The rays that hit nearer to the axis than the bow's, and those farther (all, for an order
  /// whose bow isn't cut).
  enum Branch { inner = 0, outer = 1 };

  /// Prepares for angles in 0 ... pi.
  explicit EdgeWaves(std::span<const double> angles_rad);

  /// Sums for a sphere; windows[p] and rays[p] are of order p. Replaces the sums of the sphere
  /// before.
  void sum(double size_parameter, std::complex<double> relative_index,
           std::span<const EdgeWindow> windows, std::span<const RaysOfOrder> rays);

  bool has(int order, Branch branch) const { return strip_of(order, branch).transform > 0; }
  /// Largest |F|^2, both polarisations together, in the neighbourhood of an angle of the list,
  /// times `side` (+1, -1). A cheap bound to skip by; 0 where the branch has no waves. Not for
  /// orders from first_weak_order on.
  double bound(int order, Branch branch, std::size_t angle, int side) const;
  /// F(side theta) at an angle of the list. The branch must have waves.
  ComplexPair value(int order, Branch branch, std::size_t angle, int side) const;

  /// Sum over the orders from first_weak_order on of |F|^2 at side times an angle of the list:
  /// both polarisations, and F_parallel F_perpendicular*.
  struct Power {
    double perpendicular = 0, parallel = 0;
    std::complex<double> mixed = 0;
  };
  Power power(std::size_t angle, int side) const;

  /// First moments over the partial waves of an order at phi = 0 (straight on) or pi (straight
  /// back): sum of c_l (l + 1/2) and of c_l (l + 1/2) (l + 1/2 - x) / x, with the sign (-1)^l for
  /// the way back.
  struct Moments {
    ComplexPair zeroth{}, first{};
  };
  const Moments& moments(int order, bool back) const {
    return (back ? backward_ : forward_)[static_cast<std::size_t>(order)];
  }

  /// Width, in partial waves, of the soft edge of the disc whose diffraction order 0 leaves to be
  /// added.
  double disc_softness() const { return softness_; }
  /// The surface terms within the widest window.
  const PartialWaves& partial_waves() const { return waves_; }

 private:
  static constexpr std::size_t blocks = 256;
  struct Strip {
    std::size_t transform = 0;      // log2 of its length; 0: no waves
    std::size_t carrier = 0;        // index in carriers_
    std::vector<ComplexPair> sums;  // [phase][point of the transform]: the circle has four points
                                    // for each of the transform
    std::array<double, blocks> bound{};
  };
  struct Stencil {  // six-point interpolation on the circle
    std::uint32_t first;
    std::array<double, 6> weight;
  };
  struct Carrier {
    int centre = 0;  // l of the middle of a band; the carrier is exp(i (centre + 1/2) theta)
    std::vector<std::complex<double>> value;
  };
  const Strip& strip_of(int order, Branch branch) const {
    return strips_[static_cast<std::size_t>(2 * order + branch)];
  }
  struct Tools {  // what transforms of one length need
    std::shared_ptr<const PairTransform> transform;
    std::vector<std::complex<double>> fine_roots;  // of the circle
  };
  const Tools& tools_for(std::size_t log2);
  std::array<std::size_t, 6> places(const Stencil& stencil, std::size_t log2, int side) const;
  void prepare_stencils(std::size_t log2);
  std::size_t carrier_for(int last, std::size_t log2);
  /// Transforms the terms of waves first ... first + terms.size() - 1.
  void transform(std::span<const ComplexPair> terms, int first, Strip& strip);
  void find_bounds(Strip& strip) const;

  void add_power(const Strip& strip);

  std::vector<double> angles_rad_;
  std::vector<std::uint16_t> block_;                      // [angle]
  std::vector<std::vector<std::complex<double>>> shift_;  // [log2 n][angle]: exp(-i n angle)
  double softness_ = 0;
  PartialWaves waves_;
  std::vector<Strip> strips_;  // [order][branch]
  std::vector<std::vector<ComplexPair>>
      powers_;  // [log2 of the transform's length], laid out as Strip::sums: the Power of a point
  std::vector<Moments> forward_, backward_;
  std::vector<Tools> tools_;                    // [log2 of the transform's length]
  std::vector<std::vector<Stencil>> stencils_;  // [log2 of the transform's length][angle]
  std::vector<Carrier> carriers_;
  std::size_t carriers_used_ = 0;
  std::vector<double> incidence_rad_;  // of the partial waves
  std::vector<ComplexPair> power_, terms_, part_, data_;
};

}  // namespace arcus::phase
