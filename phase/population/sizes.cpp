#include "phase/population/sizes.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "phase/base/error.h"
#include "phase/base/quadrature.h"
#include "phase/base/units.h"
#include "phase/settings/number_text.h"

namespace arcus::phase {
namespace {

/// Regularised incomplete gamma function P(a, x): DLMF 8.7.1 (series) and 8.9.2 (continued
/// fraction).
double incomplete_gamma(double a, double x) {
  if (x <= 0) return 0;
  const double front = std::exp(a * std::log(x) - x - std::lgamma(a));
  if (x < a + 1) {
    double term = 1 / a, sum = term;
    for (int n = 1; n < 100000 && term > 1e-17 * sum; ++n) sum += term *= x / (a + n);
    return front * sum;
  }
  double b = x + 1 - a, c = 1e300, d = 1 / b, fraction = d;  // Lentz's evaluation
  for (int n = 1; n < 100000; ++n) {
    const double an = -n * (n - a);
    b += 2;
    d = 1 / (an * d + b);
    c = b + an / c;
    fraction *= c * d;
    if (std::fabs(c * d - 1) < 1e-16) break;
  }
  return 1 - front * fraction;
}

double log_density(const GammaSizes& g, double r) {
  const double shape = (g.alpha + 1) / g.gamma;
  return std::log(g.gamma) + shape * std::log(g.b) - std::lgamma(shape) + g.alpha * std::log(r) -
         g.b * std::pow(r, g.gamma);
}

double density(const OneSize& one, double r) {
  return r == one.radius_um ? std::numeric_limits<double>::infinity() : 0;
}
double density(const GammaSizes& g, double r) { return std::exp(log_density(g, r)); }
double density(const LognormalSizes& l, double r) {
  const double t = std::log(r / l.median_um) / l.s;
  return std::exp(-0.5 * t * t) / (std::sqrt(2 * pi) * l.s * r);
}

double mean_power(const OneSize& one, double order) { return std::pow(one.radius_um, order); }
double mean_power(const GammaSizes& g, double order) {
  return std::exp(std::lgamma((g.alpha + 1 + order) / g.gamma) -
                  std::lgamma((g.alpha + 1) / g.gamma) - order / g.gamma * std::log(g.b));
}
double mean_power(const LognormalSizes& l, double order) {
  return std::exp(order * std::log(l.median_um) + 0.5 * order * order * l.s * l.s);
}

double share_below(const OneSize& one, double r) { return r < one.radius_um ? 0 : 1; }
double share_below(const GammaSizes& g, double r) {
  return incomplete_gamma((g.alpha + 3) / g.gamma, g.b * std::pow(r, g.gamma));
}
double share_below(const LognormalSizes& l, double r) {
  // r^2 n(r) is log-normal too, its median moved by 2 s^2.
  return 0.5 * std::erfc(-(std::log(r / l.median_um) / l.s - 2 * l.s) / std::sqrt(2.0));
}

/// b of n ~ r^alpha exp(-b r^gamma) with this effective radius.
double slope_for(double alpha, double gamma, double effective_radius_um) {
  return std::exp(gamma * (std::lgamma((alpha + 4) / gamma) - std::lgamma((alpha + 3) / gamma) -
                           std::log(effective_radius_um)));
}

std::variant<OneSize, GammaSizes, LognormalSizes> kind_of(const SizesSettings& s,
                                                          double effective_radius_um) {
  if (!(effective_radius_um > 0) || !std::isfinite(effective_radius_um))
    throw bad_input("size_um", number_text(effective_radius_um), "must be above 0");
  if (s.type == "monodisperse") return OneSize{effective_radius_um};
  if (s.type == "marshall_palmer") return GammaSizes{0, slope_for(0, 1, effective_radius_um), 1};
  if (s.type == "modified_gamma") {
    if (!(s.alpha > -1))
      throw bad_input("distribution.alpha", number_text(s.alpha), "must be above -1");
    if (!(s.gamma > 0))
      throw bad_input("distribution.gamma", number_text(s.gamma), "must be above 0");
    return GammaSizes{s.alpha, slope_for(s.alpha, s.gamma, effective_radius_um), s.gamma};
  }
  if (!(s.variance > 0))
    throw bad_input("distribution.variance", number_text(s.variance), "must be above 0");
  if (s.type == "gamma") {
    if (!(s.variance < 0.5))
      throw bad_input(
          "distribution.variance", number_text(s.variance), "must be below 0.5",
          "A gamma distribution of a larger effective variance holds infinitely many drops");
    return GammaSizes{1 / s.variance - 3, 1 / (effective_radius_um * s.variance), 1};
  }
  if (s.type == "lognormal") {
    const double s2 = std::log1p(s.variance);
    return LognormalSizes{effective_radius_um * std::exp(-2.5 * s2), std::sqrt(s2)};
  }
  throw bad_input("distribution.type", s.type,
                  "must be monodisperse, gamma, lognormal, modified_gamma or marshall_palmer");
}

}  // namespace

void list_keys(Keys& keys, SizesSettings& s) {
  keys.choice("type", s.type,
              {"monodisperse", "gamma", "lognormal", "modified_gamma", "marshall_palmer"},
              "how the radii are distributed around the effective radius");
  if (keys.only_if(s.type == "gamma" || s.type == "lognormal", "type = gamma or lognormal")) {
    keys.number("variance", s.variance, above(0), "effective variance; gamma: below 0.5");
    if (s.type == "gamma" && !(s.variance < 0.5))
      keys.refuse("variance", number_text(s.variance), "must be below 0.5");
  }
  if (keys.only_if(s.type == "modified_gamma", "type = modified_gamma")) {
    keys.number("alpha", s.alpha, above(-1), "n ~ r^alpha exp(-b r^gamma)");
    keys.number("gamma", s.gamma, above(0), "n ~ r^alpha exp(-b r^gamma)");
  }
  if (keys.only_if(s.type == "marshall_palmer", "type = marshall_palmer"))
    keys.number("rain_mm_per_hour", s.rain_mm_per_hour, at_least(0),
                "rain rate, which decides the effective radius; 0: the size nodes do");
}

Sizes::Sizes(const SizesSettings& settings, double effective_radius_um)
    : kind_(kind_of(settings, settings.type == "marshall_palmer" && settings.rain_mm_per_hour > 0
                                  ? marshall_palmer_effective_radius_um(settings.rain_mm_per_hour)
                                  : effective_radius_um)) {}

double Sizes::number_per_um(double radius_um) const {
  return std::visit([=](const auto& kind) { return density(kind, radius_um); }, kind_);
}

double Sizes::mean_power_um(double order) const {
  return std::visit([=](const auto& kind) { return mean_power(kind, order); }, kind_);
}

double Sizes::effective_variance() const {
  const double third = mean_power_um(3);
  return mean_power_um(4) * mean_power_um(2) / (third * third) - 1;
}

double Sizes::cross_section_share_below(double radius_um) const {
  return std::visit([=](const auto& kind) { return share_below(kind, radius_um); }, kind_);
}

Sizes::Range Sizes::range_um(double neglected_share) const {
  assert(neglected_share > 0 && neglected_share < 1);
  if (const auto* one = std::get_if<OneSize>(&kind_)) return {one->radius_um, one->radius_um};
  const auto radius_below_which = [this](double share) {
    double low = std::log(effective_radius_um()) - 1, high = low + 2;
    while (cross_section_share_below(std::exp(low)) > share) low -= 1;
    while (cross_section_share_below(std::exp(high)) < share) high += 1;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (cross_section_share_below(std::exp(middle)) < share ? low : high) = middle;
    }
    return std::exp(0.5 * (low + high));
  };
  return {radius_below_which(0.5 * neglected_share), radius_below_which(1 - 0.5 * neglected_share)};
}

std::vector<double> Sizes::weights(std::span<const double> radius_um) const {
  assert(radius_um.size() >= 2);
  std::vector<double> weight(radius_um.size(), 0.0);
  const auto add = [&](std::size_t i, double cross_section,
                       double t) {  // t: place between nodes i and i + 1
    weight[i] += (1 - t) * cross_section / (radius_um[i] * radius_um[i]);
    weight[i + 1] += t * cross_section / (radius_um[i + 1] * radius_um[i + 1]);
  };
  if (const auto* one = std::get_if<OneSize>(&kind_)) {
    const double r = one->radius_um;
    assert(r >= radius_um.front() && r <= radius_um.back());
    const auto above = std::upper_bound(radius_um.begin() + 1, radius_um.end() - 1, r);
    const auto i = static_cast<std::size_t>(above - radius_um.begin()) - 1;
    add(i, r * r, std::log(r / radius_um[i]) / std::log(radius_um[i + 1] / radius_um[i]));
    return weight;
  }
  static const Quadrature rule = gauss_legendre(8);
  // Pieces of the log-radius axis narrow against the distribution, whose width in ln r is about the
  // root of its variance.
  const double widest = std::sqrt(std::min(effective_variance(), 1.0));
  for (std::size_t i = 0; i + 1 < radius_um.size(); ++i) {
    const double start = std::log(radius_um[i]), length = std::log(radius_um[i + 1]) - start;
    assert(length > 0);
    const int pieces = static_cast<int>(std::ceil(length / widest));
    for (int piece = 0; piece < pieces; ++piece)
      for (std::size_t q = 0; q < rule.nodes.size(); ++q) {
        const double t = (piece + 0.5 + 0.5 * rule.nodes[q]) / pieces;
        const double r = std::exp(start + t * length);
        add(i, r * r * r * number_per_um(r) * rule.weights[q] * 0.5 * length / pieces, t);
      }
  }
  return weight;
}

double marshall_palmer_slope_per_mm(double rain_mm_per_hour) {
  return 4.1 * std::pow(rain_mm_per_hour, -0.21);
}

double marshall_palmer_effective_radius_um(double rain_mm_per_hour) {
  return um_from_mm(1.5 / marshall_palmer_slope_per_mm(rain_mm_per_hour));
}

double marshall_palmer_rain_mm_per_hour(double effective_radius_um) {
  return std::pow(4.1 * mm_from_um(effective_radius_um) / 1.5, 1 / 0.21);
}

double marshall_palmer_drops_per_m3(double rain_mm_per_hour) {
  return 8000 / marshall_palmer_slope_per_mm(rain_mm_per_hour);
}

}  // namespace arcus::phase
