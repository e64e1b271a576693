#include "phase/particle/drop_rays.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "phase/base/quadrature.h"
#include "phase/base/units.h"

namespace arcus::phase {

RaysOfOrder::RaysOfOrder(int order, double n) : order_(order), n_(n) {
  assert(order >= 0 && n > 1);
  if (order >= 2 && n < order) bow_ = std::acos(std::sqrt((n * n - 1) / (order * order - 1.0)));
}

double RaysOfOrder::refraction_rad(double incidence_rad) const {
  return std::asin(std::sin(incidence_rad) / n_);
}

double RaysOfOrder::turned_rad(double incidence_rad) const {
  return (order_ - 1) * pi + 2 * incidence_rad - 2 * order_ * refraction_rad(incidence_rad);
}

double RaysOfOrder::turned_slope(double incidence_rad) const {
  return 2 - 2 * order_ * std::cos(incidence_rad) / (n_ * std::cos(refraction_rad(incidence_rad)));
}

double RaysOfOrder::turned_curvature(double incidence_rad) const {
  // With refraction beta(tau): beta' = cos tau / (n cos beta).
  const double beta = refraction_rad(incidence_rad), sine = std::sin(incidence_rad),
               cosine = std::cos(beta);
  const double slope = std::cos(incidence_rad) / (n_ * cosine);
  return -2 * order_ *
         (-sine / (n_ * cosine) +
          std::cos(incidence_rad) * std::sin(beta) * slope / (n_ * cosine * cosine));
}

std::optional<double> RaysOfOrder::incidence_of(double turned, double low, double high) const {
  const double at_low = turned_rad(low), at_high = turned_rad(high);
  const double sign = at_high > at_low ? 1 : -1;
  if ((turned - at_low) * sign < 0 || (turned - at_high) * sign > 0) return std::nullopt;
  // Newton's method inside a shrinking bracket: it also converges at a bow, where the slope
  // vanishes.
  double incidence =
      low + (high - low) * (at_high == at_low ? 0.5 : (turned - at_low) / (at_high - at_low));
  for (int i = 0; i < 100; ++i) {
    const double miss = (turned_rad(incidence) - turned) * sign;
    (miss < 0 ? low : high) = incidence;
    double next = incidence - miss / (sign * turned_slope(incidence));
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::fabs(next - incidence) < 1e-15 || miss == 0) break;
    incidence = next;
  }
  return incidence;
}

RaysOfOrder::Amplitudes RaysOfOrder::amplitudes(double incidence_rad) const {
  const double c = std::cos(incidence_rad), t = std::cos(refraction_rad(incidence_rad));
  double perpendicular = (c - n_ * t) / (c + n_ * t), parallel = (n_ * c - t) / (n_ * c + t);
  if (order_ == 0) return {perpendicular, parallel};
  // In and out pass 1 - r^2 (Stokes), each reflection inside is -r.
  return {(1 - perpendicular * perpendicular) * std::pow(-perpendicular, order_ - 1),
          (1 - parallel * parallel) * std::pow(-parallel, order_ - 1)};
}

namespace {

/// Cuts one monotonic branch of an order at the edges of the cells and adds the power of each piece
/// to its cell.
class BranchBinner {
 public:
  BranchBinner(const RaysOfOrder& rays, double dimming_per_crossing, std::span<const double> edges,
               GeometricSphere& sphere)
      : rays_(rays), dimming_(dimming_per_crossing), edges_(edges), sphere_(sphere) {}

  void add(double low, double high) {
    std::vector<double> cuts{low, high};
    const double first = std::min(rays_.turned_rad(low), rays_.turned_rad(high));
    const double last = std::max(rays_.turned_rad(low), rays_.turned_rad(high));
    for (const double edge : edges_)
      for (const double side : {edge, -edge})
        for (double turned = side + 2 * pi * std::ceil((first - side) / (2 * pi)); turned < last;
             turned += 2 * pi)
          if (const auto cut = rays_.incidence_of(turned, low, high)) cuts.push_back(*cut);
    // Where the angle folds back at 0 and pi the cell changes too; the edges need not contain them.
    for (double turned = pi * std::ceil(first / pi); turned < last; turned += pi)
      if (const auto cut = rays_.incidence_of(turned, low, high)) cuts.push_back(*cut);
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) add_piece(cuts[i], cuts[i + 1]);
  }

 private:
  void add_piece(double low, double high) {
    if (high <= low) return;
    static const Quadrature rule = gauss_legendre(6);
    const double angle = std::acos(std::cos(rays_.turned_rad(0.5 * (low + high))));
    const auto above = std::upper_bound(edges_.begin(), edges_.end(), angle);
    const bool counted = above != edges_.begin() && above != edges_.end();
    const auto cell = static_cast<std::size_t>(above - edges_.begin()) - 1;
    // Pieces that span more than a few degrees (wide cells) are integrated in parts.
    const int parts = 1 + static_cast<int>((high - low) / 0.05);
    for (int part = 0; part < parts; ++part)
      for (std::size_t q = 0; q < rule.nodes.size(); ++q) {
        const double width = (high - low) / parts;
        const double incidence = low + width * (part + 0.5 + 0.5 * rule.nodes[q]);
        const auto a = rays_.amplitudes(incidence);
        const double left =
            std::exp(-2 * rays_.order() * dimming_ * std::cos(rays_.refraction_rad(incidence)));
        const double power = std::sin(2 * incidence) * 0.5 * width * rule.weights[q] * left;
        const double s1 = a.perpendicular * a.perpendicular, s2 = a.parallel * a.parallel;
        const double total = 0.5 * power * (s1 + s2);
        sphere_.order_share[static_cast<std::size_t>(rays_.order())] += total;
        sphere_.efficiencies.asymmetry += total * std::cos(rays_.turned_rad(incidence));
        if (!counted) continue;
        sphere_.s11[cell] += total;
        sphere_.s12[cell] += 0.5 * power * (s2 - s1);
        sphere_.s33[cell] += power * a.parallel * a.perpendicular;
      }
  }

  const RaysOfOrder& rays_;
  double dimming_;
  std::span<const double> edges_;
  GeometricSphere& sphere_;
};

}  // namespace

GeometricSphere geometric_sphere(double size_parameter, std::complex<double> relative_index,
                                 std::span<const double> cell_edges_rad, int highest_order) {
  assert(cell_edges_rad.size() >= 2 && highest_order >= 0);
  GeometricSphere sphere;
  const std::size_t cells = cell_edges_rad.size() - 1;
  sphere.s11.assign(cells, 0);
  sphere.s12.assign(cells, 0);
  sphere.s33.assign(cells, 0);
  sphere.order_share.assign(static_cast<std::size_t>(highest_order) + 1, 0);
  for (int p = 0; p <= highest_order; ++p) {
    const RaysOfOrder rays(p, relative_index.real());
    // Half of the absorption of power along a diameter, 4 pi k 2r / wavelength.
    BranchBinner binner(rays, 2 * size_parameter * relative_index.imag(), cell_edges_rad, sphere);
    const double bow = rays.bow_incidence_rad().value_or(0);
    if (bow > 0) binner.add(0, bow);
    binner.add(bow, 0.5 * pi);
  }
  double scattered = 0;
  for (const double share : sphere.order_share) scattered += share;
  for (std::size_t i = 0; i < cells; ++i) {
    const double solid_angle = 4 * pi *
                               std::sin(0.5 * (cell_edges_rad[i + 1] - cell_edges_rad[i])) *
                               std::sin(0.5 * (cell_edges_rad[i + 1] + cell_edges_rad[i]));
    sphere.s11[i] /= solid_angle;
    sphere.s12[i] /= solid_angle;
    sphere.s33[i] /= solid_angle;
  }
  sphere.efficiencies.extinction = 1;
  sphere.efficiencies.scattering = scattered;
  sphere.efficiencies.asymmetry /= scattered;
  sphere.efficiencies.backscatter = 4 * pi * sphere.s11.back();
  return sphere;
}

}  // namespace arcus::phase
