#include "phase/particle/pair_transform.h"

#include <cassert>
#include <cmath>

#include "phase/base/units.h"

namespace arcus::phase {

PairTransform::PairTransform(std::size_t length) : length_(length), roots_(length) {
  assert(length >= 4 && (length & (length - 1)) == 0);
  for (std::size_t j = 0; j < length; ++j)
    roots_[j] = std::polar(1.0, 2 * pi * static_cast<double>(j) / static_cast<double>(length));
}

void PairTransform::run(std::vector<ComplexPair>& data, std::vector<ComplexPair>& work) const {
  assert(data.size() == length_ && work.size() == length_);
  // Each pass turns `stride` interleaved transforms of length n into 4 times as many of a quarter the length.
  std::size_t stride = 1;
  const std::size_t quarter = length_ / 4, half = length_ / 2;
  for (; 4 * stride <= length_; stride *= 4) {
    for (std::size_t block = 0; block < quarter / stride; ++block) {
      const std::size_t place = block * stride;
      const std::complex<double> w1 = roots_[place], w2 = roots_[2 * place], w3 = roots_[3 * place];
      const ComplexPair* in = data.data() + place;
      ComplexPair* out = work.data() + 4 * place;
      for (std::size_t k = 0; k < stride; ++k) {
        const ComplexPair a = in[k], b = in[k + quarter], c = in[k + half], d = in[k + half + quarter];
        const ComplexPair even = a + c, odd = a - c, even2 = b + d, odd2 = times_i(b - d);
        out[k] = even + even2;
        out[k + stride] = times(odd + odd2, w1);
        out[k + 2 * stride] = times(even - even2, w2);
        out[k + 3 * stride] = times(odd - odd2, w3);
      }
    }
    data.swap(work);
  }
  if (stride < length_) {  // a factor 2 is left
    for (std::size_t k = 0; k < stride; ++k) {
      const ComplexPair a = data[k], b = data[k + half];
      work[k] = a + b;
      work[k + stride] = a - b;
    }
    data.swap(work);
  }
}

}  // namespace arcus::phase
