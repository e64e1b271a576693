#include "phase/particle/edge_window.h"

#include <algorithm>
#include <cmath>

#include "phase/base/units.h"

namespace arcus::phase {
namespace {

constexpr double reach = 3;  // widths from the centre to where the window is 0 or 1 within 1e-5
/// Least width of the window in Fresnel zones of its rays: where it falls between bow and edge, and
/// below the bow. Orders of which powers are added need less care.
struct Zones {
  double above_bow, below_bow;
};
constexpr Zones strong_zones{3.5, 3}, weak_zones{1.7, 1.7};
constexpr double bow_reach = 6;  // Airy's variable beyond which the two rays of a bow stand apart

/// Half width in the angle of incidence of a ray's Fresnel zone: the phase x (..) has the second
/// derivative x cos(tau) D'(tau).
double fresnel_zone_rad(const RaysOfOrder& rays, double incidence_rad, double x) {
  return 1 / std::sqrt(x * std::cos(incidence_rad) * std::fabs(rays.turned_slope(incidence_rad)));
}

}  // namespace

double EdgeWindow::value_at(double incidence_rad) const {
  const double u = (incidence_rad - centre_rad) / width_rad;
  if (everything || u > reach + 1) return 1;
  return u < -reach - 1 ? 0 : 0.5 * std::erfc(-u);
}

EdgeWindow::Share EdgeWindow::at(double incidence_rad) const {
  if (everything) return {1, 0, 0};
  const double u = (incidence_rad - centre_rad) / width_rad;
  if (u > reach + 1) return {1, 0, 0};
  if (u < -reach - 1) return {0, 0, 0};
  const double slope = std::exp(-u * u) / (std::sqrt(pi) * width_rad);
  return {0.5 * std::erfc(-u), slope, -2 * u / width_rad * slope};
}

double EdgeWindow::begin_rad() const {
  return everything ? 0 : std::max(0.0, centre_rad - reach * width_rad);
}

namespace {

EdgeWindow placed_window(const RaysOfOrder& rays, double n, double x) {
  const Zones zones = rays.order() < first_weak_order ? strong_zones : weak_zones;
  EdgeWindow window;
  // Debye's expansions hold within 1 % of phase up to x cos^3 = 20, and the window should be 1
  // where they don't.
  const double last = std::acos(std::min(1.0, std::cbrt(20 / x)));
  double bow_outer = 0.2, bow_inner = 0.5 * pi;
  if (const auto bow = rays.bow_incidence_rad()) {
    // van de Hulst's h (1957, section 13.23): the curvature of the turn against the distance from
    // the axis.
    const double p2 = rays.order() * rays.order();
    const double h = (p2 - 1) * (p2 - 1) / p2 * std::sqrt((p2 - n * n) / std::pow(n * n - 1, 3));
    const double b = std::sin(*bow), away = std::sqrt(bow_reach) / std::cbrt(h * x);
    bow_outer = b + away < 1 ? std::asin(b + away) : pi;
    bow_inner = std::asin(std::max(0.1, b - away));
  }
  // First choice: the window between bow and edge.
  double centre = last;
  for (int i = 0; i < 20; ++i) {
    window.width_rad = zones.above_bow * fresnel_zone_rad(rays, std::min(centre, last), x);
    centre = last - reach * window.width_rad;
    if (centre < bow_outer) break;
  }
  window.centre_rad = centre;
  if (window.begin_rad() > bow_outer) return window;
  // Second: below the bow, which is then summed as partial waves with the edge.
  window.bow_inside = rays.bow_incidence_rad().has_value();
  if (!window.bow_inside) bow_inner = last;
  // Rays near the bow have wide zones: the width is for those at the upper flank of the window.
  const double most = (bow_inner - 0.15) / (2 * reach);
  double width = most;
  for (int i = 0; i < 20; ++i) {
    const double flank = bow_inner - 1.5 * width;
    width = std::min(most, zones.below_bow * fresnel_zone_rad(rays, flank, x));
  }
  window.everything =
      most < 0.7 * zones.below_bow * fresnel_zone_rad(rays, bow_inner - reach * most, x);
  window.width_rad = width;
  window.centre_rad = bow_inner - reach * width;
  return window;
}

}  // namespace

EdgeWindow edge_window(const RaysOfOrder& rays, double n, double x) {
  EdgeWindow window = placed_window(rays, n, x);
  const double end = window.centre_rad + reach * window.width_rad;
  window.whole_from_sine = window.everything ? 0 : end < 0.5 * pi ? std::sin(end) : 1;
  return window;
}

}  // namespace arcus::phase
