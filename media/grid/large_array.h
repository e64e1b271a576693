#pragma once
// Memory for grids: zeroed, of fixed size, and in pages of 2 MiB where the system offers them. Lookups at random
// places of a large grid spend much of their time on address translation; large pages take most of that away.

#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <type_traits>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace arcus::media {

template <class T>
class LargeArray {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  LargeArray() = default;
  /// Throws std::bad_alloc where there is not enough memory.
  explicit LargeArray(std::size_t size) : size_(size) {
    if (size == 0) return;
    constexpr std::size_t large_page = std::size_t{2} << 20;
    const std::size_t alignment = bytes() < large_page ? 64 : large_page;
    const std::size_t rounded = (bytes() + alignment - 1) / alignment * alignment;
    values_.reset(static_cast<T*>(std::aligned_alloc(alignment, rounded)));
    if (!values_) throw std::bad_alloc();
#ifdef __linux__
    if (alignment == large_page) madvise(values_.get(), rounded, MADV_HUGEPAGE);  // a wish: failing is harmless
#endif
    std::memset(static_cast<void*>(values_.get()), 0, rounded);
  }

  T* data() { return values_.get(); }
  const T* data() const { return values_.get(); }
  std::size_t size() const { return size_; }
  std::size_t bytes() const { return size_ * sizeof(T); }
  T& operator[](std::size_t i) { return values_.get()[i]; }
  const T& operator[](std::size_t i) const { return values_.get()[i]; }

 private:
  struct Free {
    void operator()(T* p) const { std::free(p); }
  };
  std::unique_ptr<T, Free> values_;
  std::size_t size_ = 0;
};

}  // namespace arcus::media
