#pragma once
// Where extinction of oriented crystals is tabulated: nodes over the sine of the elevation of light, closer at both ends. Where light
// grazes, the shadow of flat crystals changes within the angle of their tilt; overhead, that of their sides goes with the cosine,
// which is a square root of the distance from 1.

#include <algorithm>
#include <cmath>

namespace arcus::phase {

inline constexpr int sine_node_count = 65;

/// From 0 to 1 for i from 0 to sine_node_count − 1.
constexpr double sine_of_node(int i) {
  const double t = static_cast<double>(i) / (sine_node_count - 1);
  return t < 0.5 ? 2 * t * t : 1 - 2 * (1 - t) * (1 - t);
}

/// The node below a sine in [0, 1], at most sine_node_count − 2.
inline int node_below_sine(double sine) {
  const double t = sine < 0.5 ? std::sqrt(0.5 * sine) : 1 - std::sqrt(0.5 * (1 - sine));
  return std::min(static_cast<int>(t * (sine_node_count - 1)), sine_node_count - 2);
}

}  // namespace arcus::phase
