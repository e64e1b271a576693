#include "phase/particle/edge_window.h"

#include <gtest/gtest.h>

#include <cmath>

#include "phase/base/units.h"

namespace arcus::phase {

TEST(EdgeWindow, IsOneAtTheEdgeAndNothingAtTheCentre) {
  for (const double n : {1.2, 1.333, 1.7})
    for (int p = 0; p <= 12; ++p)
      for (double x = 500; x < 2e5; x *= 1.7) {
        const EdgeWindow window = edge_window(RaysOfOrder(p, n), n, x);
        EXPECT_NEAR(window.value_at(0.5 * pi), 1, 2e-5) << n << " " << p << " " << x;
        if (window.everything) continue;
        EXPECT_LT(window.value_at(0), 2e-5) << n << " " << p << " " << x;
        EXPECT_LT(window.value_at(window.begin_rad()), 2e-5);
        EXPECT_NEAR(window.value_at(std::asin(window.whole_from_sine)), 1, 2e-5);
      }
}

TEST(EdgeWindow, DoesNotFallWithinTheAiryZoneOfABow) {
  for (const double n : {1.31, 1.333, 1.5})
    for (int p = 2; p <= 6; ++p)
      for (double x = 1000; x < 2e5; x *= 1.7) {
        const RaysOfOrder rays(p, n);
        const EdgeWindow window = edge_window(rays, n, x);
        const double bow = *rays.bow_incidence_rad();
        EXPECT_NEAR(window.value_at(bow), window.bow_inside ? 1 : 0, 2e-5)
            << n << " " << p << " " << x;
      }
}

TEST(EdgeWindow, HasTheSlopesOfItsShare) {
  const EdgeWindow window = edge_window(RaysOfOrder(1, 1.333), 1.333, 3000);
  for (double t = window.begin_rad() + 0.02; t < 1.4; t += 0.03) {
    const double h = 1e-5;
    const auto before = window.at(t - h), after = window.at(t + h), here = window.at(t);
    EXPECT_NEAR(here.value, window.value_at(t), 1e-15);
    EXPECT_NEAR(here.slope, (after.value - before.value) / (2 * h), 1e-6);
    EXPECT_NEAR(here.curvature, (after.slope - before.slope) / (2 * h), 1e-4);
  }
}

}  // namespace arcus::phase
