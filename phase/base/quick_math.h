#pragma once
// Functions of single numbers in plain arithmetic without branches, for loops that compilers turn into vectors. The same bits on
// every machine.

#include <bit>
#include <cmath>
#include <cstdint>

namespace arcus {

struct QuickSineCosine {
  float sine, cosine;
};

/// Sine and cosine of 2 pi turn, turn in [-1, 1]; errors below 3e-7. By Taylor's series on an eighth of a turn to either side of
/// the nearest quarter, as sine_and_cosine_of_turn.
inline QuickSineCosine quick_sine_and_cosine_of_turn(float turn) {
  const float shift = 12582912.0f;  // 1.5 2^23: adding it rounds to a whole number
  const float quarters = (4 * turn + shift) - shift;
  const auto quarter = static_cast<std::int32_t>(quarters);
  const float x = 6.28318531f * (turn - 0.25f * quarters), y = x * x;
  const float sine =
      x * (1 + y * (-1.0f / 6 + y * (1.0f / 120 + y * (-1.0f / 5040 + y * (1.0f / 362880)))));
  const float cosine =
      1 + y * (-0.5f + y * (1.0f / 24 + y * (-1.0f / 720 + y * (1.0f / 40320 + y * (-1.0f / 3628800)))));
  const bool swapped = quarter & 1;
  const float a = swapped ? cosine : sine, b = swapped ? sine : cosine;
  return {(quarter & 2) ? -a : a, ((quarter + 1) & 2) ? -b : b};
}

/// The angle from x towards y [rad], in [0, pi]; y at least 0, not both 0. M. Abramowitz and I. Stegun (1964), 4.4.49; errors
/// below 3e-7.
inline float quick_angle(float y, float x) {
  const float across = std::fabs(x);
  const bool steep = y > across;
  const float t = (steep ? across : y) / (steep ? y : across), s = t * t;
  const float series =
      t * (1 + s * (-.3333314528f +
                    s * (.1999355085f +
                         s * (-.1420889944f +
                              s * (.1065626393f + s * (-.0752896400f + s * (.0429096138f + s * (-.0161657367f + s * .0028662257f))))))));
  const float angle = steep ? 1.57079633f - series : series;
  return x < 0 ? 3.14159265f - angle : angle;
}

/// e to a power in [-87, 88], 0 below; relative errors of 2e-7.
inline float quick_exponential(float power) {
  const float shift = 12582912.0f;  // 1.5 2^23: adding it rounds to a whole number
  const float halves = power * 1.44269504f, whole = (halves + shift) - shift;
  const float x = 0.693147181f * (halves - whole);
  const float series = 1 + x * (1 + x * (0.5f + x * (1.0f / 6 + x * (1.0f / 24 + x * (1.0f / 120 + x * (1.0f / 720))))));
  const float scale = std::bit_cast<float>((static_cast<std::int32_t>(whole) + 127) << 23);
  return power < -87 ? 0 : series * scale;
}

/// Natural logarithm of a normal number above 0; relative errors of 1e-7.
inline float quick_logarithm(float number) {
  const auto bits = std::bit_cast<std::int32_t>(number);
  const std::int32_t power = (bits - 0x3f3504f3) >> 23;  // of two, which leaves between sqrt(1/2) and sqrt(2)
  const float rest = std::bit_cast<float>(bits - (power << 23));
  const float t = (rest - 1) / (rest + 1), s = t * t;
  return 0.693147181f * static_cast<float>(power) + 2 * t * (1 + s * (1.0f / 3 + s * (1.0f / 5 + s * (1.0f / 7 + s * (1.0f / 9)))));
}

}  // namespace arcus
