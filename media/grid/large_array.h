#pragma once
// Memory for grids: zeroed, of fixed size, and in pages of 2 MiB where the system offers them. Lookups at random
// places of a large grid spend much of their time on address translation; large pages take most of that away.

#include <cstddef>
#include <cstdint>
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
    const bool is_mapped = is_linux && bytes() >= large_page;
    values_ = std::unique_ptr<T, Free>(static_cast<T*>(is_mapped ? mapped(bytes()) : zeros(bytes())), Free{is_mapped ? bytes() : 0});
    if (!values_) throw std::bad_alloc();
  }

  T* data() { return values_.get(); }
  const T* data() const { return values_.get(); }
  std::size_t size() const { return size_; }
  std::size_t bytes() const { return size_ * sizeof(T); }
  T& operator[](std::size_t i) { return values_.get()[i]; }
  const T& operator[](std::size_t i) const { return values_.get()[i]; }

 private:
  static void* zeros(std::size_t bytes) {
    constexpr std::size_t cache_line = 64;
    const std::size_t rounded = (bytes + cache_line - 1) / cache_line * cache_line;
    void* const values = std::aligned_alloc(cache_line, rounded);
    return values ? std::memset(values, 0, rounded) : nullptr;
  }
  static constexpr std::size_t large_page = std::size_t{2} << 20;
#ifdef __linux__
  static constexpr bool is_linux = true;
  static std::size_t rounded(std::size_t bytes) { return (bytes + large_page - 1) / large_page * large_page; }
  /// At a multiple of large_page. The system gives zeros, page by page, to the thread that first touches one: so many threads that fill
  /// an array share that work, which for gigabytes takes seconds.
  static void* mapped(std::size_t bytes) {
    const std::size_t all = rounded(bytes) + large_page;
    void* const map = ::mmap(nullptr, all, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (map == MAP_FAILED) return nullptr;
    char* const begin = static_cast<char*>(map);
    const std::size_t before = (large_page - reinterpret_cast<std::uintptr_t>(map) % large_page) % large_page;
    if (before > 0) ::munmap(begin, before);
    if (before < large_page) ::munmap(begin + before + rounded(bytes), large_page - before);
    ::madvise(begin + before, rounded(bytes), MADV_HUGEPAGE);  // a wish: failing is harmless
    return begin + before;
  }
  static void unmap(void* values, std::size_t bytes) { ::munmap(values, rounded(bytes)); }
#else
  static constexpr bool is_linux = false;
  static void* mapped(std::size_t) { return nullptr; }
  static void unmap(void*, std::size_t) {}
#endif

  struct Free {
    std::size_t mapped_bytes = 0;  ///< 0: from the heap
    void operator()(T* p) const { mapped_bytes > 0 ? unmap(p, mapped_bytes) : std::free(p); }
  };
  std::unique_ptr<T, Free> values_;
  std::size_t size_ = 0;
};

}  // namespace arcus::media
