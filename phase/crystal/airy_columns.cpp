#include "phase/crystal/airy_columns.h"

#include <cmath>

#include "phase/base/quick_math.h"

namespace arcus::phase {
namespace {

constexpr int nodes = 8192;
constexpr float longest = 12.5f;  // exp(-12.5) is left outside of v = 1.7e5: shadows with a diameter of centimetres
constexpr float scale = (nodes - 1) / longest;

/// Share of an Airy pattern outside of v (Rayleigh 1881).
double outside(double v) { return ::j0(v) * ::j0(v) + ::j1(v) * ::j1(v); }

}  // namespace

AiryColumns::AiryColumns() : squares_(nodes + 1) {
  double low = 0;
  for (int i = 1; i <= nodes; ++i) {
    const double wanted = std::exp(-static_cast<double>(i) / scale);
    double high = low + 1;
    while (outside(high) > wanted) high += high;
    for (double start = low; high - start > 1e-9 * high;) {
      const double middle = 0.5 * (start + high);
      (outside(middle) > wanted ? start : high) = middle;
    }
    low = high;
    squares_[static_cast<std::size_t>(i)] = static_cast<float>(high * high);
  }
}

void AiryColumns::draw(const Column& size_parameter, RandomColumns& random, Turns& turns) const {
  Column share, azimuth;
  random.uniform(share.values, column_rays);
  random.uniform(azimuth.values, column_rays);
  const float* squares = squares_.data();
  for (int i = 0; i < column_rays; ++i) {
    const float x = size_parameter[i];
    // Share of the plane's pattern that lies on the sphere, v up to 2 x; but for the rings of its last digits.
    const float whole = 1 - 0.318309886f / x;
    const float depth = -quick_logarithm(1 - share[i] * whole);
    const float at = (depth < 0.999f * longest ? depth : 0.999f * longest) * scale;
    const auto node = static_cast<std::int32_t>(at);
    const float square = squares[node] + (at - static_cast<float>(node)) * (squares[node + 1] - squares[node]);
    const float ratio = square / (4 * x * x), sin2_half = ratio < 1 ? ratio : 1;
    const float sine = 2 * std::sqrt(sin2_half * (1 - sin2_half));
    const QuickSineCosine around = quick_sine_and_cosine_of_turn(azimuth[i]);
    turns.cosine[i] = 1 - 2 * sin2_half;
    turns.side[i] = sine * around.cosine;
    turns.other[i] = sine * around.sine;
  }
}

void turn(const AiryColumns::Turns& turns, VectorColumns& d) {
  for (int i = 0; i < column_rays; ++i) {
    // frame_around
    const float x = d.x[i], y = d.y[i], z = d.z[i];
    const float sign = std::copysign(1.0f, z), a = -1 / (sign + z), b = x * y * a;
    const float c = turns.cosine[i], s = turns.side[i], t = turns.other[i];
    d.x[i] = c * x + s * (1 + sign * x * x * a) + t * b;
    d.y[i] = c * y + s * sign * b + t * (sign + y * y * a);
    d.z[i] = c * z - s * sign * x - t * y;
  }
}

}  // namespace arcus::phase
