#include "phase/optics/stokes.h"

#include <cmath>

namespace arcus::phase {

Stokes turned(const Stokes& light, double cosine, double sine) {
  const double squares = cosine * cosine + sine * sine;
  if (!(squares > 0)) return light;
  const double c = (cosine * cosine - sine * sine) / squares, s = 2 * cosine * sine / squares;
  return {light.i, c * light.q - s * light.u, s * light.q + c * light.u, light.v};
}

Stokes InterfaceMatrix::reflected(const Stokes& light) const {
  return {a * light.i + b * light.q, b * light.i + a * light.q, c * light.u + d * light.v,
          c * light.v - d * light.u};
}

Stokes InterfaceMatrix::transmitted(const Stokes& light) const {
  return {(1 - a) * light.i - b * light.q, (1 - a) * light.q - b * light.i, transmitted_c * light.u,
          transmitted_c * light.v};
}

InterfaceMatrix interface_matrix(double cosine, double m) {
  InterfaceMatrix result;
  const double sin2 = 1 - cosine * cosine, cos2 = 1 - sin2 / (m * m);
  if (cos2 <= 0) {
    // Bohren & Huffman (1983), section 2.7: both amplitudes have modulus 1; tan of half their
    // difference in phase (Born & Wolf, section 1.5.4).
    const double t = cosine * std::sqrt(sin2 - m * m) / sin2, square = t * t;
    result.c = (1 - square) / (1 + square);
    result.d = -2 * t / (1 + square);
    return result;
  }
  const double cos_transmitted = std::sqrt(cos2);
  const double perpendicular_sum = cosine + m * cos_transmitted;
  const double parallel_sum = m * cosine + cos_transmitted;
  const double r_perpendicular = (cosine - m * cos_transmitted) / perpendicular_sum;
  const double r_parallel = (m * cosine - cos_transmitted) / parallel_sum;
  result.cos_transmitted = cos_transmitted;
  result.a = 0.5 * (r_parallel * r_parallel + r_perpendicular * r_perpendicular);
  result.b = 0.5 * (r_parallel * r_parallel - r_perpendicular * r_perpendicular);
  result.c = r_perpendicular * r_parallel;
  result.transmitted_c = 4 * m * cosine * cos_transmitted / (perpendicular_sum * parallel_sum);
  return result;
}

}  // namespace arcus::phase
