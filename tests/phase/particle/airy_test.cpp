#include "phase/particle/airy.h"

#include <gtest/gtest.h>

#include <cmath>

#include "phase/base/units.h"

namespace arcus::phase {

// Values of M. Abramowitz and I. A. Stegun, Handbook of Mathematical Functions (1964), tables 10.11
// and 10.13.
TEST(Airy, HasTheTabulatedValuesAndZeros) {
  EXPECT_NEAR(airy(0).ai, 0.35502805, 1e-8);
  EXPECT_NEAR(airy(0).ai_slope, -0.25881940, 1e-8);
  EXPECT_NEAR(airy(0).bi, 0.61492663, 1e-8);
  EXPECT_NEAR(airy(0).bi_slope, 0.44828836, 1e-8);
  EXPECT_NEAR(airy(1).ai, 0.13529242, 1e-8);
  EXPECT_NEAR(airy(1).bi, 1.20742359, 1e-8);
  EXPECT_NEAR(airy(-2.33810741).ai, 0, 1e-8);
  EXPECT_NEAR(airy(-9.02265085).ai, 0, 1e-8);
  EXPECT_NEAR(airy(-1.01879297).ai_slope, 0, 1e-8);
}

TEST(Airy, KeepsItsWronskian) {
  for (double z = -60; z < 20; z += 0.37) {
    const AiryValues a = airy(z);
    EXPECT_NEAR((a.ai * a.bi_slope - a.ai_slope * a.bi) * pi, 1, z < 4 ? 2e-8 : 4e-5) << z;
  }
}

TEST(Airy, SolvesItsEquationAcrossTheJoinsOfItsSeries) {
  for (const double z : {-7.0, -6.99, -7.01, 4.0, 3.99, 4.01, 0.0, -3.0}) {
    const double h = 1e-4;
    const double curvature = (airy(z + h).ai_slope - airy(z - h).ai_slope) / (2 * h);
    const double size = z < 0 ? 1.5 : std::fabs(airy(z).ai_slope);
    EXPECT_NEAR(curvature, z * airy(z).ai, 2e-3 * size + (z >= 3.9 ? 2e-1 * size : 0)) << z;
  }
}

}  // namespace arcus::phase
