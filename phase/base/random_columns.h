#pragma once
// Random numbers by the hundred, for loops that compilers turn into vectors: sixteen generators side by side, xoshiro128++ of
// D. Blackman and S. Vigna, "Scrambled Linear Pseudorandom Number Generators", ACM Trans. Math. Softw. 47 (2021), whose states
// come from Random: that they overlap is as good as impossible.

#include <cstdint>

#include "phase/base/random.h"

namespace arcus {

class RandomColumns {
 public:
  /// As Random's: who asks decides the numbers.
  RandomColumns(std::uint64_t seed, std::uint64_t stream, std::uint32_t sample) {
    Random random(seed, stream, sample);
    for (auto& row : state_)
      for (std::uint32_t& word : row) word = random.bits();
  }

  /// count: a multiple of 16.
  void bits(std::uint32_t* out, int count) {
    for (int i = 0; i < count; i += side_by_side) next(out + i);
  }
  /// Uniform in [0, 1), 24 bits.
  void uniform(float* out, int count) {
    std::uint32_t words[side_by_side];
    for (int i = 0; i < count; i += side_by_side) {
      next(words);
      for (int k = 0; k < side_by_side; ++k)
        out[i + k] = static_cast<float>(static_cast<std::int32_t>(words[k] >> 8)) * 0x1p-24f;
    }
  }

 private:
  static constexpr int side_by_side = 16;
  static std::uint32_t turned(std::uint32_t x, int by) { return (x << by) | (x >> (32 - by)); }

  void next(std::uint32_t* out) {
    auto& [a, b, c, d] = state_;
    for (int k = 0; k < side_by_side; ++k) {
      out[k] = turned(a[k] + d[k], 7) + a[k];
      const std::uint32_t t = b[k] << 9;
      c[k] ^= a[k];
      d[k] ^= b[k];
      b[k] ^= c[k];
      a[k] ^= d[k];
      c[k] ^= t;
      d[k] = turned(d[k], 11);
    }
  }

  alignas(64) std::uint32_t state_[4][side_by_side];
};

}  // namespace arcus
