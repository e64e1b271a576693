#include "media/author/noise.h"

#include <cmath>

namespace arcus::media {
namespace {

/// Mixes the bits of a lattice point (the finaliser of MurmurHash3, Appleby).
std::uint64_t hash(std::uint64_t seed, std::int64_t x, std::int64_t y, std::int64_t z) {
  std::uint64_t h = seed;
  for (const std::int64_t c : {x, y, z}) {
    h ^= static_cast<std::uint64_t>(c);
    h *= 0xff51afd7ed558ccdu;
    h ^= h >> 33;
    h *= 0xc4ceb9fe1a85ec53u;
    h ^= h >> 33;
  }
  return h;
}

/// Dot product of an offset with one of the twelve gradients towards the edges of a cube.
double gradient(std::uint64_t h, double x, double y, double z) {
  const unsigned edge = static_cast<unsigned>((h >> 32) * 12 >> 32);
  const double first = edge < 8 ? x : y, second = edge < 4 ? y : z;
  return (edge & 1 ? -first : first) + (edge & 2 ? -second : second);
}

double fade(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }
double mix(double share, double a, double b) { return a + share * (b - a); }

// Standard deviation of one octave: each gradient component has the mean square 2/3, so the variance is 16 A B² with
// A = ∫ (1 − fade(t))² t² dt and B = ∫ (1 − fade(t))² dt over [0, 1].
constexpr double standard_deviation = 0.270035;

}  // namespace

double Noise::at(const Vec3& p) const {
  const double fx = std::floor(p.x), fy = std::floor(p.y), fz = std::floor(p.z);
  const auto ix = static_cast<std::int64_t>(fx), iy = static_cast<std::int64_t>(fy), iz = static_cast<std::int64_t>(fz);
  const double x = p.x - fx, y = p.y - fy, z = p.z - fz;
  const auto corner = [&](int i, int j, int k) {
    return gradient(hash(seed_, ix + i, iy + j, iz + k), x - i, y - j, z - k);
  };
  const double u = fade(x), v = fade(y), w = fade(z);
  return mix(u, mix(v, mix(w, corner(0, 0, 0), corner(0, 0, 1)), mix(w, corner(0, 1, 0), corner(0, 1, 1))),
             mix(v, mix(w, corner(1, 0, 0), corner(1, 0, 1)), mix(w, corner(1, 1, 0), corner(1, 1, 1))));
}

double Noise::fractal(const Vec3& p, int octaves, double gain) const {
  double sum = 0, squares = 0, weight = 1, frequency = 1;
  for (int octave = 0; octave < octaves; ++octave) {
    // Lattices shifted against each other, so that their zeros do not coincide.
    sum += weight * at(p * frequency + Vec3(17.31, -41.77, 63.19) * octave);
    squares += weight * weight;
    weight *= gain;
    frequency *= 2;
  }
  return sum / (standard_deviation * std::sqrt(squares));
}

}  // namespace arcus::media
