#include "phase/particle/large_drop.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "phase/base/error.h"
#include "phase/base/units.h"
#include "phase/particle/debye_efficiencies.h"
#include "phase/particle/ray_waves.h"
#include "phase/settings/number_text.h"

namespace arcus::phase {
namespace {

using Complex = std::complex<double>;

// Orders whose edge is summed; later ones are added as random waves.
constexpr int edge_orders = 24;
// Rays of later orders below the edge carry less than 1e-5 of the light anywhere.
constexpr int highest_ray_order = 8;

}  // namespace

LargeDrop::LargeDrop(Complex m, std::span<const double> angles_rad)
    : m_(m), edge_(std::span<const double>{}) {
  if (!(m.real() >= 1.2 && m.real() <= 1.7))
    throw bad_input("large drop", "n = " + number_text(m.real()), "must be between 1.2 and 1.7");
  if (!(m.imag() >= 0 && m.imag() <= 1e-3))
    throw bad_input("large drop", "k = " + number_text(m.imag()), "must be between 0 and 0.001",
                    "Rays are for weak absorption; use the wave solution");
  std::vector<double> angles(angles_rad.begin(), angles_rad.end());
  for (const double angle : angles)
    if (!(angle >= 0 && angle <= pi))
      throw bad_input("large drop", "scattering angle " + number_text(angle) + " rad",
                      "must be between 0 and pi");
  angles.push_back(pi);
  for (const double angle : angles) {
    Direction d{};
    d.angle_rad = angle;
    d.back = angle > 0.5 * pi;
    d.from_axis_rad = d.back ? pi - angle : angle;
    d.sine = std::max(std::sin(d.from_axis_rad), 1e-7);
    d.plain = 1 / std::sqrt(2 * pi * d.sine);
    directions_.push_back(d);
  }
  for (int p = 0; p <= edge_orders; ++p) rays_.emplace_back(p, m.real());
  windows_.resize(rays_.size());
  images_ = std::make_shared<const RayImages>(
      ray_images(m.real(), highest_ray_order, least_size_parameter, angles));
  weak_rays_ = std::make_shared<const WeakRays>(*images_, first_weak_order, highest_ray_order);
  edge_ = EdgeWaves(angles);
}

void LargeDrop::set_directions(double relative_step) {
  const double x = sphere_.size_parameter;
  for (Direction& d : directions_) {
    d.u = x * d.from_axis_rad;
    d.factors = d.u < at_axis ? AxisFactors{} : axis_factors(d.u);
    d.powers = axis_powers(d.u, x * d.sine, d.back, relative_step);
  }
}

/// The |F|^2 below which edge waves do not show: without rays of this order to interfere with, 1e-6
/// of x^2; with them, amplitudes count.
double LargeDrop::least_edge(int order, std::size_t angle) const {
  const bool joins = !images_->at(order, angle).empty();
  const double x = sphere_.size_parameter, plain = directions_[angle].plain;
  return (joins ? 1e-9 : 1e-6) * x * x / (plain * plain);
}

bool LargeDrop::has_edge(int order, std::size_t angle) const {
  const double least = least_edge(order, angle);
  for (const int side : {1, -1})
    for (const auto branch : {EdgeWaves::inner, EdgeWaves::outer})
      if (edge_.bound(order, branch, angle, side) >= least) return true;
  return false;
}

void LargeDrop::add_edge(int order, std::size_t angle, OrderField& field) const {
  const Direction& direction = directions_[angle];
  const double least = order < first_weak_order ? least_edge(order, angle) : 0;
  for (const int side : {1, -1})
    for (const auto branch : {EdgeWaves::inner, EdgeWaves::outer}) {
      if (!edge_.has(order, branch) ||
          (least > 0 && edge_.bound(order, branch, angle, side) < least))
        continue;
      field.apply_phases();
      const ComplexPair value = edge_.value(order, branch, angle, side);
      const Complex front =
          direction.plain * Complex(std::sqrt(0.5), side > 0 ? -std::sqrt(0.5) : std::sqrt(0.5));
      Complex s1 = first_of(value) * front, s2 = second_of(value) * front;
      if (direction.u < far_from_axis) apply_axis(direction.factors, side, direction.back, s1, s2);
      OrderField::Wave& wave = field.slot(side, branch);
      wave.s1 += s1;
      wave.s2 += s2;
      wave.used = wave.phased = true;
    }
}

void LargeDrop::add_edge_at_axis(int order, const Direction& d, OrderField& field) const {
  const EdgeWaves::Moments& moments = edge_.moments(order, d.back);
  const AxisExpansion e = axis_expansion(d.u);
  const ComplexPair own = moments.zeroth * e.own + moments.first * e.own_first;
  const ComplexPair mixed =
      (moments.zeroth * e.mixed + moments.first * e.mixed_first) * (d.back ? -1.0 : 1.0);
  field.apply_phases();
  OrderField::Wave& wave = field.extra();
  wave.s1 = first_of(own) + second_of(mixed);
  wave.s2 = second_of(own) + first_of(mixed);
  wave.turn = field.slot(d.back ? -1 : 1, EdgeWaves::outer).turn;
  wave.used = wave.phased = true;
}

/// Fraunhofer diffraction by a disc, with the edge as soft as the edge waves leave it.
void LargeDrop::add_disc(const Direction& d, OrderField& field) const {
  const double x = sphere_.size_parameter;
  const double spread = edge_.disc_softness() * d.angle_rad;
  if (d.back || spread > 6) return;
  const double stretch = d.u > 1e-8 ? std::sqrt(d.angle_rad / std::sin(d.angle_rad)) : 1;
  const double soft = std::exp(-0.5 * spread * spread) * stretch;
  const double softness2 = edge_.disc_softness() * edge_.disc_softness();
  if (d.u < at_axis) {
    OrderField::Wave& wave = field.extra();
    wave.s1 = wave.s2 = soft * (x * x * j1_over(d.u) + 0.5 * softness2 * j0_of(d.u));
    wave.turn = field.slot(1, EdgeWaves::outer).turn;
    wave.used = wave.phased = true;
    return;
  }
  const HankelValues h = hankel(d.u);
  const Complex half = 0.5 * soft * (x / d.angle_rad * h.first + 0.5 * softness2 * h.zeroth);
  for (const int side : {1, -1}) {
    OrderField::Wave& wave = field.slot(side, EdgeWaves::outer);
    wave.s1 += side > 0 ? half : std::conj(half);
    wave.s2 += side > 0 ? half : std::conj(half);
    wave.used = wave.phased = true;
  }
}

/// Edge waves continue the rays of their side and branch; where there are none, the grazing ray.
void LargeDrop::set_turns(int order, const Direction& direction, OrderField& field) const {
  const double n = m_.real(), refraction = std::asin(1 / n);
  const double grazing_turned = (order - 1) * pi + pi - 2 * order * refraction;
  const double grazing_rate = 2 * order * (std::sqrt(n * n - 1) - (0.5 * pi - refraction));
  for (const int side : {1, -1})
    for (const auto branch : {EdgeWaves::inner, EdgeWaves::outer}) {
      OrderField::Wave& wave = field.slot(side, branch);
      if (wave.known) continue;
      const double turned = side * direction.angle_rad;
      wave.turn =
          sphere_.size_parameter *
          (grazing_rate + turned + 2 * pi * std::nearbyint((grazing_turned - turned) / (2 * pi)));
    }
}

void LargeDrop::add_strong_order(double relative_step, int p,
                                 std::vector<AmplitudeProducts>& sums) const {
  OrderField field;
  for (std::size_t a = 0; a < directions_.size(); ++a) {
    const Direction& direction = directions_[a];
    const bool at_the_axis = direction.u < at_axis;
    const bool edge = at_the_axis || p == 0 || has_edge(p, a);
    if (!edge && images_->at(p, a).empty()) continue;
    field.clear();
    add_rays(images_->at(p, a), sphere_, windows_[static_cast<std::size_t>(p)], direction.back,
             field);
    if (edge) {
      set_turns(p, direction, field);
      if (at_the_axis)
        add_edge_at_axis(p, direction, field);
      else
        add_edge(p, a, field);
      if (p == 0) add_disc(direction, field);
    }
    field.add_to(sums[a], relative_step);
  }
}

void LargeDrop::add_weak_orders(double relative_step, std::vector<AmplitudeProducts>& sums) const {
  // Light that has gone round so often that the phases of its partial waves are random: sum over
  // the orders beyond the last and over the partial waves of (l + 1/2) |c_l|^2.
  double perpendicular = 0, parallel = 0;
  const PartialWaves& waves = edge_.partial_waves();
  const auto beyond = [](const SurfaceTerms& t) {
    const double inside = std::norm(t.reflected_inside);
    return std::norm(t.passed_through) * std::pow(inside, edge_orders) / (1 - inside);
  };
  for (std::size_t i = 0; i < waves.perpendicular.size(); ++i) {
    const double wave = waves.first + static_cast<double>(i) + 0.5;
    perpendicular += wave * beyond(waves.perpendicular[i]);
    parallel += wave * beyond(waves.parallel[i]);
  }
  OrderField field;
  for (std::size_t a = 0; a < directions_.size(); ++a) {
    const Direction& d = directions_[a];
    AmplitudeProducts random{perpendicular / (pi * d.sine), parallel / (pi * d.sine), 0};
    weak_rays_->add_to(random, *images_, a, windows_, sphere_);
    // Straight back the polarisations of the edge waves interfere: there amplitudes are added after
    // all.
    const bool glory = d.back && d.u < far_from_axis;
    for (const int side : {1, -1}) {
      if (glory) continue;
      const EdgeWaves::Power power = edge_.power(a, side);
      random.add({power.perpendicular, power.parallel, power.mixed}, d.plain * d.plain);
    }
    AmplitudeProducts sum{
        random.i1 * d.powers.own + random.i2 * d.powers.mixed,
        random.i2 * d.powers.own + random.i1 * d.powers.mixed,
        random.i3 * (d.powers.own + d.powers.mixed) + (random.i1 + random.i2) * d.powers.both};
    for (int p = first_weak_order; glory && p <= edge_orders; ++p) {
      field.clear();
      set_turns(p, d, field);
      if (d.u > at_axis)
        add_edge(p, a, field);
      else
        add_edge_at_axis(p, d, field);
      field.add_to(sum, relative_step);
    }
    sums[a].add(sum, 1);
  }
}

SphereIntensities LargeDrop::scatter(double x, double relative_step, DebyeOrders orders) {
  if (!(x >= least_size_parameter && x <= largest_size_parameter))
    throw bad_input("large drop", "size parameter " + number_text(x),
                    "must be between " + number_text(least_size_parameter) + " and " +
                        number_text(largest_size_parameter));
  assert(relative_step >= 0);
  for (std::size_t p = 0; p < rays_.size(); ++p) windows_[p] = edge_window(rays_[p], m_.real(), x);
  edge_.sum(x, m_, windows_, rays_);
  sphere_ = {x, std::cbrt(x), m_.imag()};
  set_directions(relative_step);
  std::vector<AmplitudeProducts> sums(directions_.size());
  for (int p = orders.first; p <= std::min(orders.last, first_weak_order - 1); ++p)
    add_strong_order(relative_step, p, sums);
  if (orders.last >= first_weak_order) add_weak_orders(relative_step, sums);

  SphereIntensities result;
  const ComplexPair forward = edge_.moments(0, false).zeroth;
  const double disc = 0.5 * (x * x + edge_.disc_softness() * edge_.disc_softness());
  result.efficiencies =
      debye_efficiencies(x, m_, disc + 0.5 * (forward[0] + forward[2]), edge_.partial_waves());
  result.efficiencies.backscatter = 4 * sums.back().i1 / (x * x);
  sums.pop_back();
  for (const AmplitudeProducts& sum : sums) {
    result.i11.push_back(0.5 * (sum.i1 + sum.i2));
    result.i12.push_back(0.5 * (sum.i2 - sum.i1));
    result.i33.push_back(sum.i3.real());
    result.i34.push_back(sum.i3.imag());
  }
  return result;
}

}  // namespace arcus::phase
