#pragma once
// Fast Fourier transform of two complex sequences at once, one for each polarisation, four numbers
// in one register.

#include <complex>
#include <cstddef>
#include <vector>

namespace arcus::phase {

/// Two complex numbers: (re, im) of the first, (re, im) of the second.
typedef double ComplexPair __attribute__((vector_size(32)));

inline ComplexPair make_pair_of(std::complex<double> a, std::complex<double> b) {
  return ComplexPair{a.real(), a.imag(), b.real(), b.imag()};
}
inline std::complex<double> first_of(ComplexPair p) { return {p[0], p[1]}; }
inline std::complex<double> second_of(ComplexPair p) { return {p[2], p[3]}; }

/// Both numbers times i.
inline ComplexPair times_i(ComplexPair p) {
  return __builtin_shufflevector(p, p, 1, 0, 3, 2) * ComplexPair{-1, 1, -1, 1};
}
/// Both numbers times c.
inline ComplexPair times(ComplexPair p, std::complex<double> c) {
  const double re = c.real(), im = c.imag();
  return p * ComplexPair{re, re, re, re} +
         __builtin_shufflevector(p, p, 1, 0, 3, 2) * ComplexPair{-im, im, -im, im};
}
/// First times first, second times second.
inline ComplexPair product(ComplexPair a, ComplexPair b) {
  const ComplexPair re = __builtin_shufflevector(b, b, 0, 0, 2, 2),
                    im = __builtin_shufflevector(b, b, 1, 1, 3, 3);
  return a * re + __builtin_shufflevector(a, a, 1, 0, 3, 2) * im * ComplexPair{-1, 1, -1, 1};
}

/// Transform of a fixed length. C. Temperton, J. Comput. Phys. 52, 1 (1983): self-sorting
/// (Stockham), radix 4.
class PairTransform {
 public:
  /// length: a power of two, at least 4.
  explicit PairTransform(std::size_t length);
  std::size_t length() const { return length_; }
  /// out[j] = sum_k in[k] exp(+2 pi i j k / length). Both of this length and not the same memory;
  /// what `in` held is lost.
  void run(ComplexPair* in, ComplexPair* out) const;

 private:
  std::size_t length_;
  bool even_passes_;                         // the passes alternate between the two arrays
  std::vector<std::complex<double>> roots_;  // exp(2 pi i j / length)
};

}  // namespace arcus::phase
