#include "phase/population/average.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "phase/base/error.h"
#include "phase/base/units.h"
#include "phase/optics/refractive_index.h"
#include "phase/particle/large_drop.h"
#include "phase/particle/mie_block.h"
#include "phase/population/radius_grid.h"
#include "phase/settings/number_text.h"

namespace arcus::phase {
namespace {

/// From here on drops are large. The two methods agree within 0.1 % rms here, but for the last two degrees before 180,
/// where large drops are up to 8 % off (tests); fewer spheres with ripple are then needed for smooth sums.
constexpr double border_size_parameter = 1000;
constexpr double largest_wave_size_parameter = 1e5;  // of MieAngles
/// Parts into which the radii of one wavelength are cut for threads. Fixed, so that sums have one order.
constexpr std::size_t wave_parts = 8, large_parts = 2;

/// Sums over radii for all size nodes.
struct Sums {
  Sums(std::size_t sizes, std::size_t angles)
      : extinction(sizes), scattering(sizes), cosine(sizes), matrix(sizes * matrix_elements * angles) {}
  void add(const Sums& other) {
    const auto add_all = [](std::vector<double>& to, const std::vector<double>& from) {
      for (std::size_t i = 0; i < to.size(); ++i) to[i] += from[i];
    };
    add_all(extinction, other.extinction);
    add_all(scattering, other.scattering);
    add_all(cosine, other.cosine);
    add_all(matrix, other.matrix);
  }

  std::vector<double> extinction, scattering, cosine;  // [size]: cross-sections [µm²]
  std::vector<double> matrix;                          // [size][element][angle]: of i11, ... over k² [µm²/sr]
};

/// A stretch of a radius grid, and what turns its spheres into cross-sections.
struct Stretch {
  const RadiusGrid& grid;
  std::size_t first, last;
  double x_per_um;
  double weight(std::size_t size, std::size_t radius) const {
    return grid.weight[size * grid.radius_um.size() + radius];
  }
};

void add_efficiencies(const Stretch& part, std::size_t radius, const SphereEfficiencies& q, Sums& sums) {
  const double disc_um2 = pi * part.grid.radius_um[radius] * part.grid.radius_um[radius];
  for (std::size_t size = 0; size < sums.extinction.size(); ++size) {
    const double um2 = disc_um2 * part.weight(size, radius);
    sums.extinction[size] += um2 * q.extinction;
    sums.scattering[size] += um2 * q.scattering;
    sums.cosine[size] += um2 * q.scattering * q.asymmetry;
  }
}

/// Angles that are added at a time: a tile of a block of spheres and its sums stay in the nearest caches.
constexpr std::size_t angle_tile = 64;

/// sum += Σ over the radii of a block of weight · values. Sixteen terms are added in single precision, blocks in double:
/// rounding stays near 1e-7. values: [radius][element][angle], sum: of one size and element.
void add_block(const float* values, std::size_t stride, const float* weights, std::size_t count, std::size_t length,
               double* sum) {
  float partial[angle_tile] = {};
  for (std::size_t r = 0; r < count; ++r) {
    const float* from = values + r * stride;
    const float w = weights[r];
    if (length == angle_tile) {
      for (std::size_t i = 0; i < angle_tile; ++i) partial[i] += w * from[i];
    } else {
      for (std::size_t i = 0; i < length; ++i) partial[i] += w * from[i];
    }
  }
  for (std::size_t i = 0; i < length; ++i) sum[i] += partial[i];
}

/// Weights of a block of radii in the populations that have any there.
struct BlockWeights {
  BlockWeights(const Stretch& part, std::size_t sizes, std::size_t start, std::size_t count) {
    const double per_k2 = 1 / (part.x_per_um * part.x_per_um);
    for (std::size_t size = 0; size < sizes; ++size) {
      std::array<float, mie_block_radii> w{};
      for (std::size_t i = 0; i < count; ++i) w[i] = static_cast<float>(part.weight(size, start + i) * per_k2);
      if (*std::max_element(w.begin(), w.end()) == 0) continue;
      sizes_there.push_back(size);
      weights.push_back(w);
    }
  }
  std::vector<std::size_t> sizes_there;
  std::vector<std::array<float, mie_block_radii>> weights;
};

void add_waves(const MieAngles& angles, std::complex<double> index, const Stretch& part, Sums& sums) {
  MieBlock block(angles);
  std::vector<float> matrix(mie_block_radii * matrix_elements * angle_tile);
  for (std::size_t start = part.first; start < part.last; start += mie_block_radii) {
    const std::size_t count = std::min<std::size_t>(mie_block_radii, part.last - start);
    double x[mie_block_radii];
    for (std::size_t i = 0; i < count; ++i) x[i] = part.grid.radius_um[start + i] * part.x_per_um;
    const BlockWeights weights(part, sums.extinction.size(), start, count);
    if (weights.weights.empty()) continue;
    block.compute(std::span(x, count), index);
    for (std::size_t i = 0; i < count; ++i) add_efficiencies(part, start + i, block.efficiencies()[i], sums);
    for (std::size_t first = 0; first < angles.size(); first += angle_tile) {
      const std::size_t here = std::min(angle_tile, angles.size() - first);
      block.matrix(first, here, std::span(matrix.data(), count * matrix_elements * here));
      for (std::size_t k = 0; k < weights.weights.size(); ++k)
        for (std::size_t element = 0; element < matrix_elements; ++element)
          add_block(&matrix[element * here], matrix_elements * here, weights.weights[k].data(), count, here,
                    &sums.matrix[(weights.sizes_there[k] * matrix_elements + element) * angles.size() + first]);
    }
  }
}

/// drop: its own copy, which is working memory.
void add_large(LargeDrop drop, std::size_t angles, const Stretch& part, Sums& sums) {
  const double per_k2 = 1 / (part.x_per_um * part.x_per_um);
  for (std::size_t i = part.first; i < part.last; ++i) {
    const SphereIntensities sphere = drop.scatter(part.grid.radius_um[i] * part.x_per_um, part.grid.relative_step[i]);
    add_efficiencies(part, i, sphere.efficiencies, sums);
    for (std::size_t size = 0; size < sums.extinction.size(); ++size) {
      const double weight = part.weight(size, i) * per_k2;
      if (weight == 0) continue;
      double* sum = &sums.matrix[size * matrix_elements * angles];
      for (const std::vector<double>* element : {&sphere.i11, &sphere.i12, &sphere.i33, &sphere.i34}) {
        for (std::size_t a = 0; a < angles; ++a) sum[a] += weight * (*element)[a];
        sum += angles;
      }
    }
  }
}

/// Cuts a grid into parts, lets `add` sum each, and adds the sums in order.
template <class Add>
void sum_in_parts(const RadiusGrid& grid, std::size_t parts, std::size_t multiple_of, double x_per_um, const Add& add,
                  Sums& total) {
  const std::size_t count = grid.radius_um.size();
  if (count == 0) return;
  const std::size_t blocks = (count + multiple_of - 1) / multiple_of;
  const std::size_t length = (blocks + parts - 1) / parts * multiple_of;
  std::vector<std::unique_ptr<Sums>> sums((count + length - 1) / length);
  tbb::parallel_for(std::size_t{0}, sums.size(), [&](std::size_t i) {
    sums[i] = std::make_unique<Sums>(total.extinction.size(),
                                     total.matrix.size() / matrix_elements / total.extinction.size());
    add(Stretch{grid, i * length, std::min(count, (i + 1) * length), x_per_um}, *sums[i]);
  });
  // A part is missing where work at another wavelength failed and cancelled this: its error is on the way.
  for (const auto& part : sums)
    if (part) total.add(*part);
}

std::vector<double> in_radians(const std::vector<double>& angle_deg) {
  std::vector<double> angle_rad;
  for (const double deg : angle_deg) angle_rad.push_back(deg == 180 ? pi : radians(deg));
  return angle_rad;
}

double largest_size_parameter(const std::vector<Sizes>& sizes, double wavelength_nm) {
  double x = 0;
  for (const Sizes& size : sizes) x = std::max(x, size_parameter(size.range_um(1e-5).high_um, wavelength_nm));
  return x * (1 + 1e-9);
}

MieAngles checked_angles(const std::vector<double>& angle_rad, double x) {
  if (x > largest_wave_size_parameter)
    throw bad_input("size_um", "particles up to size parameter " + number_text(std::round(x)), "must be at most 1e5",
                    "For this material, whose index is far from that of water, waves are summed for all sizes");
  return MieAngles(angle_rad, x);
}

}  // namespace

struct SphereAverage::Parts {
  Parts(std::vector<Sizes> s, const std::vector<double>& angle_deg, double shortest_nm, long long count, bool use_rays)
      : sizes(std::move(s)), angle_rad(in_radians(angle_deg)), radii(count),
        border(use_rays ? border_size_parameter : largest_wave_size_parameter),
        angles(checked_angles(angle_rad, std::min(use_rays ? border * (1 + 1e-9) : 1e300,
                                                  largest_size_parameter(sizes, shortest_nm)))) {}
  std::vector<Sizes> sizes;
  std::vector<double> angle_rad;
  long long radii;
  double border;
  MieAngles angles;
};

SphereAverage::SphereAverage(std::vector<Sizes> sizes, std::vector<double> angle_deg, double shortest_wavelength_nm,
                             long long radii, bool may_use_rays)
    : parts_(std::make_unique<const Parts>(std::move(sizes), angle_deg, shortest_wavelength_nm, radii, may_use_rays)) {
  const double x = largest_size_parameter(parts_->sizes, shortest_wavelength_nm);
  if (may_use_rays && x > LargeDrop::largest_size_parameter) {
    const double largest_um = LargeDrop::largest_size_parameter / size_parameter(1, shortest_wavelength_nm);
    throw bad_input("size_um", "a distribution with drops up to size parameter " + number_text(std::round(x)),
                    "must be at most 2e5, a radius of " + number_text(std::round(largest_um)) + " um at the shortest wavelength",
                    "Choose smaller size nodes or a narrower distribution; drops of rain break up before 4000 um");
  }
}
SphereAverage::~SphereAverage() = default;

bool SphereAverage::rays_serve(std::complex<double> m) {
  return m.real() >= 1.2 && m.real() <= 1.7 && m.imag() <= 1e-3;
}

PopulationMeans SphereAverage::means(double wavelength_nm, std::complex<double> relative_index) const {
  const Parts& p = *parts_;
  const std::size_t sizes = p.sizes.size(), row = matrix_elements * p.angle_rad.size();
  const double x_per_um = size_parameter(1, wavelength_nm);
  const RadiusGrids grids = radius_grids(p.sizes, wavelength_nm, p.border, p.radii);
  Sums sums(sizes, p.angle_rad.size());
  sum_in_parts(grids.wave, wave_parts, mie_block_radii, x_per_um,
               [&](const Stretch& part, Sums& to) { add_waves(p.angles, relative_index, part, to); }, sums);
  if (!grids.large.radius_um.empty()) {
    const LargeDrop drop(relative_index, p.angle_rad);  // what depends on the angles alone takes as long as a dozen sizes
    sum_in_parts(grids.large, large_parts, 1, x_per_um,
                 [&](const Stretch& part, Sums& to) { add_large(drop, p.angle_rad.size(), part, to); }, sums);
  }
  PopulationMeans means;
  means.matrix = std::move(sums.matrix);
  for (std::size_t size = 0; size < sizes; ++size) {
    means.extinction_m2.push_back(sums.extinction[size] * 1e-12);
    means.scattering_m2.push_back(sums.scattering[size] * 1e-12);
    means.asymmetry.push_back(sums.cosine[size] / sums.scattering[size]);
    for (std::size_t i = 0; i < row; ++i) means.matrix[size * row + i] /= sums.scattering[size];
  }
  return means;
}

}  // namespace arcus::phase
