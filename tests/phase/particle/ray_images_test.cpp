#include "phase/particle/ray_images.h"

#include <gtest/gtest.h>

#include <cmath>

#include "phase/base/units.h"
#include "phase/particle/airy.h"

namespace arcus::phase {
namespace {

double strength(const RayImage::Ray& ray) {
  return 0.5 * (ray.amplitude[0] * ray.amplitude[0] + ray.amplitude[1] * ray.amplitude[1]);
}

}  // namespace

TEST(RayImages, HaveTheClosedFormsOfTheAxis) {
  const double n = 1.333;
  const RayImages images = ray_images(n, 2, 500, std::vector<double>{0, pi});
  ASSERT_EQ(images.at(1, 0).size(), 1u);
  const double reflected = std::pow((n - 1) / (n + 1), 2);
  EXPECT_NEAR(strength(images.at(1, 0)[0].outer), std::pow((1 - reflected) * n / (2 * (n - 1)), 2),
              1e-6);
  EXPECT_NEAR(strength(images.at(0, 1)[0].outer), reflected / 4, 1e-9);
  // reflected once inside: n / (2 (2 - n)) for the focus, van de Hulst 1957, section 12.22
  ASSERT_EQ(images.at(2, 1).size(), 1u);
  EXPECT_NEAR(strength(images.at(2, 1)[0].inner),
              std::pow((1 - reflected) * n / (2 * (2 - n)), 2) * reflected, 1e-7);
}

TEST(RayImages, HaveAPairOnTheBrightSideOfABowAndOnTheDarkSide) {
  const RaysOfOrder rays(2, 1.333);
  const double bow = rays.turned_rad(*rays.bow_incidence_rad());
  const RayImages images =
      ray_images(1.333, 2, 500, std::vector<double>{bow - 0.05, bow, bow + 0.05});
  for (std::size_t i = 0; i < 3; ++i) {
    ASSERT_EQ(images.at(2, i).size(), 1u);
    EXPECT_TRUE(images.at(2, i)[0].is_pair());
  }
  EXPECT_GT(images.at(2, 0)[0].pair.zeta, 0);
  EXPECT_NEAR(images.at(2, 1)[0].pair.zeta, 0, 1e-6);
  EXPECT_LT(images.at(2, 2)[0].pair.zeta, 0);
}

TEST(RayImages, AirysVariableHasVanDeHulstsSlopeAtTheBow) {
  // z = -(theta - bow) x^(2/3) / h^(1/3), h = ((p^2-1)^2/p^2) ((p^2-n^2)/(n^2-1)^3)^(1/2): 1957,
  // section 13.23
  const double n = 1.333;
  for (int p = 2; p <= 3; ++p) {
    const RaysOfOrder rays(p, n);
    const double p2 = p * p,
                 h = (p2 - 1) * (p2 - 1) / p2 * std::sqrt((p2 - n * n) / std::pow(n * n - 1, 3));
    const double turned = rays.turned_rad(*rays.bow_incidence_rad());
    const double side = p == 2 ? 1 : -1, bow = p == 2 ? turned : 2 * pi - turned;
    const double d = 1e-4;
    const RayImages images =
        ray_images(n, p, 500, std::vector<double>{bow - side * d, bow + side * d});
    const double slope = (images.at(p, 1)[0].pair.zeta - images.at(p, 0)[0].pair.zeta) / (2 * d);
    EXPECT_NEAR(slope * std::cbrt(h), -1, 1e-4) << p;
  }
}

TEST(RayImages, PairsAreSmoothThroughTheBow) {
  const RaysOfOrder rays(2, 1.333);
  const double bow = rays.turned_rad(*rays.bow_incidence_rad());
  std::vector<double> angles;
  for (int i = -60; i <= 60; ++i) angles.push_back(bow + i * 1e-6);  // the formulas change at 1e-5
  const RayImages images = ray_images(1.333, 2, 500, angles);
  for (std::size_t i = 1; i + 1 < angles.size(); ++i) {
    const auto pair = [&](std::size_t j) { return images.at(2, j)[0].pair; };
    EXPECT_NEAR(pair(i - 1).zeta + pair(i + 1).zeta - 2 * pair(i).zeta, 0, 1e-9);
    EXPECT_NEAR(pair(i - 1).g0[0] + pair(i + 1).g0[0] - 2 * pair(i).g0[0], 0, 1e-6);
    EXPECT_NEAR(pair(i - 1).g1[1] + pair(i + 1).g1[1] - 2 * pair(i).g1[1], 0, 1e-5);
  }
}

TEST(RayImages, PairsBecomeTheirRaysFarFromTheBow) {
  const double x = 1e5, angle = radians(150);
  const RayImages images = ray_images(1.333, 2, 500, std::vector<double>{angle});
  const RayImage image = images.at(2, 0)[0];
  const double z = image.pair.zeta * std::pow(x, 2.0 / 3);
  ASSERT_LT(z, -100);
  // Means of Ai^2 and Ai'^2 over a fringe: 1/(2 pi sqrt(-z)), sqrt(-z)/(2 pi)
  for (int j = 0; j < 2; ++j) {
    const double pair =
        std::pow(x, 7.0 / 3) * std::pow(image.pair.g0[j], 2) / (2 * pi * std::sqrt(-z)) +
        std::pow(x, 5.0 / 3) * std::pow(image.pair.g1[j], 2) * std::sqrt(-z) / (2 * pi);
    const double rays =
        x * x * (std::pow(image.inner.amplitude[j], 2) + std::pow(image.outer.amplitude[j], 2));
    EXPECT_NEAR(pair / rays, 1, 1e-9) << j;
  }
}

}  // namespace arcus::phase
