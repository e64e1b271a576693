#pragma once
// How the two sources of SphereTable divide angles and probabilities into cells, so that neither
// looking up an angle nor drawing one needs a long search.

#include <cmath>
#include <cstdint>

namespace arcus::phase {

/// Cells of the angle guide: uniform in sin(θ/2) from 0 to 90°, about 0.02° each, then uniform in
/// cos(θ/2) to 180°. cells_per_sine is a little below angle_cells·√2, so that 90° falls into the last
/// cell of its side.
inline constexpr int angle_cells = 4096;
inline constexpr float cells_per_sine = 5792.5f;

/// Number of a cell from its side's end: of sin²(θ/2) or cos²(θ/2), at most 1/2.
inline int cell_from_end(double half_squared) {
  return static_cast<int>(std::sqrt(static_cast<float>(half_squared)) * cells_per_sine);
}

/// Cells of a draw guide: the leading bits of a probability in units of 1/whole.
inline constexpr int draw_guide_bits = 9, draw_cells = 1 << draw_guide_bits;
inline constexpr int draw_cell_shift = 32 - draw_guide_bits;
inline constexpr double whole = 4294967295.0;

}  // namespace arcus::phase
