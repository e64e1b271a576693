#pragma once
// Numbers in two bytes, for large tables: 11 significant bits, from 6e-5 to 65504; smaller ones lose digits, larger ones become
// the largest.

#include <Imath/half.h>

#include <algorithm>
#include <cstdint>

namespace arcus {

inline std::uint16_t half_bits(float x) { return imath_float_to_half(std::min(x, 65504.f)); }
inline float float_of_half(std::uint16_t bits) { return imath_half_to_float(bits); }

}  // namespace arcus
