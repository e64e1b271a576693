#include "phase/function/sphere_table.h"

#include <cassert>
#include <cmath>

#include "phase/function/sphere_table_guides.h"

namespace arcus::phase {

struct SphereTable::Place {
  int node;     // the lower one
  float share;  // of the upper one, in [0, 1]
};

struct SphereTable::Columns {
  int node[wavelength_count];  // the lower one; node + 1 exists
  Spectrum share;              // of the upper one, in [0, 1]
};

SphereTable::Place SphereTable::place_of(const HalfAngle& angle) const {
  // On either side the half angle that keeps its digits.
  if (angle.sin2 < 0.5) {
    int node = forward_guide_[angle_cell(angle.sin2)];
    while (angle.sin2 >= nodes_[node + 1].sin2) ++node;
    return {node, static_cast<float>((angle.sin2 - nodes_[node].sin2) * nodes_[node].per_width)};
  }
  int node = backward_guide_[angle_cell(angle.cos2)];
  while (angle.cos2 < nodes_[node + 1].cos2) ++node;
  return {node, static_cast<float>((nodes_[node].cos2 - angle.cos2) * nodes_[node].per_width)};
}

SphereTable::Columns SphereTable::columns_of(const WavelengthGrid& grid,
                                             const Wavelengths& wavelengths) {
  Columns columns;
  for (int i = 0; i < wavelength_count; ++i) {
    const float position = grid.position(wavelengths[i]);
    columns.node[i] = std::min(static_cast<int>(position), grid.count() - 2);
    columns.share[i] = position - static_cast<float>(columns.node[i]);
  }
  return columns;
}

Spectrum SphereTable::read(const Layer& layer, int size, const Place& place,
                           const Columns& columns) const {
  const float* lower = layer.values.data() + row(layer.grid, size, place.node);
  const float* upper = lower + layer.grid.count();
  const int* k = columns.node;
  const Spectrum a(lower[k[0]], lower[k[1]], lower[k[2]], lower[k[3]]);
  const Spectrum b(lower[k[0] + 1], lower[k[1] + 1], lower[k[2] + 1], lower[k[3] + 1]);
  const Spectrum c(upper[k[0]], upper[k[1]], upper[k[2]], upper[k[3]]);
  const Spectrum d(upper[k[0] + 1], upper[k[1] + 1], upper[k[2] + 1], upper[k[3] + 1]);
  const Spectrum at_lower = a + (b - a) * columns.share, at_upper = c + (d - c) * columns.share;
  return at_lower + (at_upper - at_lower) * place.share;
}

Spectrum SphereTable::value_per_sr(int size, const HalfAngle& angle,
                                   const Wavelengths& wavelengths) const {
  return read(plain_, size, place_of(angle), columns_of(plain_.grid, wavelengths));
}

Spectrum SphereTable::sunlit_value_per_sr(int size, const HalfAngle& angle,
                                          const Wavelengths& wavelengths) const {
  assert(includes_sun_disc());
  return read(sunlit_, size, place_of(angle), columns_of(sunlit_.grid, wavelengths));
}

SphereTable::AngleDraw SphereTable::draw(int size, const Wavelengths& wavelengths,
                                         Random& random) const {
  // The value at the first wavelength is a mixture of two neighbours on the fine grid: choose one of
  // them, draw from it.
  const Columns columns = columns_of(plain_.grid, wavelengths);
  const int column = columns.node[0] + (random.uniform() < columns.share[0] ? 1 : 0);
  const std::size_t draw_row = static_cast<std::size_t>(size) * plain_.grid.count() + column;

  // The leading 32 bits find the interval; the rest of 53 keeps the angle continuous in narrow ones.
  const double position = random.uniform_double() * whole;
  const auto leading = static_cast<std::uint32_t>(position);
  const std::uint32_t* cumulative = cumulative_.data() + draw_row * nodes_.size();
  int node = draw_guide_[draw_row * draw_cells + (leading >> draw_cell_shift)];
  while (leading >= cumulative[node + 1]) ++node;
  const double share =
      (position - cumulative[node]) / (cumulative[node + 1] - cumulative[node]);

  // Inverse of the quadratic cumulative of a density linear from a to b, without cancellation.
  const double a = plain_.values[row(plain_.grid, size, node) + column];
  const double b = plain_.values[row(plain_.grid, size, node + 1) + column];
  const double t = share * (a + b) / (a + std::sqrt((1 - share) * a * a + share * b * b));

  const Node& n = nodes_[node];
  AngleDraw drawn;
  if (n.sin2 < 0.5) {
    drawn.angle.sin2 = std::fmin(1.0, n.sin2 + t * n.width);
    drawn.angle.cos2 = 1 - drawn.angle.sin2;
  } else {
    drawn.angle.cos2 = std::fmax(0.0, n.cos2 - t * n.width);
    drawn.angle.sin2 = 1 - drawn.angle.cos2;
  }
  drawn.value_per_sr = read(plain_, size, {node, static_cast<float>(t)}, columns);
  return drawn;
}

double SphereTable::asymmetry(int size, int wavelength_node) const {
  // ∫ p cos θ dΩ with dΩ = 4π ds, cos θ = 1 − 2s; exact for p linear in s between the nodes.
  double sum = 0;
  for (int i = 0; i + 1 < angle_count(); ++i) {
    const double a = plain_.values[row(plain_.grid, size, i) + wavelength_node];
    const double b = plain_.values[row(plain_.grid, size, i + 1) + wavelength_node];
    const double lower = angle(i).cosine(), upper = angle(i + 1).cosine();
    sum += 4 * pi * nodes_[i].width * (lower * (2 * a + b) + upper * (a + 2 * b)) / 6;
  }
  return sum;
}

std::size_t SphereTable::memory_bytes() const {
  return (plain_.values.size() + sunlit_.values.size()) * sizeof(float) +
         cumulative_.size() * sizeof(std::uint32_t) +
         (draw_guide_.size() + forward_guide_.size() + backward_guide_.size()) *
             sizeof(std::uint16_t) +
         nodes_.size() * sizeof(Node);
}

}  // namespace arcus::phase
