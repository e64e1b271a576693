#pragma once
// Real spherical harmonics that are even about a vertical plane: those of functions of the sky that are the same on both sides of the sun.

#include <array>
#include <cmath>
#include <cstddef>

#include "phase/base/units.h"
#include "phase/base/vec3.h"

namespace arcus::media {

/// Number of them up to a degree.
constexpr std::size_t even_harmonic_count(int degree) { return static_cast<std::size_t>((degree + 1) * (degree + 2) / 2); }
/// Place of degree l and order m, 0 <= m <= l.
constexpr std::size_t even_harmonic_index(int l, int m) { return static_cast<std::size_t>(l * (l + 1) / 2 + m); }

/// Orthonormal over the sphere; direction: unit vector, the plane is y = 0. Recurrences of the associated Legendre functions in their normalised form.
template <int degree>
void even_harmonics(const Vec3& direction, std::array<double, even_harmonic_count(degree)>& y) {
  struct Factors {
    std::array<double, even_harmonic_count(degree)> a{}, b{};
    std::array<double, degree + 1> start{};
    Factors() {
      start[0] = std::sqrt(1 / (4 * pi));
      for (int m = 1; m <= degree; ++m) start[static_cast<std::size_t>(m)] = start[static_cast<std::size_t>(m - 1)] * std::sqrt((2 * m + 1) / (2.0 * m));
      for (int l = 1; l <= degree; ++l)
        for (int m = 0; m < l; ++m) {
          a[even_harmonic_index(l, m)] = std::sqrt((4.0 * l * l - 1) / (l * l - m * m));
          b[even_harmonic_index(l, m)] = std::sqrt(((l - 1.0) * (l - 1.0) - m * m) / (4.0 * (l - 1) * (l - 1) - 1));
        }
    }
  };
  static const Factors factors;
  double real = 1, imaginary = 0;  // of (x + iy)^m
  for (int m = 0; m <= degree; ++m) {
    const double scale = (m > 0 ? std::sqrt(2.0) : 1) * real;
    double before = 0, here = factors.start[static_cast<std::size_t>(m)];
    y[even_harmonic_index(m, m)] = here * scale;
    for (int l = m + 1; l <= degree; ++l) {
      const std::size_t index = even_harmonic_index(l, m);
      const double next = factors.a[index] * (direction.z * here - (l - m > 1 ? factors.b[index] * before : 0));
      before = here;
      here = next;
      y[index] = here * scale;
    }
    const double x = real * direction.x - imaginary * direction.y;
    imaginary = real * direction.y + imaginary * direction.x;
    real = x;
  }
}

}  // namespace arcus::media
