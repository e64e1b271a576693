#pragma once
// Eight spheres side by side: the vectors in which the kernels of mie_block compute, and memory for
// them.
//
// A kernel is written once, for either width of vector, as a template over Wide and Narrow, and
// compiled once for each in a function with the matching machine code. The layout in memory is the
// same: a quantity of eight spheres is eight doubles in a row; narrow vectors are halves of it
// ("parts").

#include <cstddef>
#include <memory>
#include <new>

// Functions that pass these vectors are all inlined, so that no convention of calling them is
// relied upon.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace arcus::phase {

inline constexpr int lanes = 8;

using Floats8 [[gnu::vector_size(32), gnu::may_alias]] = float;

/// Vectors of AVX-512.
struct Wide {
  using Doubles [[gnu::vector_size(64), gnu::may_alias]] = double;
  using Floats [[gnu::vector_size(32), gnu::may_alias]] = float;      ///< as many as Doubles
  using FullFloats [[gnu::vector_size(64), gnu::may_alias]] = float;  ///< as long as Doubles
  static constexpr int parts = 1;
};

/// Vectors of AVX2.
struct Narrow {
  using Doubles [[gnu::vector_size(32), gnu::may_alias]] = double;
  using Floats [[gnu::vector_size(16), gnu::may_alias]] = float;
  using FullFloats [[gnu::vector_size(32), gnu::may_alias]] = float;
  static constexpr int parts = 2;
};

/// All numbers alike. In machine code, as the compiler's own way takes one instruction for each of
/// the numbers.
template <typename Vector, typename Number>
[[gnu::always_inline]] inline Vector filled(Number value) {
  Vector result;
  if constexpr (sizeof(Number) == sizeof(double))
    asm("vbroadcastsd %1, %0" : "=v"(result) : "vm"(value));
  else
    asm("vbroadcastss %1, %0" : "=v"(result) : "vm"(value));
  return result;
}

/// sum + a b with one rounding, per number. The kernels are compiled without the fusing of
/// multiplications and additions that compilers do as they see fit, differently for different
/// machine code; where it pays it is asked for here, and the bits are equal.
template <typename Vector>
[[gnu::always_inline]] inline void add_product(Vector& sum, const Vector& a, const Vector& b) {
  if constexpr (sizeof(sum[0]) == sizeof(double))
    asm("vfmadd231pd %2, %1, %0" : "+v"(sum) : "v"(a), "vm"(b));
  else
    asm("vfmadd231ps %2, %1, %0" : "+v"(sum) : "v"(a), "vm"(b));
}

/// Uninitialised memory for vectors, aligned for either width.
class LaneMemory {
 public:
  /// Room for `count` quantities of eight spheres.
  explicit LaneMemory(std::size_t count)
      : memory_(static_cast<double*>(
            ::operator new(count* lanes * sizeof(double), std::align_val_t(64)))) {}
  double* data() const { return memory_.get(); }

 private:
  struct Delete {
    void operator()(double* memory) const { ::operator delete(memory, std::align_val_t(64)); }
  };
  std::unique_ptr<double, Delete> memory_;
};

}  // namespace arcus::phase
