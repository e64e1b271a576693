#pragma once
// Fractal noise, reproducible from a seed: gradient noise (Perlin, "Improving Noise", SIGGRAPH 2002) on a cubic lattice, with
// gradients drawn by a hash instead of a table, so that it does not repeat. Uses only sums, products and whole numbers: equal on
// every machine.

#include <cstdint>

#include "phase/base/vec3.h"

namespace arcus::media {

class Noise {
 public:
  explicit Noise(std::uint64_t seed) : seed_(seed) {}

  /// One octave: features of size 1, mean 0, within [-1, 1], zero at whole coordinates, twice differentiable.
  double at(const Vec3& p) const;

  /// Octaves of features 1, 1/2, 1/4, ... with weights 1, gain, gain², ..., scaled so that their standard deviation is
  /// about 1 whatever the number of octaves. octaves ≥ 1; gain in (0, 1], 0.5 to 0.63 for turbulence (k^(-5/3): 2^(-1/3) ≈ 0.79 of amplitude
  /// is the energy spectrum of a scalar; smaller gains look smoother).
  double fractal(const Vec3& p, int octaves, double gain) const;

 private:
  std::uint64_t seed_;
};

}  // namespace arcus::media
