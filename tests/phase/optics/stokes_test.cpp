#include "phase/optics/stokes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "phase/base/units.h"
#include "phase/optics/fresnel.h"

namespace arcus::phase {

// Bohren & Huffman (1983), equation 3.16, from amplitudes.
TEST(InterfaceMatrix, IsThatOfTheAmplitudes) {
  for (const double m : {1.31, 1 / 1.31, 2.5, 0.4})
    for (const double cosine : {1.0, 0.9, 0.6, 0.3, 0.05, 1e-4}) {
      const FresnelAmplitudes f = fresnel_amplitudes(cosine, m);
      const InterfaceMatrix matrix = interface_matrix(cosine, m);
      const double parallel = std::norm(f.r_parallel), perpendicular = std::norm(f.r_perpendicular);
      EXPECT_NEAR(matrix.a, 0.5 * (parallel + perpendicular), 1e-13);
      EXPECT_NEAR(matrix.b, 0.5 * (parallel - perpendicular), 1e-13);
      EXPECT_NEAR(matrix.c, std::real(f.r_perpendicular * std::conj(f.r_parallel)), 1e-13);
      EXPECT_NEAR(matrix.d, std::imag(f.r_parallel * std::conj(f.r_perpendicular)), 1e-13)
          << m << ' ' << cosine;
      if (matrix.total()) continue;
      const double factor = m * matrix.cos_transmitted / cosine;
      EXPECT_NEAR(matrix.transmitted_c, factor * std::real(f.t_perpendicular * f.t_parallel),
                  1e-12);
      EXPECT_NEAR(1 - matrix.a,
                  factor * 0.5 * (std::norm(f.t_parallel) + std::norm(f.t_perpendicular)), 1e-12);
    }
}

TEST(InterfaceMatrix, LosesNoPowerAndPolarisesAtBrewstersAngle) {
  const double m = 1.31, cosine = 1 / std::sqrt(1 + m * m);
  const InterfaceMatrix matrix = interface_matrix(cosine, m);
  const Stokes light{1, 0.3, -0.2, 0.1};
  const Stokes reflected = matrix.reflected(light), through = matrix.transmitted(light);
  EXPECT_NEAR(reflected.i + through.i, 1, 1e-15);
  EXPECT_NEAR(matrix.reflected({}).q, -matrix.reflected({}).i, 1e-15);  // perpendicular alone
}

TEST(InterfaceMatrix, TotalReflectionKeepsTheDegreeOfPolarisation) {
  const Stokes light{1, 0.6, 0.48, 0.64};
  const InterfaceMatrix matrix = interface_matrix(0.5, 1 / 1.31);
  ASSERT_TRUE(matrix.total());
  const Stokes back = matrix.reflected(light);
  EXPECT_EQ(back.i, 1);
  EXPECT_EQ(matrix.transmitted(light).i, 0);
  EXPECT_NEAR(back.q * back.q + back.u * back.u + back.v * back.v, 1, 1e-12);
}

TEST(Stokes, TurnsByTwiceTheAngle) {
  // Field along e_parallel; axes turned by 90 degrees see it along their perpendicular.
  const Stokes parallel{1, 1, 0, 0};
  const Stokes quarter = turned(parallel, 0, 3);
  EXPECT_NEAR(quarter.q, -1, 1e-15);
  EXPECT_NEAR(quarter.u, 0, 1e-15);
  // The field at 45 degrees between both axes has E_par E_perp* > 0; perpendicular axes turned onto
  // it see it along e_perpendicular.
  const Stokes between{1, 0, 1, 0};
  EXPECT_NEAR(turned(between, 2, 2).q, -1, 1e-15);
  EXPECT_EQ(turned(between, 0, 0).u, 1);
}

}  // namespace arcus::phase
