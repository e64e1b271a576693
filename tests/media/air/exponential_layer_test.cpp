#include "media/air/exponential_layer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "phase/base/units.h"

namespace arcus::media {
namespace {

// By mpmath, with 60 digits.
TEST(ExponentialLayer, ScaledErfcIsThatOfAnotherLibrary) {
  const double expected[][2] = {{0, 1}, {0.001, 0.99887262008115141}, {0.5, 0.61569034419292587}, {1, 0.427583576155807}, {2, 0.25539567631050574},
                               {3.99, 0.13732404091422971}, {4.01, 0.13667636742994915}, {10, 0.056140992743822586}, {30, 0.018795888861416751}, {145, 0.003890870119946887}};
  for (const auto& [z, value] : expected) EXPECT_NEAR(scaled_erfc(z) / value, 1, 1e-12) << z;
}

TEST(ExponentialLayer, WayToSpaceIsThatOfManyPoints) {
  constexpr double radius = 6371000;
  for (const double scale_height : {300.0, 1200.0, 8434.5, 12000.0})
    for (const double height : {0.0, 5000.0, 30000.0})
      for (const double climb : {0.0, 1e-4, 0.003, 0.03, 0.2, 0.7, 1.0}) {
        // Simpson's rule in equal steps of the root of the height climbed, in which the way is smooth even where the ray starts level.
        const double r = radius + height;
        const auto way = [&](double up) { return up * (2 * r + up) / (r * climb + std::sqrt(r * r * climb * climb + up * (2 * r + up))); };
        constexpr int steps = 20000;
        const double most = std::sqrt(45 * scale_height);
        double sum = 0, before = 0;
        for (int i = 1; i <= steps; ++i) {
          const double left = most * (i - 1) / steps, right = most * i / steps, middle = 0.5 * (left + right);
          const double after = way(right * right);
          // The way is Simpson's measure: e^(−h/H) at the middle, corrected by its ends.
          sum += (after - before) * (std::exp(-left * left / scale_height) + 4 * std::exp(-middle * middle / scale_height) + std::exp(-right * right / scale_height)) / 6;
          before = after;
        }
        EXPECT_NEAR(way_to_space_m(height, climb, scale_height, radius) / (std::exp(-height / scale_height) * sum), 1, 2e-7)
            << scale_height << " m, from " << height << " m, climb " << climb;
      }
}

}  // namespace
}  // namespace arcus::media
