#pragma once
// Which machine code a kernel runs. The baseline of the build has AVX2; a processor with AVX-512
// runs the same operations in the same order on vectors twice as wide, so that the bits are equal.

namespace arcus::phase {

enum class Instructions { avx2, avx512 };

/// The best that this processor has.
inline Instructions best_instructions() {
  return __builtin_cpu_supports("x86-64-v4") ? Instructions::avx512 : Instructions::avx2;
}

}  // namespace arcus::phase
