#pragma once
// Conversions by name. A unit changes only through one of these.

#include <numbers>

namespace arcus {

inline constexpr double pi = std::numbers::pi;

constexpr double radians(double degrees) { return degrees * (pi / 180); }
constexpr double degrees(double radians) { return radians * (180 / pi); }
constexpr double m_from_um(double um) { return um * 1e-6; }
constexpr double m_from_nm(double nm) { return nm * 1e-9; }
constexpr double um_from_nm(double nm) { return nm * 1e-3; }
constexpr double um_from_mm(double mm) { return mm * 1e3; }
constexpr double mm_from_um(double um) { return um * 1e-3; }

}  // namespace arcus
