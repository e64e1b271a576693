#pragma once
// Fractal noise for clouds and rain: smooth, reproducible from a seed, the same on every machine.

#include <cstdint>

#include "phase/base/vec3.h"

namespace arcus::media {

/// Gradient noise on the integer lattice (Perlin, "Improving Noise", SIGGRAPH 2002, with hashed gradients): smooth, about
/// −1 to 1, mean 0, root mean square about 0.28, features of size 1. Uses additions and multiplications only.
double gradient_noise(const Vec3& position, std::uint32_t seed);

/// Sum of `octaves` ≥ 1 of gradient noise, each of half the size and `gain` times the strength of the one before, scaled
/// to a root mean square of about 1.
double fractal_noise(const Vec3& position, int octaves, double gain, std::uint32_t seed);

}  // namespace arcus::media
