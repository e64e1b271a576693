#pragma once
// Vectors in pages of 2 MiB where the system offers them. Lookups at random places of a large table
// spend a good part of their time on address translation; large pages take that away.

#include <cstddef>
#include <cstdlib>
#include <new>
#include <vector>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace arcus::phase {

template <class T>
struct LargePageAllocator {
  using value_type = T;
  LargePageAllocator() = default;
  template <class U>
  LargePageAllocator(const LargePageAllocator<U>&) {}
  template <class U>
  bool operator==(const LargePageAllocator<U>&) const {
    return true;
  }

  T* allocate(std::size_t count) {
    constexpr std::size_t large_page = std::size_t{2} << 20, line = 64;
    const std::size_t bytes = count * sizeof(T), unit = bytes < large_page ? line : large_page;
    const std::size_t rounded = (bytes + unit - 1) / unit * unit;
    void* memory = std::aligned_alloc(unit, rounded);
    if (!memory) throw std::bad_alloc();
#ifdef __linux__
    if (unit == large_page) madvise(memory, rounded, MADV_HUGEPAGE);  // a wish: no harm if refused
#endif
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t) { std::free(memory); }
};

template <class T>
using LargeVector = std::vector<T, LargePageAllocator<T>>;

}  // namespace arcus::phase
