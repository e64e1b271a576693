#pragma once
// Scattering by a sphere so large that the Lorenz-Mie series costs too much. The Mie series is
// expanded by the number of times that light crosses the sphere (Debye's orders); of each order,
// partial waves near the edge are summed and the rest is geometric rays, near a bow by the uniform
// Airy approximation. Both know their phases, so they join within an order; different orders are
// added as intensities, because their interference averages out over any real distribution of
// sizes. Method, sources and errors: docs/large_drops.md.

#include <complex>
#include <memory>
#include <span>
#include <vector>

#include "phase/particle/edge_waves.h"
#include "phase/particle/near_axis.h"
#include "phase/particle/order_field.h"
#include "phase/particle/ray_images.h"
#include "phase/particle/scattering.h"
#include "phase/particle/weak_rays.h"

namespace arcus::phase {

/// Products of the amplitudes at the angles asked for, in their order: what a population averages.
/// Bohren & Huffman's conventions.
struct SphereIntensities {
  SphereEfficiencies efficiencies;
  std::vector<double> i11;  ///< (|S1|^2 + |S2|^2) / 2; its integral over the sphere is pi x^2 times
                            ///< the scattering efficiency
  std::vector<double> i12;  ///< (|S2|^2 - |S1|^2) / 2
  std::vector<double> i33;  ///< Re S2 S1*
  std::vector<double> i34;  ///< Im S2 S1*
};

/// A range of Debye's orders: how often the light crosses the sphere; 0 is diffraction and
/// reflection. Those from 4 on come together.
struct DebyeOrders {
  int first = 0, last = 1000;
};

/// Spheres of one refractive index and any size. Keeps working memory: one object for each thread;
/// a copy costs little against making one.
class LargeDrop {
 public:
  static constexpr double least_size_parameter = 500, largest_size_parameter = 2e5;

  /// relative_index: n + ik, n in 1.2 ... 1.7, 0 <= k <= 1e-3. angles_rad: 0 ... pi, any order.
  /// Throws bad_input otherwise.
  LargeDrop(std::complex<double> relative_index, std::span<const double> angles_rad);

  /// Size parameter between the limits above; throws bad_input otherwise.
  /// relative_step: distance to the next size in use over the size. Fringes between rays of one
  /// order that such a grid of sizes does not resolve are averaged with its hat function; 0: none
  /// are. orders: the light of these orders alone; the efficiencies are always those of all.
  SphereIntensities scatter(double size_parameter, double relative_step, DebyeOrders orders = {});

 private:
  /// What an angle is, and what it is for the present size.
  struct Direction {
    double angle_rad, from_axis_rad, sine, plain;  // plain: 1 / sqrt(2 pi sine)
    bool back;
    double u;  // x from_axis
    AxisFactors factors;
    AxisPowers powers;
  };
  void set_directions(double relative_step);
  double least_edge(int order, std::size_t angle) const;
  bool has_edge(int order, std::size_t angle) const;
  void add_edge(int order, std::size_t angle, OrderField& field) const;
  void add_edge_at_axis(int order, const Direction& direction, OrderField& field) const;
  void add_disc(const Direction& direction, OrderField& field) const;
  void set_turns(int order, const Direction& direction, OrderField& field) const;
  void add_strong_order(double relative_step, int order,
                        std::vector<AmplitudeProducts>& sums) const;
  void add_weak_orders(double relative_step, std::vector<AmplitudeProducts>& sums) const;

  std::complex<double> m_;
  RaySphere sphere_{};
  std::vector<Direction> directions_;  // one more than asked for: straight back
  std::vector<RaysOfOrder> rays_;      // [order]
  std::vector<EdgeWindow> windows_;    // [order], for the present size
  std::shared_ptr<const RayImages>
      images_;  // copies of the object share what does not depend on the size
  std::shared_ptr<const WeakRays> weak_rays_;
  EdgeWaves edge_;
};

}  // namespace arcus::phase
