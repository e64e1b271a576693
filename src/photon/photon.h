#pragma once
// A photon: a parcel of sunlight where it landed, on a matte surface or at a scattering.

#include <cstdint>

#include "phase/base/spectrum.h"
#include "phase/base/vec3.h"
#include "phase/base/wavelengths.h"
#include "src/shape/pieces.h"

namespace arcus::render {

/// A direction in single precision.
struct ShortVec {
  float x = 0, y = 0, z = 0;
  ShortVec() = default;
  explicit ShortVec(const Vec3& v) : x(static_cast<float>(v.x)), y(static_cast<float>(v.y)), z(static_cast<float>(v.z)) {}
  Vec3 full() const { return {x, y, z}; }
};

struct Photon {
  Vec3 position_m{0, 0, 0};
  ShortVec direction;          ///< unit, the way that the light went
  ShortVec normal;             ///< unit, of the surface on the side that it came from; not at scatterings
  PieceId piece;               ///< of that surface
  std::uint64_t ancestry = 0;  ///< the same for photons that met the same bodies in the same order and way
  Wavelengths wavelengths;
  /// What it brings of the sun's irradiance at its four wavelengths, times the area from which it came [m²]; in media over the
  /// extinction there [m³]. Zero at wavelengths that went elsewhere.
  Spectrum share;

  /// One wavelength alone is left: it met a body that parts them.
  bool is_alone() const { return share[1] == 0 && share[2] == 0 && share[3] == 0; }
};

static_assert(sizeof(Photon) == 96);

}  // namespace arcus::render
