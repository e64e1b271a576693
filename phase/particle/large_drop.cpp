#include "phase/particle/large_drop.h"

#include <math.h>  // j0, j1, y0, y1 are POSIX, not C++

#include <algorithm>
#include <cassert>
#include <cmath>

#include "phase/base/error.h"
#include "phase/base/quadrature.h"
#include "phase/base/units.h"
#include "phase/particle/airy.h"
#include "phase/settings/number_text.h"

namespace arcus::phase {
namespace {

using Complex = std::complex<double>;

constexpr int edge_orders = 16;       // orders whose edge is summed; later ones are added as random waves
constexpr int highest_ray_order = 8;  // later rays below the edge carry less than 1e-5 of the light anywhere
constexpr double far_from_axis = 200;  // x times angle: there Bessel functions are plain waves within 1/400 of phase
constexpr double at_axis = 2;          // x times angle: here both sides of a ring are one

/// H1'(u) and H1(u)/u against sqrt(2 / (pi u)) exp(i (u - pi/4)): what becomes of a wave with exp(+i l theta) near the axis, in its own
/// polarisation and mixed into the other. At the axis each side gets half of both, J1 instead of H1.
struct AxisFactors {
  Complex own{1, 0}, mixed{0, 0};
};
AxisFactors axis_factors(double u) {
  if (u > far_from_axis) return {};
  const Complex plain = std::sqrt(2 / (pi * u)) * std::polar(1.0, u - pi / 4);
  if (u < at_axis) return {(::j0(u) - ::j1(u) / u) / plain, ::j1(u) / u / plain};
  const Complex h0(::j0(u), ::y0(u)), h1(::j1(u), ::y1(u));
  return {(h0 - h1 / u) / plain, h1 / u / plain};
}

/// Mixes the polarisations of a wave of one side. Straight back, sides and the sign of the mixed part are exchanged.
void apply_axis(Complex own, Complex mixed, int side, bool back, Complex& s1, Complex& s2) {
  if ((side > 0) == back) {
    own = std::conj(own);
    mixed = std::conj(mixed);
  }
  if (back) mixed = -mixed;
  const Complex new_s1 = s1 * own + s2 * mixed;
  s2 = s2 * own + s1 * mixed;
  s1 = new_s1;
}

/// J1(u)/u, J1'(u) and the field of a disc.
double j1_over(double u) { return u > 1e-8 ? ::j1(u) / u : 0.5; }

}  // namespace

LargeDrop::LargeDrop(Complex m, std::span<const double> angles_rad) : m_(m), edge_(std::span<const double>{}) {
  if (!(m.real() >= 1.2 && m.real() <= 1.7))
    throw bad_input("large drop", "n = " + number_text(m.real()), "must be between 1.2 and 1.7");
  if (!(m.imag() >= 0 && m.imag() <= 1e-3))
    throw bad_input("large drop", "k = " + number_text(m.imag()), "must be between 0 and 0.001",
                    "Rays are for weak absorption; use the wave solution");
  std::vector<double> angles(angles_rad.begin(), angles_rad.end());
  for (const double angle : angles)
    if (!(angle >= 0 && angle <= pi))
      throw bad_input("large drop", "scattering angle " + number_text(angle) + " rad", "must be between 0 and pi");
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
  images_ = ray_images(m.real(), highest_ray_order, least_size_parameter, angles);
  edge_ = EdgeWaves(angles);
}

void LargeDrop::set_directions(double x) {
  root3_ = std::cbrt(x);
  for (Direction& d : directions_) {
    d.u = x * d.from_axis_rad;
    const AxisFactors f = d.u < at_axis ? AxisFactors{} : axis_factors(d.u);
    d.own = f.own;
    d.mixed = f.mixed;
  }
}

void LargeDrop::add_rays(double x, int order, std::size_t angle, OrderField& field) const {
  const EdgeWindow& window = windows_[static_cast<std::size_t>(order)];
  if (window.everything) return;
  const Direction& direction = directions_[angle];
  const double root3 = root3_, x_23 = root3 * root3;
  const auto left_by_absorption = [&](const RayImage::Ray& ray) {
    return m_.imag() > 0 ? std::exp(-2 * m_.imag() * x * order * ray.cos_refraction) : 1.0;
  };
  for (const RayImage& image : images_.at(order, angle)) {
    // A second image on one side (later orders only) keeps to itself.
    const bool taken = field.slot(image.side, 0).known || field.slot(image.side, 1).known;
    const auto wave_for = [&](int branch, double rate) -> OrderField::Wave& {
      OrderField::Wave& wave = taken ? field.extra() : field.slot(image.side, branch);
      wave.turn = x * rate;
      wave.known = true;
      return wave;
    };
    // The share of the window varies over the ray's Fresnel zone: its slope and curvature enter.
    const auto add_zone = [&](const RayImage::Ray& ray, const EdgeWindow::Share& share, double flat, OrderField::Wave& wave) {
      const double zone = -ray.zone / x;
      Complex s[2];
      for (int j = 0; j < 2; ++j)
        s[j] = x * ray.phase *
               Complex(flat * ray.amplitude[j], zone * (ray.amplitude[j] * share.curvature + ray.amplitude_slope[j] * share.slope));
      if (ray.ring > 0 && x * ray.ring < far_from_axis) {
        const AxisFactors f = axis_factors(x * ray.ring);
        apply_axis(f.own, f.mixed, image.side, direction.back, s[0], s[1]);
      }
      const double left = left_by_absorption(ray);
      wave.s1 += s[0] * left;
      wave.s2 += s[1] * left;
      wave.used = true;
    };
    const auto add_single = [&](const RayImage::Ray& ray, int branch) {
      OrderField::Wave& wave = wave_for(branch, ray.rate);
      const EdgeWindow::Share share = window.at(ray.incidence_rad);
      if (share.value < 1 - 1e-7) add_zone(ray, share, 1 - share.value, wave);
    };
    const double z = image.pair.zeta * x_23;
    if (!image.is_pair() || z < -20) {
      if (image.has_inner) add_single(image.inner, EdgeWaves::inner);
      if (image.has_outer) add_single(image.outer, EdgeWaves::outer);
      continue;
    }
    // Near the bow. (Ai + i Bi)/2 is the inner ray, whose phase lies below the mean, (Ai - i Bi)/2 the outer; on the dark side they are one.
    const bool dark = z > -0.01;
    OrderField::Wave& outer = wave_for(EdgeWaves::outer, dark ? image.pair.rate : image.outer.rate);
    OrderField::Wave& inner = taken ? field.extra() : field.slot(image.side, EdgeWaves::inner);
    inner.turn = x * (dark ? image.pair.rate : image.inner.rate);
    inner.known = true;
    const EdgeWindow::Share in = window.at(image.inner.incidence_rad), out = window.at(image.outer.incidence_rad);
    if (in.value > 1 - 1e-7 && out.value > 1 - 1e-7) continue;
    const AiryValues a = airy(z);
    const double p0 = x * std::sqrt(root3), p1 = x / std::sqrt(root3);
    const auto add_pair = [&](Complex value, Complex slope, double weight, double turn, OrderField::Wave& wave) {
      const Complex front = weight * image.pair.phase * std::polar(1.0, x * image.pair.rate - turn);
      const Complex c0 = front * p0 * value, c1 = front * Complex(0, -p1) * slope;
      wave.s1 += c0 * image.pair.g0[0] + c1 * image.pair.g1[0];
      wave.s2 += c0 * image.pair.g0[1] + c1 * image.pair.g1[1];
      wave.used = true;
    };
    if (dark) {
      const double weight = 1 - 0.5 * (in.value + out.value);
      add_pair(a.ai, a.ai_slope, weight * left_by_absorption(image.outer), outer.turn, outer);
      continue;
    }
    const Complex i(0, 1);
    add_pair(0.5 * (a.ai + i * a.bi), 0.5 * (a.ai_slope + i * a.bi_slope), (1 - in.value) * left_by_absorption(image.inner),
             inner.turn, inner);
    add_pair(0.5 * (a.ai - i * a.bi), 0.5 * (a.ai_slope - i * a.bi_slope), (1 - out.value) * left_by_absorption(image.outer),
             outer.turn, outer);
    if (z < -5) {
      add_zone(image.inner, in, 0, inner);
      add_zone(image.outer, out, 0, outer);
    }
  }
}

/// The |F|^2 below which edge waves do not show: without rays of this order to interfere with, 1e-6 of x^2; with them, amplitudes count.
double LargeDrop::least_edge(double x, int order, std::size_t angle) const {
  const bool joins = order <= highest_ray_order && !images_.at(order, angle).empty();
  const double plain = directions_[angle].plain;
  return (joins ? 1e-9 : 1e-6) * x * x / (plain * plain);
}

bool LargeDrop::has_edge(double x, int order, std::size_t angle) const {
  const double least = least_edge(x, order, angle);
  for (const int side : {1, -1})
    for (const auto branch : {EdgeWaves::inner, EdgeWaves::outer})
      if (edge_.bound(order, branch, angle, side) >= least) return true;
  return false;
}

void LargeDrop::add_edge(double x, int order, std::size_t angle, OrderField& field) const {
  const Direction& direction = directions_[angle];
  const double least = least_edge(x, order, angle);
  for (const int side : {1, -1})
    for (const auto branch : {EdgeWaves::inner, EdgeWaves::outer}) {
      if (edge_.bound(order, branch, angle, side) < least) continue;
      field.apply_phases();
      const ComplexPair value = edge_.value(order, branch, angle, side);
      const Complex front = direction.plain * Complex(std::sqrt(0.5), side > 0 ? -std::sqrt(0.5) : std::sqrt(0.5));
      Complex s1 = first_of(value) * front, s2 = second_of(value) * front;
      if (direction.u < far_from_axis) apply_axis(direction.own, direction.mixed, side, direction.back, s1, s2);
      OrderField::Wave& wave = field.slot(side, branch);
      wave.s1 += s1;
      wave.s2 += s2;
      wave.used = wave.phased = true;
    }
}

void LargeDrop::add_edge_at_axis(int order, const Direction& d, OrderField& field) const {
  const EdgeWaves::Moments& moments = edge_.moments(order, d.back);
  const double u = d.u, j0 = ::j0(u), ratio = j1_over(u), slope = j0 - ratio;
  const double curved = u > 1e-8 ? -slope - (u - 1 / u) * ::j1(u) : 0;  // u J1''
  const ComplexPair own = moments.zeroth * slope + moments.first * curved;
  const ComplexPair mixed = (moments.zeroth * ratio + moments.first * (j0 - 2 * ratio)) * (d.back ? -1.0 : 1.0);
  field.apply_phases();
  OrderField::Wave& wave = field.extra();
  wave.s1 = first_of(own) + second_of(mixed);
  wave.s2 = second_of(own) + first_of(mixed);
  wave.turn = field.slot(d.back ? -1 : 1, EdgeWaves::outer).turn;
  wave.used = wave.phased = true;
}

void LargeDrop::add_disc(double x, const Direction& d, OrderField& field) const {
  const double spread = edge_.disc_softness() * d.angle_rad;
  if (d.back || spread > 6) return;
  // Fraunhofer diffraction, with the edge as soft as the edge waves leave it.
  const double soft = std::exp(-0.5 * spread * spread) * (d.u > 1e-8 ? std::sqrt(d.angle_rad / std::sin(d.angle_rad)) : 1.0);
  const double softness2 = edge_.disc_softness() * edge_.disc_softness();
  if (d.u < at_axis) {
    const double all = soft * (x * x * j1_over(d.u) + 0.5 * softness2 * ::j0(d.u));
    OrderField::Wave& wave = field.extra();
    wave.s1 = wave.s2 = all;
    wave.turn = field.slot(1, EdgeWaves::outer).turn;
    wave.used = wave.phased = true;
    return;
  }
  const Complex h0(::j0(d.u), ::y0(d.u)), h1(::j1(d.u), ::y1(d.u));
  const Complex half = 0.5 * soft * (x / d.angle_rad * h1 + 0.5 * softness2 * h0);
  for (const int side : {1, -1}) {
    OrderField::Wave& wave = field.slot(side, EdgeWaves::outer);
    wave.s1 += side > 0 ? half : std::conj(half);
    wave.s2 += side > 0 ? half : std::conj(half);
    wave.used = wave.phased = true;
  }
}

void LargeDrop::add_later_orders(double x, double relative_step, std::vector<AmplitudeProducts>& sums) const {
  // Light that has gone round so often that the phases of its partial waves are random: sum over the later orders and over the partial
  // waves of (l + 1/2) |c_l|^2.
  double perpendicular = 0, parallel = 0;
  const PartialWaves& waves = edge_.partial_waves();
  const auto later = [](const SurfaceTerms& t) {
    const double inside = std::norm(t.reflected_inside);
    return std::norm(t.passed_through) * std::pow(inside, edge_orders) / (1 - inside);
  };
  for (std::size_t i = 0; i < waves.perpendicular.size(); ++i) {
    const double wave = waves.first + static_cast<double>(i) + 0.5;
    perpendicular += wave * later(waves.perpendicular[i]);
    parallel += wave * later(waves.parallel[i]);
  }
  for (std::size_t a = 0; a < sums.size(); ++a) {
    const Direction& d = directions_[a];
    double own = 1 / (pi * d.sine), mixed = 0, both = 0;
    if (d.u < far_from_axis) {
      const double ratio = j1_over(d.u), slope = ::j0(d.u) - ratio;
      own = x * slope * slope;
      mixed = x * ratio * ratio;
      both = x * slope * ratio * (d.back ? -1 : 1);
      if (d.u > at_axis) {
        const double y_slope = ::y0(d.u) - ::y1(d.u) / d.u, left = fringe_left(relative_step, 2 * d.u);
        own = 0.5 * x * (slope * slope * (1 + left) + y_slope * y_slope * (1 - left));
      }
    }
    sums[a].i1 += perpendicular * own + parallel * mixed;
    sums[a].i2 += parallel * own + perpendicular * mixed;
    sums[a].i3 += (perpendicular + parallel) * both;
  }
}

SphereIntensities LargeDrop::scatter(double x, double relative_step, DebyeOrders orders) {
  if (!(x >= least_size_parameter && x <= largest_size_parameter))
    throw bad_input("large drop", "size parameter " + number_text(x),
                    "must be between " + number_text(least_size_parameter) + " and " + number_text(largest_size_parameter));
  assert(relative_step >= 0);
  for (std::size_t p = 0; p < rays_.size(); ++p) windows_[p] = edge_window(rays_[p], m_.real(), x);
  edge_.sum(x, m_, windows_, rays_);
  set_directions(x);

  const double n = m_.real(), refraction = std::asin(1 / n);
  std::vector<AmplitudeProducts> sums(directions_.size());
  OrderField field;
  for (int p = orders.first; p <= std::min(orders.last, edge_orders); ++p) {
    const double grazing_turned = rays_[static_cast<std::size_t>(p)].turned_rad(0.5 * pi);
    const double grazing_rate = 2 * p * (n * std::cos(refraction) - (0.5 * pi - refraction));
    for (std::size_t a = 0; a < directions_.size(); ++a) {
      const Direction& direction = directions_[a];
      const bool at_the_axis = direction.u < at_axis, edge = at_the_axis || p == 0 || has_edge(x, p, a);
      if (!edge && (p > highest_ray_order || images_.at(p, a).empty())) continue;
      field.clear();
      if (p <= highest_ray_order) add_rays(x, p, a, field);
      // Edge waves continue the rays of their side and branch; where there are none, the grazing ray.
      for (const int side : {1, -1})
        for (const auto branch : {EdgeWaves::inner, EdgeWaves::outer}) {
          OrderField::Wave& wave = field.slot(side, branch);
          if (!edge || wave.known) continue;
          const double turned = side * direction.angle_rad;
          wave.turn = x * (grazing_rate + turned + 2 * pi * std::round((grazing_turned - turned) / (2 * pi)));
        }
      if (at_the_axis)
        add_edge_at_axis(p, direction, field);
      else if (edge)
        add_edge(x, p, a, field);
      if (p == 0) add_disc(x, direction, field);
      field.add_to(sums[a], relative_step);
    }
  }
  if (orders.last > edge_orders) add_later_orders(x, relative_step, sums);

  SphereIntensities result;
  result.efficiencies = efficiencies(x);
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

SphereEfficiencies LargeDrop::efficiencies(double x) const {
  SphereEfficiencies q;
  const EdgeWaves::Moments& forward = edge_.moments(0, false);
  const double disc = 0.5 * (x * x + edge_.disc_softness() * edge_.disc_softness());
  q.extinction = 4 / (x * x) * (disc + 0.5 * (forward.zeroth[0] + forward.zeroth[2]));

  // Scattered power and its mean cosine, orders incoherent: sum of (l + 1/2) |c_l|^2 and (l + 1) Re c_l c_(l+1)* (Bohren & Huffman,
  // section 4.5, for large l); the orders from 1 on are a geometric series. Below the widest window the same with Fresnel's coefficients.
  const PartialWaves& waves = edge_.partial_waves();
  double power = 0, forwardness = 0;
  for (const auto* terms : {&waves.perpendicular, &waves.parallel})
    for (std::size_t i = 0; i + 1 < terms->size(); ++i) {
      const SurfaceTerms &t = (*terms)[i], &next = (*terms)[i + 1];
      const double wave = waves.first + static_cast<double>(i) + 0.5;
      power += wave * (std::norm(1.0 - t.reflected_outside) + std::norm(t.passed_through) / (1 - std::norm(t.reflected_inside)));
      const Complex outside = (1.0 - t.reflected_outside) * std::conj(1.0 - next.reflected_outside);
      const Complex inside = t.passed_through * std::conj(next.passed_through) /
                             (1.0 - t.reflected_inside * std::conj(next.reflected_inside));
      forwardness += (wave + 0.5) * (outside + inside).real();
    }
  power /= x * x;
  forwardness /= x * x;
  static const Quadrature rule = gauss_legendre(64);
  const double last = std::asin(std::min(1.0, waves.first / x));
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    const double incidence = 0.5 * last * (1 + rule.nodes[i]);
    const double weight = 0.25 * last * rule.weights[i] * std::sin(2 * incidence);  // b db
    const auto r = rays_[0].amplitudes(incidence);
    const double refraction = rays_[0].refraction_rad(incidence);
    const double left = std::exp(-4 * m_.imag() * x * std::cos(refraction));
    for (const double amplitude : {r.perpendicular, r.parallel}) {
      const double reflected = amplitude * amplitude, passed = (1 - reflected) * (1 - reflected) * left;
      power += weight * (1 + reflected + passed / (1 - reflected * left));
      const Complex once = std::polar(1.0, rays_[1].turned_rad(incidence)), more = std::polar(1.0, pi - 2 * refraction);
      forwardness += weight * (1 + reflected * std::cos(rays_[0].turned_rad(incidence)) +
                               (passed * once / (1.0 - reflected * left * more)).real());
    }
  }
  q.scattering = std::min(power, q.extinction);
  q.asymmetry = forwardness / power;
  return q;
}

}  // namespace arcus::phase
