#include "phase/particle/pair_transform.h"

#include <gtest/gtest.h>

#include <cmath>

#include "phase/base/random.h"
#include "phase/base/units.h"

namespace arcus::phase {

TEST(PairTransform, IsTheSumThatDefinesIt) {
  for (const std::size_t length : {4u, 8u, 64u, 128u}) {  // even and odd powers of two
    Random random(1, length, 0);
    std::vector<ComplexPair> in(length), out(length);
    for (ComplexPair& pair : in)
      pair = ComplexPair{random.uniform_double(), random.uniform_double(), random.uniform_double(),
                         random.uniform_double()};
    const std::vector<ComplexPair> given = in;
    PairTransform(length).run(in.data(), out.data());
    for (std::size_t j = 0; j < length; ++j) {
      std::complex<double> first = 0, second = 0;
      for (std::size_t k = 0; k < length; ++k) {
        const auto turn = std::polar(1.0, 2 * pi * static_cast<double>(j * k % length) / length);
        first += first_of(given[k]) * turn;
        second += second_of(given[k]) * turn;
      }
      EXPECT_LT(std::abs(first - first_of(out[j])), 1e-12) << length << " " << j;
      EXPECT_LT(std::abs(second - second_of(out[j])), 1e-12) << length << " " << j;
    }
  }
}

TEST(ComplexPair, MultipliesAsComplexNumbersDo) {
  const std::complex<double> a(1, 2), b(3, -4), c(-0.5, 0.25), i(0, 1);
  const ComplexPair pair = make_pair_of(a, b);
  EXPECT_EQ(first_of(times(pair, c)), a * c);
  EXPECT_EQ(second_of(times(pair, c)), b * c);
  EXPECT_EQ(first_of(times_i(pair)), a * i);
  EXPECT_EQ(second_of(times_i(pair)), b * i);
  EXPECT_EQ(first_of(product(pair, make_pair_of(c, i))), a * c);
  EXPECT_EQ(second_of(product(pair, make_pair_of(c, i))), b * i);
}

}  // namespace arcus::phase
