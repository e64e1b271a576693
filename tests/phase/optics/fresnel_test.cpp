#include "phase/optics/fresnel.h"

#include <gtest/gtest.h>

#include <cmath>

namespace arcus::phase {

TEST(Fresnel, ReflectsFourPercentOffGlassStraightOn) {
  const auto a = fresnel_amplitudes(1.0, 1.5);
  EXPECT_NEAR(a.r_parallel.real(), 0.2, 1e-15);
  EXPECT_NEAR(a.r_perpendicular.real(), -0.2, 1e-15);
  EXPECT_NEAR(fresnel_reflectance(1, 1.5).unpolarised(), 0.04, 1e-15);
}

TEST(Fresnel, ParallelVanishesAtBrewstersAngle) {
  const double cos_brewster = std::cos(std::atan(1.333));
  EXPECT_LT(fresnel_reflectance(cos_brewster, 1.333).parallel, 1e-30);
  EXPECT_LT(fresnel_amplitudes(std::cos(std::atan(1.333) - 0.1), 1.333).r_parallel.real() *
                fresnel_amplitudes(std::cos(std::atan(1.333) + 0.1), 1.333).r_parallel.real(),
            0);
}

TEST(Fresnel, ReflectedAndTransmittedPowerMakeOne) {
  for (const double m : {0.75, 1.31, 2.4})
    for (double c = 0.02; c < 1; c += 0.07) {
      const auto a = fresnel_amplitudes(c, m);
      const double ratio = (m * a.cos_transmitted).real() / c;
      EXPECT_NEAR(std::norm(a.r_perpendicular) + ratio * std::norm(a.t_perpendicular), 1, 1e-12)
          << m << " " << c;
      EXPECT_NEAR(std::norm(a.r_parallel) + ratio * std::norm(a.t_parallel), 1, 1e-12)
          << m << " " << c;
      const auto powers = fresnel_reflectance(c, m);
      EXPECT_NEAR(powers.perpendicular, std::norm(a.r_perpendicular), 1e-12);
      EXPECT_NEAR(powers.parallel, std::norm(a.r_parallel), 1e-12);
    }
}

TEST(Fresnel, ReflectsEverythingBeyondTheCriticalAngle) {
  const auto powers = fresnel_reflectance(0.1, 1 / 1.333);
  EXPECT_EQ(powers.perpendicular, 1);
  EXPECT_EQ(powers.parallel, 1);
  // and the field beyond the interface decays
  EXPECT_GT(fresnel_amplitudes(0.1, 1 / 1.333).cos_transmitted.imag(), 0);
}

TEST(Fresnel, FollowsStokesRelationsForTheWayBack) {
  // r' = -r and t t' = 1 - r^2 for the reversed ray: what the rays inside of a drop live on.
  const double c = 0.6, m = 1.333;
  const auto in = fresnel_amplitudes(c, m);
  const auto out = fresnel_amplitudes(in.cos_transmitted, 1 / m);
  EXPECT_NEAR(std::abs(out.r_perpendicular + in.r_perpendicular), 0, 1e-14);
  EXPECT_NEAR(std::abs(out.r_parallel + in.r_parallel), 0, 1e-14);
  EXPECT_NEAR(std::abs(in.t_perpendicular * out.t_perpendicular -
                       (1.0 - in.r_perpendicular * in.r_perpendicular)),
              0, 1e-14);
  EXPECT_NEAR(std::abs(in.t_parallel * out.t_parallel - (1.0 - in.r_parallel * in.r_parallel)), 0,
              1e-14);
}

}  // namespace arcus::phase
