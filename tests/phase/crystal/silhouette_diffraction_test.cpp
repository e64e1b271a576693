#include "phase/crystal/silhouette_diffraction.h"

#include <gtest/gtest.h>

#include <cmath>

#include "phase/base/error.h"
#include "phase/base/quadrature.h"
#include "phase/base/random.h"
#include "phase/base/units.h"
#include "tests/statistics/cells.h"
#include "tests/statistics/chi_square.h"
#include "tests/statistics/seed.h"

namespace arcus::phase {

TEST(SilhouetteDiffraction, IntegratesToOne) {
  for (const double area : {0.05, 10.0, 500.0}) {
    const SilhouetteDiffraction lobe(area, 550);
    const double integral = integrate(
        [&](double root) { return 8 * pi * root * lobe.value_per_sr(root * root); }, 0, 1, 1e-9);
    EXPECT_NEAR(integral, 1, 1e-6) << area;
    EXPECT_NEAR(lobe.share_within(1), 1, 1e-15);
  }
}

TEST(SilhouetteDiffraction, HasTheWidthOfADisc) {
  // 1.03 wavelengths over the diameter: 0.32 deg at 100 um, and half of the peak at half the width.
  const SilhouetteDiffraction lobe(pi * 50 * 50, 550);
  EXPECT_NEAR(degrees(lobe.width_rad()), 0.3245, 0.001);
  const double half = std::sin(0.25 * lobe.width_rad());
  EXPECT_NEAR(lobe.value_per_sr(half * half) / lobe.value_per_sr(0), 0.5, 1e-4);
  EXPECT_NEAR(lobe.value_per_sr(0), std::pow(lobe.size_parameter(), 2) / (4 * pi),
              0.01 * lobe.value_per_sr(0));
  // The first dark ring, 1.22 wavelengths over the diameter.
  const double dark = 3.8317 / (2 * lobe.size_parameter());
  EXPECT_LT(lobe.value_per_sr(dark * dark), 1e-8 * lobe.value_per_sr(0));
  EXPECT_NEAR(lobe.share_within(dark * dark), 0.838, 0.002);
}

TEST(SilhouetteDiffraction, DrawsFollowItsValue) {
  const SilhouetteDiffraction lobe(200, 550);
  const auto density = [&](double root) { return 8 * pi * root * lobe.value_per_sr(root * root); };
  const statistics::IntervalCells cells(density, 0, 1, 50, {0.005, 0.02, 0.05, 0.1, 0.2});
  const statistics::IntervalCells tilted(
      [&](double root) {
        return density(root) * (root < 0.01 ? 1.05 : 1) / (1 + 0.05 * lobe.share_within(1e-4));
      },
      0, 1, 50, {0.005, 0.01, 0.02, 0.05, 0.1, 0.2});
  statistics::Tally tally(cells), off(tilted);
  Random random(statistics::test_seed(), 0, 0);
  for (int i = 0; i < 500'000; ++i) {
    const double root = std::sqrt(lobe.draw_sin2_half(random.uniform_double()));
    tally.add(root);
    off.add(root);
  }
  EXPECT_TRUE(statistics::chi_square(tally));
  EXPECT_FALSE(statistics::chi_square(off));
}

TEST(SilhouetteDiffraction, DrawsInvertTheShare) {
  for (const double area : {1e-3, 1.0, 1e4, 1e8})
    for (const double u : {0.0, 1e-6, 0.3, 0.8378, 0.9, 0.99, 0.999, 1 - 1e-9}) {
      const SilhouetteDiffraction lobe(area, 550);
      EXPECT_NEAR(lobe.share_within(lobe.draw_sin2_half(u)), u, 1e-7) << area << ' ' << u;
    }
  EXPECT_THROW(SilhouetteDiffraction(0, 550), Error);
}

}  // namespace arcus::phase
