#pragma once
// A matte surface: reflects the same radiance in all directions (Lambert), in one colour or in the squares of a chequerboard.

#include <algorithm>
#include <cmath>

#include "phase/base/frame.h"
#include "phase/base/random.h"
#include "src/material/smooth_spectrum.h"

namespace arcus::render {

class Matte {
 public:
  /// Of one colour.
  explicit Matte(const SmoothSpectrum& albedo) : albedo_(albedo), other_(albedo) {}
  explicit Matte(double albedo) : Matte(SmoothSpectrum(albedo)) {}
  /// Cubes of that edge, by turns of one colour and the other, with a corner at the origin.
  Matte(const SmoothSpectrum& albedo, const SmoothSpectrum& other, double edge_m)
      : albedo_(albedo), other_(other), per_edge_(1 / edge_m) {}

  /// Share of the light that is reflected.
  const SmoothSpectrum& albedo_at(const Vec3& position_m) const {
    if (per_edge_ == 0) return albedo_;
    // Half a millionth of an edge aside, so that a wall along the faces of cubes is not torn between two.
    const auto cell = [&](double x) { return static_cast<long long>(std::floor(x * per_edge_ + 0.5e-6)); };
    return (cell(position_m.x) + cell(position_m.y) + cell(position_m.z)) % 2 == 0 ? albedo_ : other_;
  }
  /// Reflected radiance per irradiance [1/sr] for light to a direction `away` (unit); 0 behind the surface.
  Spectrum value_per_sr(const Vec3& position_m, const Vec3& normal, const Vec3& away, const Wavelengths& wavelengths) const {
    if (!(dot(normal, away) > 0)) return {};
    return albedo_at(position_m).at(wavelengths) * static_cast<float>(1 / pi);
  }
  /// Density of draw() [1/sr]: cosine over pi.
  static double density_per_sr(const Vec3& normal, const Vec3& away) { return std::max(0.0, dot(normal, away)) / pi; }
  /// A direction away from the surface with density cosine over pi; u, v in [0, 1).
  static Vec3 draw(const Vec3& normal, double u, double v) {
    const double sine = std::sqrt(u), phi = 2 * pi * v;
    return frame_around(normal).to_world(sine * std::cos(phi), sine * std::sin(phi), std::sqrt(1 - u));
  }

 private:
  SmoothSpectrum albedo_, other_;
  double per_edge_ = 0;  // 0: one colour
};

/// A matte surface at a place: what spreads light can be asked for values, densities and draws.
struct MatteLobe {
  const Matte& matte;
  const Vec3 &position_m, &normal;
  const Wavelengths& wavelengths;

  Spectrum value_per_sr(const Vec3& away) const { return matte.value_per_sr(position_m, normal, away, wavelengths); }
  double density_per_sr(const Vec3& away) const { return Matte::density_per_sr(normal, away); }
  Vec3 draw(Random& random) const { return Matte::draw(normal, random.uniform_double(), random.uniform_double()); }
};

}  // namespace arcus::render
