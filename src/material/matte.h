#pragma once
// A matte surface: reflects the same radiance in all directions (Lambert), in one colour, in the squares of a chequerboard, in the colours of a picture
// or by a measured spectrum.

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "phase/base/curve.h"
#include "phase/base/frame.h"
#include "src/material/colour_map.h"
#include "phase/base/random.h"
#include "src/material/smooth_spectrum.h"

namespace arcus::render {

/// Share of the light that one place of a surface reflects, by wavelength. For as long as the surface is there.
class Albedo {
 public:
  explicit Albedo(const SmoothSpectrum& smooth) : smooth_(&smooth) {}
  explicit Albedo(const Curve& measured) : measured_(&measured) {}
  Albedo(const ThreeSpectra& basis, const std::array<float, 3>& rgb) : basis_(&basis), rgb_(rgb) {}

  /// At a vacuum wavelength [nm]; 0 to 1.
  double at(double nm) const {
    if (smooth_) return smooth_->at(nm);
    return measured_ ? (*measured_)(nm) : static_cast<double>(basis_->sum(rgb_.data(), nm));
  }
  Spectrum at(const Wavelengths& wavelengths) const {
    if (smooth_) return smooth_->at(wavelengths);
    if (basis_) return basis_->sum(rgb_.data(), wavelengths);
    Spectrum result;
    for (int i = 0; i < wavelength_count; ++i) result[i] = static_cast<float>((*measured_)(wavelengths[i]));
    return result;
  }

 private:
  const SmoothSpectrum* smooth_ = nullptr;  // either this
  const Curve* measured_ = nullptr;         // or this
  const ThreeSpectra* basis_ = nullptr;     // or this
  std::array<float, 3> rgb_{};              // with these
};

class Matte {
 public:
  /// Of one colour.
  explicit Matte(const SmoothSpectrum& albedo) : albedo_(albedo), other_(albedo) {}
  explicit Matte(double albedo) : Matte(SmoothSpectrum(albedo)) {}
  /// Cubes of that edge, by turns of one colour and the other, with a corner at the origin.
  Matte(const SmoothSpectrum& albedo, const SmoothSpectrum& other, double edge_m)
      : albedo_(albedo), other_(other), per_edge_(1 / edge_m) {}
  /// Of a picture's colours.
  explicit Matte(std::shared_ptr<const ColourMap> map) : map_(std::move(map)) {}
  /// Of a measured spectrum: share against vacuum wavelength [nm], 0 to 1.
  explicit Matte(std::shared_ptr<const Curve> measured) : measured_(std::move(measured)) {}

  /// Share of the light that is reflected.
  Albedo albedo_at(const Vec3& position_m) const {
    if (map_) return Albedo(map_->basis(), map_->at(position_m));
    if (measured_) return Albedo(*measured_);
    if (per_edge_ == 0) return Albedo(albedo_);
    // Half a millionth of an edge aside, so that a wall along the faces of cubes is not torn between two.
    const auto cell = [&](double x) { return static_cast<long long>(std::floor(x * per_edge_ + 0.5e-6)); };
    return Albedo((cell(position_m.x) + cell(position_m.y) + cell(position_m.z)) % 2 == 0 ? albedo_ : other_);
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
  std::shared_ptr<const ColourMap> map_;
  std::shared_ptr<const Curve> measured_;
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
