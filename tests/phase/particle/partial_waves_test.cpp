#include "phase/particle/partial_waves.h"

#include <gtest/gtest.h>

#include <cmath>

#include "phase/particle/mie.h"

namespace arcus::phase {
namespace {

/// Extinction efficiency of all orders together.
double extinction(const PartialWaves& waves, double x) {
  double sum = 0;
  for (const auto* terms : {&waves.perpendicular, &waves.parallel})
    for (std::size_t i = 0; i < terms->size(); ++i) {
      const SurfaceTerms& t = (*terms)[i];
      const auto inside = t.passed_through / (1.0 - t.reflected_inside);
      sum += (2.0 * (waves.first + static_cast<double>(i)) + 1) * 0.5 *
             (1.0 - t.reflected_outside - inside).real();
    }
  return 2 / (x * x) * sum;
}

}  // namespace

TEST(PartialWaves, OfAllOrdersMakeTheMieSeries) {
  for (const double x : {200.0, 523.7, 2000.3}) {
    const int last = static_cast<int>(x + 6 * std::cbrt(x));
    const double expected = mie_sphere(x, 1.333, std::vector<double>{}).efficiencies.extinction;
    EXPECT_NEAR(extinction(partial_waves(x, 1.333, 1, last), x), expected, 1e-7) << x;
  }
}

TEST(PartialWaves, LoseNoLightWithoutAbsorption) {
  const PartialWaves waves = partial_waves(800, 1.5, 1, 840);
  for (const auto* terms : {&waves.perpendicular, &waves.parallel})
    for (const SurfaceTerms& t : *terms) {
      const double inside = std::norm(t.reflected_inside);
      // Above the edge inside tends to 1: what gets in is lost to cancellation, and is nothing.
      if (inside > 1 - 1e-6) continue;
      EXPECT_NEAR(std::norm(t.reflected_outside) + std::norm(t.passed_through) / (1 - inside), 1,
                  1e-8);
    }
}

TEST(PartialWaves, DontDependOnWhereTheRangeBegins) {
  const PartialWaves all = partial_waves(700, 1.333, 1, 740),
                     some = partial_waves(700, 1.333, 500, 740);
  for (std::size_t i = 0; i < some.perpendicular.size(); ++i) {
    EXPECT_LT(
        std::abs(some.perpendicular[i].passed_through - all.perpendicular[i + 499].passed_through),
        3e-9);
    EXPECT_LT(std::abs(some.parallel[i].reflected_inside - all.parallel[i + 499].reflected_inside),
              3e-9);
    EXPECT_LT(
        std::abs(some.parallel[i].reflected_outside - all.parallel[i + 499].reflected_outside),
        3e-9);
  }
}

TEST(PartialWaves, AreDimmedByWeakAbsorptionAsTheMieSeriesIs) {
  const double x = 1500.2;
  const std::complex<double> m(1.333, 2e-5);
  const int last = static_cast<int>(x + 6 * std::cbrt(x));
  const double expected = mie_sphere(x, m, std::vector<double>{}).efficiencies.extinction;
  EXPECT_NEAR(extinction(partial_waves(x, m, 1, last), x), expected, 2e-5);
}

}  // namespace arcus::phase
