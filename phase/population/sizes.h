#pragma once
// How the radii of a population are distributed. Every kind is described by its effective radius
// <r^3>/<r^2> (what a size node of a table means) and its shape; Hansen and Travis, Space Sci. Rev.
// 16, 527 (1974).

#include <span>
#include <string>
#include <variant>
#include <vector>

#include "phase/settings/keys.h"

namespace arcus::phase {

/// The shape of a distribution. Which keys count depends on the type.
struct SizesSettings {
  std::string type =
      "gamma";            ///< monodisperse | gamma | lognormal | modified_gamma | marshall_palmer
  double variance = 0.1;  ///< effective variance (gamma: below 0.5; lognormal)
  double alpha = 6;  ///< modified_gamma: n ~ r^alpha exp(-b r^gamma), b from the effective radius
  double gamma = 1;  ///< modified_gamma
  double rain_mm_per_hour =
      0;  ///< marshall_palmer: decides the effective radius; 0: the size nodes do
};
void list_keys(Keys&, SizesSettings&);

/// All drops alike.
struct OneSize {
  double radius_um;
};
/// n(r) ~ r^alpha exp(-b r^gamma): Hansen's gamma (gamma = 1), Deirmendjian's modified gamma,
/// Marshall-Palmer's exponential.
struct GammaSizes {
  double alpha, b, gamma;  ///< b in um^-gamma
};
/// n(r) ~ exp(-ln^2(r / median) / (2 s^2)) / r.
struct LognormalSizes {
  double median_um, s;
};

/// A distribution of radii, normalised to one particle.
class Sizes {
 public:
  /// Throws bad_input that names the key: effective radius not above 0, gamma variance not below
  /// 0.5 (no finite number), alpha not above -1. `rain_mm_per_hour` above 0 replaces the effective
  /// radius.
  Sizes(const SizesSettings& settings, double effective_radius_um);

  /// n(r) [1/um], integral 1. One size has no density: infinite there, zero elsewhere.
  double number_per_um(double radius_um) const;
  /// <r^order> [um^order], in closed form; order above -1.
  double mean_power_um(double order) const;
  double effective_radius_um() const { return mean_power_um(3) / mean_power_um(2); }
  /// <r^4><r^2>/<r^3>^2 - 1.
  double effective_variance() const;
  /// Share of the geometric cross-section, the integral of r^2 n(r), at radii below this one.
  double cross_section_share_below(double radius_um) const;

  struct Range {
    double low_um, high_um;
  };
  /// Half of `neglected_share` of the geometric cross-section lies below the range, half above; in
  /// (0, 1).
  Range range_um(double neglected_share) const;

  /// Weights on a radius grid that others share: sum_i w_i f(r_i) stands for the integral of n(r)
  /// f(r) over the grid's range. Exact where f(r)/r^2 (an efficiency, a phase function times it) is
  /// piecewise linear in ln r between the grid's radii, so sum_i w_i r_i^2 is exact; never
  /// negative. radii ascending, above 0, at least two; what lies outside of them is left out. One
  /// size shares its weight between its two neighbours and must lie within the grid.
  std::vector<double> weights(std::span<const double> radius_um) const;

 private:
  std::variant<OneSize, GammaSizes, LognormalSizes> kind_;
};

/// Rain of J. S. Marshall and W. McK. Palmer, J. Meteor. 5, 165 (1948): N(D) = N0 exp(-Lambda D),
/// N0 = 8000 per m^3 and mm, Lambda = 4.1 R^-0.21 per mm at R mm/h.
double marshall_palmer_slope_per_mm(double rain_mm_per_hour);
/// 1.5 / Lambda.
double marshall_palmer_effective_radius_um(double rain_mm_per_hour);
/// The rain rate whose drops have this effective radius.
double marshall_palmer_rain_mm_per_hour(double effective_radius_um);
/// Drops per m^3: N0 / Lambda.
double marshall_palmer_drops_per_m3(double rain_mm_per_hour);

}  // namespace arcus::phase
