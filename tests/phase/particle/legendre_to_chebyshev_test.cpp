// Legendre series turned into cosine series: against the series themselves, and for both kinds of
// machine code.
#include "phase/particle/legendre_to_chebyshev.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "phase/base/units.h"

namespace arcus::phase {
namespace {

constexpr int row = LegendreToChebyshev::width * lanes;

// A series of random coefficients 2 n + 1 in size, as amplitudes have, in every column and lane;
// and its conversion.
struct Converted {
  Converted(const LegendreToChebyshev& conversion, int degree_of_series, Instructions instructions)
      : degree(degree_of_series) {
    const LaneMemory legendre_memory(LegendreToChebyshev::series_size(degree));
    const LaneMemory chebyshev_memory(LegendreToChebyshev::series_size(degree));
    const LaneMemory scratch(LegendreToChebyshev::scratch_size(degree));
    std::mt19937_64 random(degree);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int i = 0; i < (degree + 1) * row; ++i)
      legendre.push_back((2 * (i / row) + 1) * uniform(random));
    std::copy(legendre.begin(), legendre.end(), legendre_memory.data());
    conversion.convert(degree, legendre_memory.data(), chebyshev_memory.data(), scratch.data(),
                       instructions);
    chebyshev.assign(chebyshev_memory.data(), chebyshev_memory.data() + (degree + 1) * row);
  }

  double legendre_sum(int column, double angle) const {
    double before = 0, value = 1, sum = 0;
    for (int n = 0; n <= degree; ++n) {
      sum += legendre[n * row + column] * value;
      const double next = ((2 * n + 1) * std::cos(angle) * value - n * before) / (n + 1);
      before = value;
      value = next;
    }
    return sum;
  }

  double cosine_sum(int column, double angle) const {
    double sum = 0;
    for (int j = 0; j <= degree; ++j)
      sum += (j ? 2 : 1) / pi * chebyshev[j * row + column] * std::cos(j * angle);
    return sum;
  }

  int degree;
  std::vector<double> legendre, chebyshev;
};

TEST(GammaRatio, AgreesWithTheGammaFunction) {
  for (const double z : {-0.4, 0.0, 0.5, 3.25, 19.9, 20.1, 77.7})
    EXPECT_NEAR(gamma_ratio(z) * std::tgamma(z + 1) / std::tgamma(z + 0.5), 1, 1e-13) << z;
  EXPECT_NEAR(gamma_ratio(0), std::sqrt(pi), 1e-15);
  EXPECT_NEAR(gamma_ratio(1e6 + 1) / gamma_ratio(1e6), (1e6 + 0.5) / (1e6 + 1), 1e-15);
}

TEST(LegendreToChebyshev, CosineSeriesIsTheSameFunction) {
  const LegendreToChebyshev conversion(3000);
  // About the block sizes, 64 degrees and powers of two of it.
  for (const int degree :
       {0, 1, 2, 62, 63, 64, 65, 127, 128, 129, 191, 192, 255, 256, 257, 500, 1000, 2999, 3000}) {
    const Converted series(conversion, degree, best_instructions());
    // Sums of (2 n + 1) P_n with random signs: their size away from the poles.
    const double size = 2 * (degree + 1);
    for (const int column : {0, 9, row - 1})
      for (const double angle : {0.3, 1.0, pi / 2, 2.9})
        EXPECT_NEAR(series.legendre_sum(column, angle), series.cosine_sum(column, angle),
                    1e-9 * size)
            << degree << " " << column << " " << angle;
  }
}

TEST(LegendreToChebyshev,
     KnowsTheFirstPolynomials) {  // P_2 = 1/4 + 3/4 cos 2t, P_3 = 3/8 cos t + 5/8 cos 3t
  const LegendreToChebyshev conversion(3);
  const LaneMemory legendre(LegendreToChebyshev::series_size(3)),
      chebyshev(LegendreToChebyshev::series_size(3));
  const LaneMemory scratch(LegendreToChebyshev::scratch_size(3));
  std::fill_n(legendre.data(), 4 * row, 0.0);
  legendre.data()[2 * row] = 1;      // P_2 in column 0
  legendre.data()[3 * row + 1] = 1;  // P_3 in column 1
  conversion.convert(3, legendre.data(), chebyshev.data(), scratch.data(), best_instructions());
  const double* b = chebyshev.data();
  EXPECT_NEAR(b[0] / pi, 0.25, 1e-15);
  EXPECT_NEAR(b[2 * row] * 2 / pi, 0.75, 1e-15);
  EXPECT_NEAR(b[row + 1] * 2 / pi, 0.375, 1e-15);
  EXPECT_NEAR(b[3 * row + 1] * 2 / pi, 0.625, 1e-15);
}

TEST(LegendreToChebyshev, BothInstructionSetsGiveTheSameBits) {
  if (best_instructions() != Instructions::avx512) GTEST_SKIP() << "this processor has no AVX-512";
  const LegendreToChebyshev conversion(1500);
  for (const int degree : {5, 100, 700, 1500})
    EXPECT_EQ(Converted(conversion, degree, Instructions::avx2).chebyshev,
              Converted(conversion, degree, Instructions::avx512).chebyshev);
}

}  // namespace
}  // namespace arcus::phase
