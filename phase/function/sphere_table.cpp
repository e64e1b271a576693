#include "phase/function/sphere_table.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>

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

namespace {

/// Two neighbouring values from each of four places: the first of each pair, and the second.
struct Neighbours {
  Spectrum first, second;
};

inline Neighbours neighbours(const float* values, const int* places) {
  // Eight bytes at a time: half of the loads that single values would take.
  typedef double Pairs __attribute__((vector_size(16)));
  typedef int Index __attribute__((vector_size(16)));
  const auto pair = [&](int i) {
    double two;
    std::memcpy(&two, values + places[i], sizeof two);
    return two;
  };
  const auto a = reinterpret_cast<Spectrum::Lanes>(Pairs{pair(0), pair(1)});
  const auto b = reinterpret_cast<Spectrum::Lanes>(Pairs{pair(2), pair(3)});
  return {__builtin_shuffle(a, b, Index{0, 2, 4, 6}), __builtin_shuffle(a, b, Index{1, 3, 5, 7})};
}

}  // namespace

SphereTable::Place SphereTable::place_of(const HalfAngle& angle) const {
  // Written so that no jump depends on the angle, but for the rare walk over more than two nodes.
  constexpr double almost_half = 0.5 - 0x1p-54;  // rounding must not lift a key beyond its side
  const double half = std::min(std::min(angle.sin2, angle.cos2), almost_half);
  const double key = -std::copysign(half, angle.sin2 - angle.cos2);
  const auto backward = static_cast<int>(std::bit_cast<std::int64_t>(key) >> 63);  // 0 or −1
  int node = angle_guide_[cell_from_end(half) ^ (backward & (2 * angle_cells - 1))];
  node += key >= intervals_[node].high;
  node += key >= intervals_[node].high;
  while (key >= intervals_[node].high) ++node;
  const Interval& interval = intervals_[node];
  return {node, static_cast<float>((key - interval.low) * interval.per_width)};
}

SphereTable::Columns SphereTable::columns_of(const WavelengthGrid& grid,
                                             const Wavelengths& wavelengths) {
  const Spectrum position = grid.positions(wavelengths);
  typedef int Ints __attribute__((vector_size(16)));
  const int last = grid.count() - 2;
  Ints node = __builtin_convertvector(position.lanes, Ints);
  node = node < last ? node : last - Ints{};
  Columns columns;
  columns.share = position.lanes - __builtin_convertvector(node, Spectrum::Lanes);
  std::memcpy(columns.node, &node, sizeof node);
  return columns;
}

Spectrum SphereTable::read(const Layer& layer, int size, const Place& place,
                           const Columns& columns) const {
  const float* values = layer.values.data() + row(layer.grid, size, place.node);
  const Neighbours lower = neighbours(values, columns.node);
  const Neighbours upper = neighbours(values + layer.grid.count(), columns.node);
  const Spectrum at_lower = lower.first + (lower.second - lower.first) * columns.share;
  const Spectrum at_upper = upper.first + (upper.second - upper.first) * columns.share;
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
  // Of the 53 bits of one number the leading 32 find the interval, the others choose the row: the
  // value at the first wavelength is a mixture of two neighbours on the fine grid. What is left of
  // them, scaled up again, keeps the angle continuous within narrow intervals.
  const double number = random.uniform_double() * 0x1p32;
  const auto leading_bits = static_cast<std::uint32_t>(number);
  const Columns columns = columns_of(plain_.grid, wavelengths);
  double rest = number - leading_bits;
  const double upper_share = columns.share[0];
  const bool upper = rest < upper_share;
  rest = upper ? rest / upper_share : (rest - upper_share) / (1 - upper_share);
  const int column = columns.node[0] + upper;
  const std::size_t draw_row = static_cast<std::size_t>(size) * plain_.grid.count() + column;

  const double position = (leading_bits + rest) * (whole / 0x1p32);
  const auto leading = static_cast<std::uint32_t>(position);
  const std::uint32_t* cumulative = cumulative_.data() + draw_row * angles_.size();
  int node = draw_guide_[draw_row * draw_cells + (leading >> draw_cell_shift)];
  // The values lie nearby: have them come while the interval is looked for.
  const float* nearby = plain_.values.data() + row(plain_.grid, size, node);
  for (const int k : columns.node) {
    __builtin_prefetch(nearby + k);
    __builtin_prefetch(nearby + plain_.grid.count() + k);
  }
  while (leading >= cumulative[node + 1]) ++node;
  const double share = (position - cumulative[node]) / (cumulative[node + 1] - cumulative[node]);

  // Inverse of the quadratic cumulative of a density linear from a to b, without cancellation.
  const float* values = plain_.values.data() + row(plain_.grid, size, node) + column;
  const double a = values[0], b = values[plain_.grid.count()];
  const double t =
      std::fmin(1.0, share * (a + b) / (a + std::sqrt((1 - share) * a * a + share * b * b)));

  const Interval& interval = intervals_[node];
  const double key = interval.low + t * interval.width();
  AngleDraw drawn;
  drawn.angle = interval.low >= 0 ? HalfAngle{key, 1 - key}
                                  : HalfAngle{1 + key, std::fmax(0.0, -key)};
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
    sum += 4 * pi * intervals_[i].width() * (lower * (2 * a + b) + upper * (a + 2 * b)) / 6;
  }
  return sum;
}

std::size_t SphereTable::memory_bytes() const {
  return (plain_.values.size() + sunlit_.values.size()) * sizeof(float) +
         cumulative_.size() * sizeof(std::uint32_t) +
         (draw_guide_.size() + angle_guide_.size()) * sizeof(std::uint16_t) +
         angles_.size() * sizeof(HalfAngle) + intervals_.size() * sizeof(Interval);
}

}  // namespace arcus::phase
