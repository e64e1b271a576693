#pragma once
// Values at the wavelengths that the sky is tabulated at, side by side.

#include <array>
#include <cmath>

#include "phase/base/quick_math.h"
#include "phase/base/wavelengths.h"

namespace arcus::media {

/// Evenly spread in the logarithm: light of air goes with powers of the wavelength, and what is linear between nodes is within 0.4 % there.
inline constexpr int sky_lane_count = 16;

struct SkyLanes {
  alignas(64) std::array<float, sky_lane_count> at{};

  float& operator[](int i) { return at[static_cast<std::size_t>(i)]; }
  float operator[](int i) const { return at[static_cast<std::size_t>(i)]; }
  SkyLanes& operator+=(const SkyLanes& b) {
    for (int i = 0; i < sky_lane_count; ++i) (*this)[i] += b[i];
    return *this;
  }
  /// this += a * b
  void add(const SkyLanes& a, const SkyLanes& b) {
    for (int i = 0; i < sky_lane_count; ++i) (*this)[i] += a[i] * b[i];
  }
  void add(float a, const SkyLanes& b) {
    for (int i = 0; i < sky_lane_count; ++i) (*this)[i] += a * b[i];
  }
  friend SkyLanes operator*(const SkyLanes& a, const SkyLanes& b) {
    SkyLanes result;
    for (int i = 0; i < sky_lane_count; ++i) result[i] = a[i] * b[i];
    return result;
  }
  friend SkyLanes operator*(float a, const SkyLanes& b) {
    SkyLanes result;
    for (int i = 0; i < sky_lane_count; ++i) result[i] = a * b[i];
    return result;
  }
};

/// exp(−depth)
inline SkyLanes transmittance(const SkyLanes& depth) {
  SkyLanes result;
  for (int i = 0; i < sky_lane_count; ++i) result[i] = quick_exponential(-depth[i]);
  return result;
}

/// What is left of light on its way through steps.
struct Dimming {
  SkyLanes left;
  Dimming() { left.at.fill(1); }
  /// Passes a step of that depth. What is left of the light of evenly spread sources in it, as a mean: (1 − exp(−depth)) / depth of what was left before.
  SkyLanes step(const SkyLanes& depth) {
    const SkyLanes through = transmittance(depth);
    SkyLanes mean;
    for (int i = 0; i < sky_lane_count; ++i) mean[i] = left[i] * (depth[i] > 1e-3f ? (1 - through[i]) / depth[i] : 1 - 0.5f * depth[i]);
    left = left * through;
    return mean;
  }
};

inline double sky_wavelength_nm(int lane) {
  return shortest_wavelength_nm * std::pow(longest_wavelength_nm / shortest_wavelength_nm, lane / static_cast<double>(sky_lane_count - 1));
}

}  // namespace arcus::media
