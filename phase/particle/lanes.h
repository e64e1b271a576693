#pragma once
// Eight spheres side by side: the vectors in which the kernels of mie_block compute, and memory for them.

#include <cstddef>
#include <memory>
#include <new>

// Functions that pass these vectors are all inlined, so that no convention of calling them is relied upon.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace arcus::phase {

/// The same quantity of eight spheres.
using Doubles [[gnu::vector_size(64), gnu::may_alias]] = double;
using Floats8 [[gnu::vector_size(32), gnu::may_alias]] = float;
using Floats16 [[gnu::vector_size(64), gnu::may_alias]] = float;

inline constexpr int lanes = 8;

/// A product that is rounded before it is added to another. Compilers fuse a multiplication and an addition into one
/// operation with one rounding; in a b + c d they can choose which product that is, and do so differently for different
/// machine code. So one of two products in a sum stands in here, which leaves one way to fuse, and equal bits.
template <typename Value>
[[gnu::always_inline]] inline Value rounded(const Value& product) {
  return __builtin_assoc_barrier(product);
}

/// Uninitialised memory for vectors.
class LaneMemory {
 public:
  explicit LaneMemory(std::size_t count) : memory_(::operator new(count * sizeof(Doubles), std::align_val_t(64))) {}
  Doubles* data() const { return static_cast<Doubles*>(memory_.get()); }

 private:
  struct Delete {
    void operator()(void* memory) const { ::operator delete(memory, std::align_val_t(64)); }
  };
  std::unique_ptr<void, Delete> memory_;
};

}  // namespace arcus::phase
