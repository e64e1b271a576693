#include "phase/species/evaluate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "phase/base/error.h"
#include "phase/base/units.h"
#include "phase/species/make_species.h"

namespace arcus::phase {
namespace {

MatrixRow row_of(std::string_view text, const std::vector<double>& angles) { return evaluate_recipe(recipe_from_text(text, "recipe"), 10, 550, angles); }

/// 2π ∫ f(θ) weight(cos θ) sin θ dθ by Simpson's rule in cos θ.
template <class Weight>
double over_sphere(std::string_view text, const Weight& weight) {
  constexpr int n = 4000;
  std::vector<double> angles;
  for (int i = 0; i <= n; ++i) angles.push_back(degrees(std::acos(std::clamp(1 - 2.0 * i / n, -1.0, 1.0))));
  const MatrixRow row = row_of(text, angles);
  double sum = 0;
  for (int i = 0; i <= n; ++i)
    sum += (i == 0 || i == n ? 1 : i % 2 ? 4 : 2) * row.p11[static_cast<std::size_t>(i)] * weight(1 - 2.0 * i / n);
  return 2 * pi * sum * (2.0 / n) / 3;
}

TEST(EvaluateRecipe, ClosedFormsIntegrateToOneAndHaveTheirAsymmetry) {
  for (const char* text : {"type = 'isotropic'", "type = 'rayleigh'", "type = 'rayleigh'\ndepolarisation = 0", "type = 'rayleigh'\ndepolarisation = 0.8",
                           "type = 'hg'\ng = 0.6", "type = 'hg'\ng = -0.3", "type = 'hg'\ng = 0"}) {
    EXPECT_NEAR(over_sphere(text, [](double) { return 1.0; }), 1, 1e-6) << text;
    EXPECT_NEAR(over_sphere(text, [](double cosine) { return cosine; }), row_of(text, {0}).asymmetry, 1e-6) << text;
  }
  EXPECT_NEAR(row_of("type = 'hg'\ng = 0.6", {0}).asymmetry, 0.6, 1e-12);
}

TEST(EvaluateRecipe, DepolarisationIsThatOfNaturalLightScatteredAtRightAngles) {
  for (const double rho : {0.0, 0.0279, 0.3, 0.857}) {
    const MatrixRow row = row_of("type = 'rayleigh'\ndepolarisation = " + std::to_string(rho), {90});
    // Intensities along and across the plane: (P11 + P12) and (P11 − P12), halved; their ratio is ρ by definition.
    EXPECT_NEAR((row.p11[0] + row.p12[0]) / (row.p11[0] - row.p12[0]), rho, 2e-6);
  }
  // The default is that of air: A. T. Young, Appl. Opt. 19, 3427 (1980).
  EXPECT_EQ(recipe_from_text("type = 'rayleigh'", "recipe").depolarisation, 0.0279);
}

TEST(EvaluateRecipe, NoClosedFormPolarisesMoreThanThereIs) {
  std::vector<double> angles(181);
  std::iota(angles.begin(), angles.end(), 0);
  for (const char* text : {"type = 'isotropic'", "type = 'rayleigh'", "type = 'rayleigh'\ndepolarisation = 0", "type = 'hg'\ng = 0.9"}) {
    const MatrixRow row = row_of(text, angles);
    for (std::size_t i = 0; i < angles.size(); ++i)
      EXPECT_LE(std::hypot(row.p12[i], row.p33[i], row.p34[i]), row.p11[i] * (1 + 1e-12)) << text << " at " << angles[i];
  }
  // Molecules without depolarisation polarise light at 90° completely, and not at all straight on.
  const MatrixRow pure = row_of("type = 'rayleigh'\ndepolarisation = 0", {0, 90});
  EXPECT_NEAR(pure.p12[1], -pure.p11[1], 1e-12);
  EXPECT_NEAR(pure.p12[0], 0, 1e-12);
}

TEST(EvaluateRecipe, AgreesWithWhatARendererReads) {
  for (const char* text : {"type = 'isotropic'", "type = 'rayleigh'", "type = 'hg'\ng = 0.7"}) {
    const auto species = make_species(recipe_from_text(text, "recipe"), {});
    for (const double angle : {0.0, 12.0, 90.0, 133.0, 180.0}) {
      const Vec3 out(std::sin(radians(angle)), 0, std::cos(radians(angle)));
      const double expected = row_of(text, {angle}).p11[0];
      EXPECT_NEAR(species->phase_function(1, 0).value({0, 0, 1}, out, {{550, 550, 550, 550}})[0], expected, 1e-5 * expected) << text << " at " << angle;
    }
  }
}

TEST(EvaluateRecipe, RefusesWhatItCannotCompute) {
  EXPECT_THROW(row_of("type = 'hg'", {181}), Error);
  EXPECT_THROW(row_of("type = 'hg'", {std::nan("")}), Error);
  EXPECT_THROW(row_of("type = 'table'\nfile = 'a.txt'", {0}), Error);
}

}  // namespace
}  // namespace arcus::phase
