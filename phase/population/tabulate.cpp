#include "phase/population/tabulate.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>

#include "phase/base/units.h"
#include "phase/optics/refractive_index.h"
#include "phase/particle/drop_rays.h"
#include "phase/population/angle_nodes.h"
#include "phase/population/average.h"

namespace arcus::phase {
namespace {

/// Error bound of the nodes at the pilot wavelengths, and the share of the spacing it allows that is used: patterns at
/// other wavelengths may be a little sharper.
constexpr double tolerance = 0.0015, spacing_share = 0.85;
constexpr std::size_t most_pilots = 6;
/// Populations narrower than this keep the interference between rays of different orders that large drops leave out.
constexpr double least_width_for_rays = 0.01;

std::vector<Sizes> sizes_of(const Population& p) {
  std::vector<Sizes> sizes;
  for (const double size_um : p.size_um) sizes.emplace_back(p.distribution, size_um);
  return sizes;
}

AngularDetail detail_of(const Population& p, const std::vector<Sizes>& sizes) {
  AngularDetail detail;
  detail.smallest_size_parameter = size_parameter(p.size_um.front(), p.wavelength_nm.back());
  detail.largest_size_parameter = size_parameter(p.size_um.back(), p.wavelength_nm.front());
  detail.relative_width = 10;
  for (const Sizes& size : sizes)
    detail.relative_width = std::min(detail.relative_width, std::sqrt(size.effective_variance()));
  const auto [least, largest] = std::minmax_element(p.index.begin(), p.index.end(), [](auto a, auto b) {
    return a.real() < b.real();
  });
  detail.least_index = least->real();
  detail.largest_index = largest->real();
  return detail;
}

/// Wavelengths that stand for the others: all of a few, or else evenly spread in 1/λ, in which patterns move evenly.
std::vector<double> pilots_of(const std::vector<double>& wavelength_nm) {
  if (wavelength_nm.size() <= most_pilots) return wavelength_nm;
  std::vector<double> pilots;
  const double first = 1 / wavelength_nm.front(), last = 1 / wavelength_nm.back();
  for (std::size_t i = 0; i < most_pilots; ++i)
    pilots.push_back(1 / (first + (last - first) * static_cast<double>(i) / (most_pilots - 1)));
  pilots.front() = wavelength_nm.front();
  pilots.back() = wavelength_nm.back();
  return pilots;
}

/// p11 of all sizes, [size][angle].
std::vector<double> curves_of(const PopulationMeans& means, std::size_t angles) {
  std::vector<double> curves;
  for (std::size_t size = 0; size < means.asymmetry.size(); ++size) {
    const auto row = means.matrix.begin() + static_cast<std::ptrdiff_t>(size * matrix_elements * angles);
    curves.insert(curves.end(), row, row + static_cast<std::ptrdiff_t>(angles));
  }
  return curves;
}

std::vector<double> angle_nodes(const Population& p, const std::vector<Sizes>& sizes, bool may_use_rays,
                                const std::vector<double>& fixed_deg, Work& work) {
  const std::vector<double> candidates = candidate_angles_deg(detail_of(p, sizes));
  const std::vector<double> pilots = pilots_of(p.wavelength_nm);
  // Half the spheres: the curves are asked for their shape only.
  const SphereAverage average(sizes, candidates, p.wavelength_nm.front(), std::max(p.radii / 2, 2LL), may_use_rays);
  std::vector<std::vector<double>> nodes(pilots.size());
  tbb::parallel_for(std::size_t{0}, pilots.size(), [&](std::size_t i) {
    const PopulationMeans means = average.means(pilots[i], p.index_at(pilots[i]));
    for (const std::size_t node : sufficient_nodes(candidates, curves_of(means, candidates.size()), tolerance))
      nodes[i].push_back(candidates[node]);
    work.done(2);
  });
  // Half the way to the next pilot: rings go as the wavelength, bows by dispersion, up to half a degree between pilots.
  // At least the radius of the sun's disc, because a table averaged over it has its details that far away.
  const double ratio = pilots.size() == 1 ? 1 : std::pow(pilots.back() / pilots.front(), 1.0 / (pilots.size() - 1.0));
  const bool all_are_pilots = pilots.size() == p.wavelength_nm.size();
  std::vector<AngleSpan> spans;
  for (const auto& of_pilot : nodes)
    add_spans(of_pilot, all_are_pilots ? 0.03 : std::max(0.03, 0.5 * (ratio - 1)), all_are_pilots ? 0.3 : 0.6, spans);
  for (AngleSpan& span : spans) span.step_deg *= spacing_share;
  return nodes_of(std::move(spans), fixed_deg);
}

/// Writes the means at one wavelength into the table, normalised, and returns what the interpolant's integral was off.
double store(const PopulationMeans& means, std::size_t wavelength, ScatteringTable& t) {
  const std::size_t angles = t.scattering_angle_deg.size();
  double worst = 0;
  for (std::size_t size = 0; size < t.size_um.size(); ++size) {
    const std::size_t row = t.row(size, wavelength), first = t.first(size, wavelength);
    t.extinction_cross_section_m2[row] = means.extinction_m2[size];
    t.scattering_cross_section_m2[row] = means.scattering_m2[size];
    t.asymmetry[row] = means.asymmetry[size];
    const double* from = &means.matrix[size * matrix_elements * angles];
    // In double precision first: single values would carry rounding of the forward peak into the factor.
    double integral = 0;
    for (std::size_t i = 1; i < angles; ++i)
      integral += 2 * pi * (from[i - 1] + from[i]) *
                  (sin2_half_deg(t.scattering_angle_deg[i]) - sin2_half_deg(t.scattering_angle_deg[i - 1]));
    worst = std::max(worst, std::fabs(integral - 1));
    for (std::vector<float>* element : {&t.p11, &t.p12, &t.p33, &t.p34}) {
      for (std::size_t i = 0; i < angles; ++i) (*element)[first + i] = static_cast<float>(from[i] / integral);
      from += angles;
    }
  }
  return worst;
}

/// Share of the extinction of one row that goes straight on once the forward lobe is clipped.
double forward_fraction(const ScatteringTable& t, std::size_t size, std::size_t wavelength) {
  const std::size_t angles = t.scattering_angle_deg.size(), row = t.row(size, wavelength);
  const auto first = t.p11.begin() + static_cast<std::ptrdiff_t>(t.first(size, wavelength));
  std::vector<float> p11(first, first + static_cast<std::ptrdiff_t>(angles));
  clip_forward(t.scattering_angle_deg, t.forward_angle_deg, p11.data());
  const double removed = 1 - sphere_integral(t.scattering_angle_deg, p11.data());
  return std::max(0.0, removed) * t.scattering_cross_section_m2[row] / t.extinction_cross_section_m2[row];
}

/// Largest error between the nodes at a wavelength, tried in the middle of every interval.
double error_between(const Population& p, const std::vector<Sizes>& sizes, bool may_use_rays,
                     const std::vector<double>& nodes_deg, double nm) {
  std::vector<double> angles;
  std::vector<std::size_t> nodes;
  for (std::size_t i = 0; i < nodes_deg.size(); ++i) {
    if (i > 0) angles.push_back(0.5 * (nodes_deg[i - 1] + nodes_deg[i]));
    nodes.push_back(angles.size());
    angles.push_back(nodes_deg[i]);
  }
  const SphereAverage average(sizes, angles, p.wavelength_nm.front(), p.radii, may_use_rays);
  const std::vector<double> curves = curves_of(average.means(nm, p.index_at(nm)), angles.size());
  double worst = 0;
  for (std::size_t size = 0; size < sizes.size(); ++size)
    worst = std::max(worst, interpolation_error(angles, std::span(curves).subspan(size * angles.size(), angles.size()), nodes));
  return worst;
}

void allocate(ScatteringTable& t) {
  const std::size_t rows = t.size_um.size() * t.wavelength_nm.size();
  for (auto* values : {&t.extinction_cross_section_m2, &t.scattering_cross_section_m2, &t.asymmetry, &t.forward_fraction})
    values->assign(rows, 0);
  for (auto* values : {&t.p11, &t.p12, &t.p33, &t.p34}) values->assign(rows * t.scattering_angle_deg.size(), 0);
}

}  // namespace

ScatteringTable tabulate(const Population& p, const Progress& progress) {
  assert(!p.size_um.empty() && !p.wavelength_nm.empty() && p.index.size() == p.wavelength_nm.size());
  const std::vector<Sizes> sizes = sizes_of(p);
  const bool may_use_rays = std::all_of(p.index.begin(), p.index.end(), SphereAverage::rays_serve) &&
                            detail_of(p, sizes).relative_width >= least_width_for_rays;
  ScatteringTable t;
  t.size_um = p.size_um;
  t.wavelength_nm = p.wavelength_nm;
  if (p.remove_forward_lobe && p.size_um.back() >= least_lobeless_um) t.forward_angle_deg = lobe_angle_deg;
  const std::vector<double> fixed = t.forward_angle_deg > 0 ? std::vector{t.forward_angle_deg} : std::vector<double>{};
  const double pilots = static_cast<double>(std::min(most_pilots, p.wavelength_nm.size()));
  Work work(progress, 2 * pilots + static_cast<double>(p.wavelength_nm.size()) + 2);
  t.scattering_angle_deg = angle_nodes(p, sizes, may_use_rays, fixed, work);
  allocate(t);

  const SphereAverage average(sizes, t.scattering_angle_deg, p.wavelength_nm.front(), p.radii, may_use_rays);
  std::vector<double> normalisation(p.wavelength_nm.size());
  tbb::parallel_for(std::size_t{0}, p.wavelength_nm.size(), [&](std::size_t i) {
    normalisation[i] = store(average.means(p.wavelength_nm[i], p.index[i]), i, t);
    work.done(1);
  });
  t.normalisation_error = *std::max_element(normalisation.begin(), normalisation.end());
  if (t.forward_angle_deg > 0)
    for (std::size_t size = 0; size < p.size_um.size(); ++size)
      for (std::size_t i = 0; p.size_um[size] >= least_lobeless_um && i < p.wavelength_nm.size(); ++i)
        t.forward_fraction[t.row(size, i)] = forward_fraction(t, size, i);
  // In the blue, where patterns move fastest, and somewhere in the middle; neither is a pilot.
  const std::size_t count = p.wavelength_nm.size();
  t.angle_error = error_between(p, sizes, may_use_rays, t.scattering_angle_deg, p.wavelength_nm[std::min(count - 1, count / 16 + 1)]);
  work.done(2);
  return t;
}

ScatteringTable tabulate_rays(const Population& p) {
  ScatteringTable t;
  t.size_um = p.size_um;
  t.wavelength_nm = p.wavelength_nm;
  constexpr double step_deg = 0.05;
  constexpr int steps = 3600, highest_order = 20;
  for (int i = 0; i <= steps; ++i) t.scattering_angle_deg.push_back(i == steps ? 180 : i * step_deg);
  allocate(t);
  // A node stands for the cell around it, cut in the middle in s = sin²(θ/2): the integral of the interpolant is then the
  // power in the cells.
  std::vector<double> edges{0};
  for (int i = 0; i < steps; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const double s = 0.5 * (sin2_half_deg(t.scattering_angle_deg[at]) + sin2_half_deg(t.scattering_angle_deg[at + 1]));
    edges.push_back(2 * std::asin(std::sqrt(s)));
  }
  edges.push_back(pi);
  const std::vector<Sizes> sizes = sizes_of(p);
  std::vector<double> normalisation(p.wavelength_nm.size());
  tbb::parallel_for(std::size_t{0}, p.wavelength_nm.size(), [&](std::size_t i) {
    for (std::size_t size = 0; size < sizes.size(); ++size) {
      const double x = size_parameter(p.size_um[size], p.wavelength_nm[i]);
      const GeometricSphere sphere = geometric_sphere(x, p.index[i], edges, highest_order);
      const double disc_m2 = pi * sizes[size].mean_power_um(2) * 1e-12;
      const std::size_t row = t.row(size, i), first = t.first(size, i);
      for (std::size_t a = 0; a < t.scattering_angle_deg.size(); ++a) {
        t.p11[first + a] = static_cast<float>(sphere.s11[a] / sphere.efficiencies.scattering);
        t.p12[first + a] = static_cast<float>(sphere.s12[a] / sphere.efficiencies.scattering);
        t.p33[first + a] = static_cast<float>(sphere.s33[a] / sphere.efficiencies.scattering);
      }
      const double integral = sphere_integral(t.scattering_angle_deg, &t.p11[first]);
      normalisation[i] = std::max(normalisation[i], std::fabs(integral - 1));
      for (auto* element : {&t.p11, &t.p12, &t.p33})
        for (std::size_t a = 0; a < t.scattering_angle_deg.size(); ++a)
          (*element)[first + a] = static_cast<float>((*element)[first + a] / integral);
      t.extinction_cross_section_m2[row] = disc_m2;
      t.scattering_cross_section_m2[row] = disc_m2 * sphere.efficiencies.scattering;
      t.asymmetry[row] = sphere_integral_of_cosine(t.scattering_angle_deg, &t.p11[first]);
    }
  });
  t.normalisation_error = *std::max_element(normalisation.begin(), normalisation.end());
  return t;
}

}  // namespace arcus::phase
