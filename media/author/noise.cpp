#include "media/author/noise.h"

#include <cmath>

namespace arcus::media {
namespace {

std::uint32_t hash(std::int64_t x, std::int64_t y, std::int64_t z, std::uint32_t seed) {
  std::uint64_t h = seed;
  for (const std::int64_t c : {x, y, z}) {
    h ^= static_cast<std::uint64_t>(c) + 0x9e3779b97f4a7c15u + (h << 6) + (h >> 2);
    h *= 0xbf58476d1ce4e5b9u;
    h ^= h >> 29;
  }
  return static_cast<std::uint32_t>(h >> 32);
}

/// Perlin's twelve gradients, the middles of a cube's edges, four of them twice.
double gradient(std::uint32_t h, double x, double y, double z) {
  const std::uint32_t k = h & 15u;
  const double u = k < 8 ? x : y, v = k < 4 ? y : (k == 12 || k == 14 ? x : z);
  return ((k & 1u) ? -u : u) + ((k & 2u) ? -v : v);
}

double faded(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }
double mixed(double a, double b, double t) { return a + t * (b - a); }

}  // namespace

double gradient_noise(const Vec3& position, std::uint32_t seed) {
  const double fx = std::floor(position.x), fy = std::floor(position.y), fz = std::floor(position.z);
  const auto ix = static_cast<std::int64_t>(fx), iy = static_cast<std::int64_t>(fy), iz = static_cast<std::int64_t>(fz);
  const double x = position.x - fx, y = position.y - fy, z = position.z - fz;
  const auto corner = [&](int dx, int dy, int dz) {
    return gradient(hash(ix + dx, iy + dy, iz + dz, seed), x - dx, y - dy, z - dz);
  };
  const double u = faded(x), v = faded(y), w = faded(z);
  return mixed(mixed(mixed(corner(0, 0, 0), corner(1, 0, 0), u), mixed(corner(0, 1, 0), corner(1, 1, 0), u), v),
               mixed(mixed(corner(0, 0, 1), corner(1, 0, 1), u), mixed(corner(0, 1, 1), corner(1, 1, 1), u), v), w);
}

double fractal_noise(const Vec3& position, int octaves, double gain, std::uint32_t seed) {
  constexpr double rms_of_one = 0.28;
  double sum = 0, strength = 1, squares = 0;
  Vec3 p = position;
  for (int i = 0; i < octaves; ++i) {
    sum += strength * gradient_noise(p, seed + static_cast<std::uint32_t>(i));
    squares += strength * strength;
    strength *= gain;
    p = p * 2 + Vec3(17.13, -4.71, 9.37);  // so that the lattices' zeros do not coincide
  }
  return sum / (rms_of_one * std::sqrt(squares));
}

}  // namespace arcus::media
