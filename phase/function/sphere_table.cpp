#include "phase/function/sphere_table.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "phase/function/wavelength_interpolation.h"

namespace arcus::phase {

namespace {

// Cells of an angle guide: uniform in sin(θ/2) from 0 to 90°, about 0.02° each; the same in cos(θ/2) behind. One more
// takes what rounding lifts beyond 90°.
constexpr int angle_cells = 4096;
constexpr float cells_per_sine = 5792.6f;  // below angle_cells·√2
// Cells of a draw guide, uniform in probability: the leading bits of a number of 32 bits.
constexpr int draw_guide_bits = 9, draw_cells = 1 << draw_guide_bits, draw_guide_shift = 32 - draw_guide_bits;
constexpr double whole = 4294967295.0;  // probability 1 in units of the cumulative

}  // namespace

struct SphereTable::Place {
  int node;     // the lower one
  float share;  // of the upper one, in [0, 1]
};

struct SphereTable::Columns {
  int node[arcus::wavelength_count];  // the lower one, so that node + 1 exists
  Spectrum share;                     // of the upper one, in [0, 1]
};

SphereTable::SphereTable(const ScatteringTable& table, const SphereTableOptions& options) {
  FineRows rows = interpolate_wavelengths(table, options.clip_forward_lobe, options.wavelength_step_nm);
  size_count_ = static_cast<int>(table.size_um.size());
  wavelength_count_ = rows.wavelength_count;
  first_wavelength_nm_ = rows.first_wavelength_nm;
  wavelength_step_nm_ = rows.step_nm;
  value_ = std::move(rows.value_per_sr);
  set_angles(table.scattering_angle_deg);
  make_cumulative();
}

void SphereTable::set_angles(const std::vector<double>& angle_deg) {
  assert(angle_deg.size() >= 2 && angle_deg.size() < 65536 && angle_deg.front() == 0 && angle_deg.back() == 180);
  for (const double deg : angle_deg) {
    const HalfAngle angle = half_angle_of_rad(radians(deg));
    nodes_.push_back({angle.sin2, angle.cos2, 0, 0});
  }
  nodes_.front() = {0, 1, 0, 0};
  nodes_.back() = {1, 0, 0, 0};
  for (std::size_t i = 0; i + 1 < nodes_.size(); ++i) {
    nodes_[i].width = nodes_[i].sin2 < 0.5 ? nodes_[i + 1].sin2 - nodes_[i].sin2 : nodes_[i].cos2 - nodes_[i + 1].cos2;
    assert(nodes_[i].width > 0);
    nodes_[i].per_width = 1 / nodes_[i].width;
  }
  // Guides begin a little early (a hundredth of a cell), because the cell is computed in single precision.
  forward_guide_.resize(angle_cells + 1);
  backward_guide_.resize(angle_cells + 1);
  int node = 0;
  for (int cell = 0; cell <= angle_cells; ++cell) {
    const double sine = std::fmax(0.0, (cell - 0.01) / cells_per_sine);
    while (nodes_[node + 1].sin2 <= sine * sine && node + 2 < angle_count()) ++node;
    forward_guide_[cell] = static_cast<std::uint16_t>(node);
  }
  node = 0;
  for (int cell = angle_cells; cell >= 0; --cell) {
    const double cosine = (cell + 1.01) / cells_per_sine;
    while (nodes_[node + 1].cos2 >= cosine * cosine && node + 2 < angle_count()) ++node;
    backward_guide_[cell] = static_cast<std::uint16_t>(node);
  }
}

SphereTable::Place SphereTable::place_of(const HalfAngle& angle) const {
  if (angle.sin2 < 0.5) {
    int node = forward_guide_[static_cast<int>(std::sqrt(static_cast<float>(angle.sin2)) * cells_per_sine)];
    while (angle.sin2 >= nodes_[node + 1].sin2) ++node;
    return {node, static_cast<float>((angle.sin2 - nodes_[node].sin2) * nodes_[node].per_width)};
  }
  int node = backward_guide_[static_cast<int>(std::sqrt(static_cast<float>(angle.cos2)) * cells_per_sine)];
  while (angle.cos2 < nodes_[node + 1].cos2) ++node;
  return {node, static_cast<float>((nodes_[node].cos2 - angle.cos2) * nodes_[node].per_width)};
}

SphereTable::Columns SphereTable::columns_of(const Wavelengths& wavelengths) const {
  const float first = static_cast<float>(first_wavelength_nm_), per_nm = static_cast<float>(1 / wavelength_step_nm_);
  const float last = static_cast<float>(wavelength_count_ - 1);
  Columns columns;
  for (int i = 0; i < arcus::wavelength_count; ++i) {
    const float x = std::min(std::max((wavelengths[i] - first) * per_nm, 0.0f), last);
    columns.node[i] = std::min(static_cast<int>(x), wavelength_count_ - 2);
    columns.share[i] = x - static_cast<float>(columns.node[i]);
  }
  return columns;
}

Spectrum SphereTable::read(const std::vector<float>& values, int size, const Place& place,
                           const Columns& columns) const {
  const float* lower = values.data() + index(size, place.node);
  const float* upper = lower + wavelength_count_;
  const int* k = columns.node;
  const Spectrum a(lower[k[0]], lower[k[1]], lower[k[2]], lower[k[3]]);
  const Spectrum b(lower[k[0] + 1], lower[k[1] + 1], lower[k[2] + 1], lower[k[3] + 1]);
  const Spectrum c(upper[k[0]], upper[k[1]], upper[k[2]], upper[k[3]]);
  const Spectrum d(upper[k[0] + 1], upper[k[1] + 1], upper[k[2] + 1], upper[k[3] + 1]);
  const Spectrum at_lower = a + (b - a) * columns.share, at_upper = c + (d - c) * columns.share;
  return at_lower + (at_upper - at_lower) * place.share;
}

Spectrum SphereTable::value_per_sr(int size, const HalfAngle& angle, const Wavelengths& wavelengths) const {
  return read(value_, size, place_of(angle), columns_of(wavelengths));
}

Spectrum SphereTable::sunlit_value_per_sr(int size, const HalfAngle& angle, const Wavelengths& wavelengths) const {
  return read(sunlit_, size, place_of(angle), columns_of(wavelengths));
}

void SphereTable::make_cumulative() {
  const std::size_t rows = static_cast<std::size_t>(size_count_) * wavelength_count_;
  cumulative_.resize(rows * nodes_.size());
  draw_guide_.resize(rows * draw_cells);
  tbb::parallel_for(0, size_count_, [this](int size) { make_cumulative(size); });
}

void SphereTable::make_cumulative(int size) {
  const int angles = angle_count(), wavelengths = wavelength_count_;
  // All wavelengths of an angle together, as the values lie.
  std::vector<double> sums(static_cast<std::size_t>(angles) * wavelengths);
  for (int i = 0; i + 1 < angles; ++i) {
    const float* lower = value_.data() + index(size, i);
    const float* upper = lower + wavelengths;
    const double* before = sums.data() + static_cast<std::size_t>(i) * wavelengths;
    double* after = sums.data() + static_cast<std::size_t>(i + 1) * wavelengths;
    for (int k = 0; k < wavelengths; ++k)
      after[k] = before[k] + nodes_[i].width * (static_cast<double>(lower[k]) + upper[k]);
  }
  const double* totals = sums.data() + static_cast<std::size_t>(angles - 1) * wavelengths;
  for (int k = 0; k < wavelengths; ++k) {
    const std::size_t row = static_cast<std::size_t>(size) * wavelengths + k;
    std::uint32_t* cumulative = cumulative_.data() + row * angles;
    const double scale = whole / totals[k];
    for (int i = 0; i < angles; ++i)
      cumulative[i] = static_cast<std::uint32_t>(std::fmin(whole, sums[static_cast<std::size_t>(i) * wavelengths + k] * scale + 0.5));
    cumulative[angles - 1] = static_cast<std::uint32_t>(whole);
    std::uint16_t* guide = draw_guide_.data() + row * draw_cells;
    int node = 0;
    for (int cell = 0; cell < draw_cells; ++cell) {
      while (cumulative[node + 1] <= static_cast<std::uint32_t>(cell) << draw_guide_shift) ++node;
      guide[cell] = static_cast<std::uint16_t>(node);
    }
  }
}

SphereTable::AngleDraw SphereTable::draw(int size, const Wavelengths& wavelengths, Random& random) const {
  // The value at the hero's wavelength is a mixture of its two neighbours on the fine grid: choose one, draw from it.
  const Columns columns = columns_of(wavelengths);
  const int column = columns.node[0] + (random.uniform() < columns.share[0] ? 1 : 0);
  const std::size_t row = static_cast<std::size_t>(size) * wavelength_count_ + column;

  // The 32 leading bits find the interval, what is left of 53 keeps the angle continuous within narrow ones.
  const double position = random.uniform_double() * whole;
  const auto leading = static_cast<std::uint32_t>(position);
  const std::uint32_t* cumulative = cumulative_.data() + row * nodes_.size();
  int node = draw_guide_[row * draw_cells + (leading >> draw_guide_shift)];
  while (leading >= cumulative[node + 1]) ++node;
  const double share = (position - cumulative[node]) / (cumulative[node + 1] - cumulative[node]);

  // Inverse of the quadratic cumulative of a linear density from a to b, in the form without cancellation.
  const double a = value_[index(size, node) + column], b = value_[index(size, node + 1) + column];
  const double t = share * (a + b) / (a + std::sqrt((1 - share) * a * a + share * b * b));

  const Node& n = nodes_[node];
  AngleDraw drawn;
  if (n.sin2 < 0.5) {
    drawn.angle.sin2 = n.sin2 + t * n.width;
    drawn.angle.cos2 = 1 - drawn.angle.sin2;
  } else {
    drawn.angle.cos2 = std::fmax(0.0, n.cos2 - t * n.width);
    drawn.angle.sin2 = 1 - drawn.angle.cos2;
  }
  drawn.value_per_sr = read(value_, size, {node, static_cast<float>(t)}, columns);
  return drawn;
}

double SphereTable::asymmetry(int size, int wavelength_node) const {
  // ∫ p cos θ dΩ with dΩ = 4π ds, cos θ = 1 − 2s; exact for p linear in s between the nodes.
  double sum = 0;
  for (int i = 0; i + 1 < angle_count(); ++i) {
    const double a = node_value_per_sr(size, i, wavelength_node), b = node_value_per_sr(size, i + 1, wavelength_node);
    const double lower = nodes_[i].cos2 - nodes_[i].sin2, upper = nodes_[i + 1].cos2 - nodes_[i + 1].sin2;
    sum += 4 * pi * nodes_[i].width * (lower * (2 * a + b) + upper * (a + 2 * b)) / 6;
  }
  return sum;
}

std::size_t SphereTable::memory_bytes() const {
  return (value_.size() + sunlit_.size()) * sizeof(float) + cumulative_.size() * sizeof(std::uint32_t) +
         (draw_guide_.size() + forward_guide_.size() + backward_guide_.size()) * sizeof(std::uint16_t) +
         nodes_.size() * sizeof(Node);
}

}  // namespace arcus::phase
