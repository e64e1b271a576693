#pragma once
// What a population of particles does to light, as plain arrays over size, wavelength and scattering angle: the
// memory image of the NetCDF file. Everything is the particles' own, complete scattering, without the sun's disc; only
// what goes straight on, as light does through parallel faces of crystals, may be in the cross-sections alone.

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "phase/base/units.h"

namespace arcus::phase {

/// s = sin²(θ/2) of a scattering angle in degrees, in [0, 1]. The one conversion from angle nodes to the variable of
/// interpolation, so that all who use a table place its nodes at the same s.
inline double sin2_half_deg(double angle_deg) {
  const double sine = std::sin(0.5 * radians(angle_deg));
  return sine * sine;
}

/// Cross-sections and the scattering matrix of randomly oriented symmetric particles (P22 = P11, P44 = P33 for
/// spheres). Between the angle nodes p11, p12, p33 and p34 are linear in s = sin²(θ/2), dΩ = 4π ds; under that rule
/// the integral of p11 over the sphere is 1 for every size and wavelength.
struct ScatteringTable {
  std::vector<double> size_um;               ///< ascending, at least one: effective radius of the population
  std::vector<double> wavelength_nm;         ///< ascending, at least one: in vacuum
  std::vector<double> scattering_angle_deg;  ///< ascending from 0 to 180, both included

  // [size][wavelength], wavelength fastest
  std::vector<double> extinction_cross_section_m2;  ///< mean of a particle, complete (diffraction included)
  std::vector<double> scattering_cross_section_m2;
  std::vector<double> asymmetry;         ///< mean cosine of the scattering angle, of p11
  std::vector<double> forward_fraction;  ///< share of the extinction that goes straight on, see forward_angle_deg; 0: none

  // [size][wavelength][angle], angle fastest, 1/sr; sign of p12: physics of Bohren & Huffman, S12 = (|S2|² − |S1|²)/2.
  // Tables of crystals are traced with unpolarised light and know p11 and p12 only: their p33 and p34 are 0, everywhere.
  std::vector<float> p11, p12, p33, p34;

  /// How the forward fraction leaves p11. Above 0: p11 has the lobe, and clip_forward removes it inside this angle (a node).
  /// 0: that light is in no p11, p12 or asymmetry, which are of the rest, but in both cross-sections.
  double forward_angle_deg = 0;

  // What is known about the table's own errors; kept as attributes of the file.
  double normalisation_error = 0;  ///< largest |1 − integral of p11| before the interpolant was normalised
  double angle_error = 0;          ///< largest relative error of p11 between angle nodes, as far as it was checked

  std::size_t row(std::size_t size, std::size_t wavelength) const { return size * wavelength_nm.size() + wavelength; }
  /// Index of the first angle of a row in p11, p12, p33, p34.
  std::size_t first(std::size_t size, std::size_t wavelength) const {
    return row(size, wavelength) * scattering_angle_deg.size();
  }
};

/// Clips the forward lobe of one row of p11 in place, at its nodes: inside forward_angle_deg no value is above the one
/// at that angle. What is left is not renormalised: 1 minus its integral is the share of the scattered energy removed.
template <class Number>
void clip_forward(const std::vector<double>& angle_deg, double forward_angle_deg, Number* p11) {
  std::size_t edge = 0;
  while (edge + 1 < angle_deg.size() && angle_deg[edge] < forward_angle_deg) ++edge;
  for (std::size_t i = 0; i < edge; ++i)
    if (p11[i] > p11[edge]) p11[i] = p11[edge];
}

/// Integral over the sphere of values at the angle nodes [1/sr], linear in s = sin²(θ/2) between them.
double sphere_integral(const std::vector<double>& angle_deg, const float* values);

/// Mean over the same function of the cosine of the scattering angle, times its integral.
double sphere_integral_of_cosine(const std::vector<double>& angle_deg, const float* values);

/// Throws bad_input with `where` unless the table is one that can be rendered: axes ascending, angles from 0 to 180
/// degrees, arrays as long as they must be, all values finite, cross-sections above 0, forward fraction from 0 to
/// below 1, p11 not negative and its integral 1 within 1e-4.
void check_table(const ScatteringTable& table, const std::string& where);

}  // namespace arcus::phase
