#pragma once
// Made-up drops: a scattering table in closed form with everything that makes real ones hard. A
// forward peak over six decades, two bows with supernumeraries that shift with the refractive index
// and open as wavelength^(2/3), a dark band, a glory. Known at any angle and wavelength, so that
// what a table makes of its nodes can be held against it.

#include <vector>

#include "phase/population/scattering_table.h"

namespace arcus::phase {

/// Phase function before normalisation, and with it: 1/sr.
class SyntheticDrops {
 public:
  explicit SyntheticDrops(double size_um);
  /// Not normalised.
  double shape(double angle_deg, double wavelength_nm) const;

  /// Refractive index, with the dispersion of water.
  static double index(double wavelength_nm);
  /// Descartes' angle of the bow with that many internal reflections [deg].
  static double bow_deg(double wavelength_nm, int reflections);

 private:
  double size_um_;
  std::vector<double> airy_squared_;  // damped, over z from −6 in steps of 1/256
  double airy(double z) const;
};

/// Angle nodes [deg] that resolve the features of all sizes up to 1000 µm; of them every n-th.
std::vector<double> synthetic_angles_deg(int every = 1);

/// Values at the nodes divided by their integral: one row of a table, or the truth between two.
std::vector<double> synthetic_row(const SyntheticDrops& drops, double wavelength_nm,
                                  const std::vector<double>& angle_deg);

/// A table of such drops at every n-th of the angle nodes. A coarse one is no worse where the nodes
/// are all that matters, and quickly made.
ScatteringTable synthetic_table(const std::vector<double>& size_um,
                                const std::vector<double>& wavelength_nm, int every = 1);

/// Wavelengths [nm] from first to last in equal steps.
std::vector<double> wavelengths_nm(double first, double last, double step);

/// The same value everywhere, at a few nodes.
ScatteringTable isotropic_table();

/// Integral over the sphere of a function linear in s between its nodes; times cos θ.
double integral_over_sphere(const std::vector<double>& angle_deg, const std::vector<double>& values);
double mean_cosine(const std::vector<double>& angle_deg, const std::vector<double>& values);

}  // namespace arcus::phase
