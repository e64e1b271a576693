#pragma once
// Scattering angles at which a table holds values, placed by an error bound: between neighbours the phase functions of
// all sizes and wavelengths are linear in s = sin²(θ/2) within a given relative error. Pilot curves on a fine list of
// candidate angles, at a few wavelengths, say how far apart nodes may be; what moves with the wavelength is followed.

#include <span>
#include <vector>

namespace arcus::phase {

/// What decides how fine an angular pattern can be.
struct AngularDetail {
  double smallest_size_parameter = 100;  ///< of the populations' effective radii
  double largest_size_parameter = 100;
  double relative_width = 0.3;  ///< of the narrowest population: root of its effective variance
  double least_index = 1.33;    ///< real part of the index over the wavelengths: where bows can be
  double largest_index = 1.34;
};

/// Angles fine enough to see every detail that populations do not wash out [degrees]: rings around 0 and 180°, bows
/// and their supernumeraries, what interferes elsewhere. Ascending; 0 and 180 are the first and the last.
std::vector<double> candidate_angles_deg(const AngularDetail& detail);

/// Fewest of the angles such that every curve, linear in s between them, stays within `tolerance` of its own values,
/// relative; chosen one after the other, each as far as it can be. Spacings therefore tell what the curves allow.
/// curves: [curve][angle], angle fastest, positive. Returns ascending indices; the first and the last are among them.
std::vector<std::size_t> sufficient_nodes(std::span<const double> angle_deg, std::span<const double> curves,
                                          double tolerance);

/// A range of angles in which nodes must not be further apart than a step.
struct AngleSpan {
  double begin_deg, end_deg, step_deg;
};

/// Turns the spacing of sufficient nodes into spans. Each reaches further, on both sides, by `relative_reach` of its distance from
/// 0 or 180°, whichever is nearer, and by no more than `most_reach_deg`: patterns at other wavelengths are there.
void add_spans(std::span<const double> node_deg, double relative_reach, double most_reach_deg,
               std::vector<AngleSpan>& spans);

/// Nodes that keep all spans, and are as few as that allows; `fixed_deg`, within (0, 180), are among them.
std::vector<double> nodes_of(std::vector<AngleSpan> spans, std::span<const double> fixed_deg);

/// Largest relative difference between values and the function that is linear in s between those whose indices are
/// `nodes`; node 0 and the last are among them.
double interpolation_error(std::span<const double> angle_deg, std::span<const double> values,
                           std::span<const std::size_t> nodes);

}  // namespace arcus::phase
