#pragma once
// Random numbers that depend on nothing but who asks: (seed, pixel, sample) gives the stream, whatever the thread,
// tile or machine. Philox 4x32-10 of Salmon et al., "Parallel Random Numbers: As Easy as 1, 2, 3", SC 2011.

#include <Random123/philox.h>

#include <cstdint>

namespace arcus {

class Random {
 public:
  /// stream and sample number the user of the numbers: a pixel and its sample, say.
  Random(std::uint64_t seed, std::uint64_t stream, std::uint32_t sample)
      : counter_{{0, sample, static_cast<std::uint32_t>(stream), static_cast<std::uint32_t>(stream >> 32)}},
        key_{{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)}} {}

  std::uint32_t bits() {
    if (left_ == 0) {
      block_ = r123::Philox4x32()(counter_, key_);
      ++counter_[0];
      left_ = 4;
    }
    return block_[--left_];
  }
  /// Uniform in [0, 1), 24 bits.
  float uniform() { return static_cast<float>(bits() >> 8) * 0x1p-24f; }
  /// Uniform in [0, 1), 53 bits.
  double uniform_double() {
    const std::uint64_t high = bits(), low = bits();
    return static_cast<double>((high << 21) | (low >> 11)) * 0x1p-53;
  }

 private:
  r123::Philox4x32::ctr_type counter_;
  r123::Philox4x32::key_type key_;
  r123::Philox4x32::ctr_type block_{};
  unsigned left_ = 0;
};

}  // namespace arcus
