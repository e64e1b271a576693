// Building a SphereTable: fine wavelengths, the mean over the sun's disc, cumulatives and guides.

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <memory>

#include "phase/function/disc_convolution.h"
#include "phase/function/sphere_table.h"
#include "phase/function/sphere_table_guides.h"
#include "phase/function/wavelength_interpolation.h"

namespace arcus::phase {

namespace {

using Interpolations = std::vector<std::unique_ptr<const WavelengthInterpolation>>;

/// More would sharpen nothing once the sun's disc has blurred every feature to half a degree.
constexpr int most_sunlit_nodes = 161;
constexpr int fewest_nodes = 41;
constexpr double largest_linear_error = 0.002;

WavelengthGrid grid_over(const ScatteringTable& table, int count) {
  return WavelengthGrid(table.wavelength_nm.front(), table.wavelength_nm.back(), count);
}

/// Largest relative error of a value halfway between two nodes of a grid, at a few places. The last
/// 0.1° before straight back do not count: there large drops glitter too fast with wavelength for any
/// grid, in a hundred-thousandth of the sphere.
double linear_error(const WavelengthInterpolation& rows, const WavelengthGrid& grid,
                    const std::vector<double>& angle_deg) {
  const std::size_t angles = angle_deg.size();
  std::vector<float> left(angles), middle(angles), right(angles);
  double largest = 0;
  for (const double place : {0.02, 0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.95}) {
    const double node = std::floor(place * (grid.count() - 1));
    rows.evaluate(grid.wavelength_nm(node), left);
    rows.evaluate(grid.wavelength_nm(node + 0.5), middle);
    rows.evaluate(grid.wavelength_nm(node + 1), right);
    for (std::size_t i = 0; i < angles && angle_deg[i] < 179.9; ++i)
      if (middle[i] > 0)
        largest = std::max(largest, std::fabs(0.5 * (left[i] + right[i]) / middle[i] - 1.0));
  }
  return largest;
}

/// Nodes that keep linear interpolation accurate, for the largest, a middle and the smallest size.
int accurate_node_count(const ScatteringTable& table, const Interpolations& rows) {
  const WavelengthGrid trial = grid_over(table, 161);
  double error = 0;
  for (const std::size_t size : {rows.size() - 1, rows.size() / 2, std::size_t{0}})
    error = std::max(error, linear_error(*rows[size], trial, table.scattering_angle_deg));
  // The error goes with the square of the step.
  const double count = 160 * std::sqrt(error / largest_linear_error) + 1;
  return static_cast<int>(std::fmin(std::fmax(count, fewest_nodes), 1e6));
}

/// The angle nodes of a SphereTable: those of the scattering table, and 90°.
struct Angles {
  std::vector<double> deg;
  int inserted = 0;        // where 90° was inserted; 0: it was there
  float inserted_share = 0;  // of the next node, where values are linear in s

  explicit Angles(const std::vector<double>& table_deg) : deg(table_deg) {
    const auto next = std::lower_bound(deg.begin(), deg.end(), 90.0);
    if (*next == 90) return;
    const double a = sin2_half_deg(*(next - 1)), b = sin2_half_deg(*next);
    inserted_share = static_cast<float>((0.5 - a) / (b - a));
    inserted = static_cast<int>(next - deg.begin());
    deg.insert(next, 90.0);
  }
  int count() const { return static_cast<int>(deg.size()); }
  int table_count() const { return count() - (inserted > 0); }
  /// Value at one of the nodes from those at the table's.
  float value(const float* row, int node) const {
    if (inserted == 0 || node < inserted) return row[node];
    if (node > inserted) return row[node - 1];
    return row[node - 1] + inserted_share * (row[node] - row[node - 1]);
  }
};

/// All sizes at the nodes of a grid: [size][angle][wavelength].
LargeVector<float> evaluate_all(const Interpolations& rows, const WavelengthGrid& grid,
                                const Angles& angles) {
  const int sizes = static_cast<int>(rows.size()), count = grid.count();
  LargeVector<float> values(static_cast<std::size_t>(sizes) * angles.count() * count);
  constexpr int block = 16;  // wavelengths at a time: a cache line of the result
  const int blocks = (count + block - 1) / block;
  tbb::parallel_for(0, sizes * blocks, [&](int job) {
    const int size = job / blocks, first = job % blocks * block;
    const int width = std::min(block, count - first);
    std::vector<std::vector<float>> part(width, std::vector<float>(angles.table_count()));
    for (int k = 0; k < width; ++k) rows[size]->evaluate(grid.wavelength_nm(first + k), part[k]);
    float* out = values.data() + static_cast<std::size_t>(size) * angles.count() * count + first;
    for (int i = 0; i < angles.count(); ++i, out += count)
      for (int k = 0; k < width; ++k) out[k] = angles.value(part[k].data(), i);
  });
  return values;
}

}  // namespace

SphereTable::SphereTable(const ScatteringTable& table, const SphereTableOptions& options)
    : size_count_(static_cast<int>(table.size_um.size())) {
  assert(size_count_ >= 1 && !table.wavelength_nm.empty());
  const Angles angle_nodes(table.scattering_angle_deg);
  set_angles(angle_nodes.deg);
  const int angles = angle_count();
  Interpolations rows(size_count_);
  tbb::parallel_for(0, size_count_, [&](int size) {
    rows[size] =
        std::make_unique<const WavelengthInterpolation>(table, size, options.clip_forward_lobe);
  });

  const bool sunlit = options.sun_angular_radius_rad > 0;
  int count = options.wavelength_nodes;
  if (table.wavelength_nm.size() == 1) {
    count = 2;
  } else if (count == 0) {
    const std::size_t rows_held = static_cast<std::size_t>(size_count_) * angles;
    const std::size_t sunlit_bytes = sunlit ? rows_held * most_sunlit_nodes * sizeof(float) : 0;
    const std::size_t bytes_per_node =
        rows_held * (sizeof(float) + sizeof(std::uint32_t)) +
        static_cast<std::size_t>(size_count_) * draw_cells * sizeof(std::uint16_t);
    const std::size_t room = options.largest_memory_bytes - std::min(options.largest_memory_bytes, sunlit_bytes);
    count = std::max(fewest_nodes, std::min(accurate_node_count(table, rows),
                                            static_cast<int>(room / bytes_per_node)));
  }
  assert(count >= 2);
  plain_.grid = grid_over(table, count);
  plain_.values = evaluate_all(rows, plain_.grid, angle_nodes);
  normalise(plain_);

  const std::size_t draw_rows = static_cast<std::size_t>(size_count_) * count;
  cumulative_.resize(draw_rows * angles);
  draw_guide_.resize(draw_rows * draw_cells);
  tbb::parallel_for(0, size_count_, [this](int size) { make_cumulative(size); });

  if (sunlit) {
    sunlit_.grid = grid_over(table, std::min(count, most_sunlit_nodes));
    const DiscConvolution mean_over_disc(angle_nodes.deg,
                                         DiscProfile(options.sun_angular_radius_rad, options.disc));
    const LargeVector<float> point_sun = evaluate_all(rows, sunlit_.grid, angle_nodes);
    sunlit_.values.resize(point_sun.size());
    mean_over_disc.apply(point_sun, size_count_, sunlit_.grid, sunlit_.values);
    // The mean over the disc keeps the integral, and its linear interpolant does so only nearly.
    normalise(sunlit_);
  }
}

void SphereTable::set_angles(const std::vector<double>& angle_deg) {
  assert(angle_deg.size() >= 3 && angle_deg.size() < 65536);
  assert(angle_deg.front() == 0 && angle_deg.back() == 180);
  for (const double deg : angle_deg)
    angles_.push_back(deg == 0     ? HalfAngle{0, 1}
                      : deg == 90  ? HalfAngle{0.5, 0.5}
                      : deg == 180 ? HalfAngle{1, 0}
                                   : half_angle_of_rad(radians(deg)));
  int behind = 0;  // the first interval beyond 90°
  for (std::size_t i = 0; i + 1 < angles_.size(); ++i) {
    const HalfAngle a = angles_[i], b = angles_[i + 1];
    const bool forward = angle_deg[i] < 90;
    behind += forward;
    const double low = forward ? a.sin2 : -a.cos2, high = forward ? b.sin2 : -b.cos2;
    assert(high > low);
    intervals_.push_back({low, high, 1 / (high - low)});
  }
  // A little above every key, so that the search for straight back ends here.
  intervals_.back().high = std::numeric_limits<double>::min();

  // Cells begin a hundredth early, because they are computed in single precision.
  angle_guide_.resize(2 * angle_cells);
  int node = 0;
  for (int cell = 0; cell < angle_cells; ++cell) {
    const double sine = std::fmax(0.0, (cell - 0.01) / cells_per_sine);
    while (intervals_[node].high <= sine * sine && node + 1 < behind) ++node;
    angle_guide_[cell] = static_cast<std::uint16_t>(node);
  }
  node = behind;
  for (int cell = angle_cells; cell < 2 * angle_cells; ++cell) {
    const double cosine = (2 * angle_cells - cell + 0.01) / cells_per_sine;
    while (intervals_[node].high <= -cosine * cosine) ++node;
    angle_guide_[cell] = static_cast<std::uint16_t>(node);
  }
}

void SphereTable::normalise(Layer& layer) const {
  const int count = layer.grid.count();
  tbb::parallel_for(0, size_count_, [&](int size) {
    std::vector<double> scale(count, 0.0);
    for (int i = 0; i + 1 < angle_count(); ++i) {
      const float* lower = layer.values.data() + row(layer.grid, size, i);
      const float* upper = lower + count;
      // dΩ = 4π ds; exact for a value linear in s.
      const double weight = 2 * pi * intervals_[i].width();
      for (int k = 0; k < count; ++k)
        scale[k] += weight * (static_cast<double>(lower[k]) + upper[k]);
    }
    for (double& s : scale) s = 1 / s;
    for (int i = 0; i < angle_count(); ++i) {
      float* values = layer.values.data() + row(layer.grid, size, i);
      for (int k = 0; k < count; ++k) values[k] = static_cast<float>(values[k] * scale[k]);
    }
  });
}

void SphereTable::make_cumulative(int size) {
  const int angles = angle_count(), count = plain_.grid.count();
  // In the order of the values, all wavelengths of an angle together; transposed afterwards.
  std::vector<double> sums(static_cast<std::size_t>(angles) * count);
  for (int i = 0; i + 1 < angles; ++i) {
    const float* lower = plain_.values.data() + row(plain_.grid, size, i);
    const float* upper = lower + count;
    const double* before = sums.data() + static_cast<std::size_t>(i) * count;
    double* after = sums.data() + static_cast<std::size_t>(i + 1) * count;
    for (int k = 0; k < count; ++k)
      after[k] = before[k] + intervals_[i].width() * (static_cast<double>(lower[k]) + upper[k]);
  }
  const double* totals = sums.data() + static_cast<std::size_t>(angles - 1) * count;
  for (int k = 0; k < count; ++k) {
    const std::size_t draw_row = static_cast<std::size_t>(size) * count + k;
    std::uint32_t* cumulative = cumulative_.data() + draw_row * angles;
    const double scale = whole / totals[k];
    for (int i = 0; i < angles; ++i)
      cumulative[i] = static_cast<std::uint32_t>(
          std::fmin(whole, sums[static_cast<std::size_t>(i) * count + k] * scale + 0.5));
    cumulative[angles - 1] = static_cast<std::uint32_t>(whole);
    std::uint16_t* guide = draw_guide_.data() + draw_row * draw_cells;
    int node = 0;
    for (int cell = 0; cell < draw_cells; ++cell) {
      while (cumulative[node + 1] <= static_cast<std::uint32_t>(cell) << draw_cell_shift) ++node;
      guide[cell] = static_cast<std::uint16_t>(node);
    }
  }
}

}  // namespace arcus::phase
