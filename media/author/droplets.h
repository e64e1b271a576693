#pragma once
// Cloud droplets: from liquid water and number to size and extinction, and the recipe of their phase functions.

#include <string>
#include <vector>

namespace arcus::media {

/// Effective radius [µm] of droplets whose sizes follow a gamma distribution of effective variance v (Hansen & Travis 1974):
/// LWC = (4/3) π ρ N r_v³ with r_v³ = r_e³ (1 − v)(1 − 2v). liquid_g_per_m3 ≥ 0; drops_per_cm3 above 0; v in (0, 0.5).
double effective_radius_um(double liquid_g_per_m3, double drops_per_cm3, double variance);

/// Extinction from liquid water and effective radius, 3 Q LWC / (4 ρ r_e), Q that of the droplets themselves.
class DropletExtinction {
 public:
  /// Computes Q by Lorenz–Mie at 550 nm for radii between the two: milliseconds.
  DropletExtinction(double variance, double smallest_um, double largest_um);
  /// Mean extinction efficiency at 550 nm; radii outside count as the nearest inside.
  double efficiency(double effective_radius_um) const;
  double per_m(double liquid_g_per_m3, double effective_radius_um) const;

 private:
  double first_ = 0, per_node_ = 1;  // of ln r
  std::vector<double> efficiency_;
};

/// Recipe of water droplets of a gamma distribution, with size nodes a tenth apart that cover the range; on a lattice that all
/// clouds share, so that a like one finds its phase functions in the cache.
std::string droplet_recipe(double variance, double smallest_um, double largest_um);

}  // namespace arcus::media
