#include "phase/particle/pair_transform.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "phase/base/units.h"

namespace arcus::phase {

PairTransform::PairTransform(std::size_t length) : length_(length), roots_(length) {
  assert(length >= 4 && (length & (length - 1)) == 0);
  for (std::size_t j = 0; j < length; ++j)
    roots_[j] = std::polar(1.0, 2 * pi * static_cast<double>(j) / static_cast<double>(length));
  int passes = 0;
  for (std::size_t left = length; left > 1; left = left >= 4 ? left / 4 : left / 2) ++passes;
  even_passes_ = passes % 2 == 0;
}

void PairTransform::run(ComplexPair* in, ComplexPair* out) const {
  // Each pass turns `stride` interleaved transforms of length n into 4 times as many of a quarter
  // the length.
  ComplexPair *from = in, *to = out;
  std::size_t stride = 1;
  const std::size_t quarter = length_ / 4, half = length_ / 2;
  for (; 4 * stride <= length_; stride *= 4) {
    for (std::size_t block = 0; block < quarter / stride; ++block) {
      const std::size_t place = block * stride;
      const std::complex<double> w1 = roots_[place], w2 = roots_[2 * place], w3 = roots_[3 * place];
      const ComplexPair* source = from + place;
      ComplexPair* target = to + 4 * place;
      for (std::size_t k = 0; k < stride; ++k) {
        const ComplexPair a = source[k], b = source[k + quarter], c = source[k + half],
                          d = source[k + half + quarter];
        const ComplexPair even = a + c, odd = a - c, even2 = b + d, odd2 = times_i(b - d);
        target[k] = even + even2;
        target[k + stride] = times(odd + odd2, w1);
        target[k + 2 * stride] = times(even - even2, w2);
        target[k + 3 * stride] = times(odd - odd2, w3);
      }
    }
    std::swap(from, to);
  }
  if (stride < length_) {  // a factor 2 is left
    for (std::size_t k = 0; k < stride; ++k) {
      const ComplexPair a = from[k], b = from[k + half];
      to[k] = a + b;
      to[k + stride] = a - b;
    }
    std::swap(from, to);
  }
  if (even_passes_) std::copy(in, in + length_, out);
}

}  // namespace arcus::phase
