#include "media/air/haze.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "phase/base/error.h"
#include "phase/base/quadrature.h"
#include "phase/base/units.h"

namespace arcus::media {
namespace {

Wavelengths visible() {
  Wavelengths wavelengths;
  wavelengths.nm = {400, 550, 650, 750};
  return wavelengths;
}

/// 2π ∫ p cos θ d cos θ with nodes that crowd around straight on.
Spectrum asymmetry(const phase::PhaseFunction& function, const Wavelengths& wavelengths) {
  const Quadrature rule = gauss_legendre(400);
  Spectrum sum;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    const double t = 0.5 * (1 + rule.nodes[i]), theta = pi * t * t * t;
    const double weight = 0.5 * rule.weights[i] * 3 * pi * t * t * std::sin(theta) * 2 * pi * std::cos(theta);
    sum += function.value({0, 0, 1}, {std::sin(theta), 0, std::cos(theta)}, wavelengths) * static_cast<float>(weight);
  }
  return sum;
}

/// Of the OPAC files for each component at 80 % relative humidity (Hess et al. 1998): extinction of one particle in a cubic centimetre at 550 nm [1/km],
/// its ratio at 400, 650 and 750 nm to that, share scattered and mean cosine at 550 nm.
struct Published {
  double extinction_per_km, at_400, at_650, at_750, albedo, asymmetry;
};
const std::map<std::string, Published> opac{
    {"water-soluble", {9.584e-6, 1.485, 0.7847, 0.6264, 0.9843, 0.704}}, {"insoluble", {8.496e-3, 0.9748, 1.016, 1.031, 0.7300, 0.831}},
    {"soot", {5.540e-7, 1.555, 0.7906, 0.6445, 0.2088, 0.336}},          {"sea salt, accumulation", {3.743e-3, 0.9508, 1.025, 1.044, 1.000, 0.784}},
    {"sea salt, coarse", {0.2185, 0.9925, 1.007, 1.015, 1.000, 0.858}},  {"mineral, nucleation", {7.140e-5, 1.2616, 0.8412, 0.7055, 0.9671, 0.664}},
    {"mineral, accumulation", {3.121e-3, 0.9513, 1.031, 1.056, 0.8783, 0.734}}, {"mineral, coarse", {7.798e-2, 0.9878, 1.008, 1.014, 0.6659, 0.895}}};

TEST(Haze, ModesAreThoseOfOpac) {
  std::map<std::string, HazeMode> modes;
  for (const char* type : {"continental", "maritime", "desert"})
    for (const HazeMode& mode : haze_modes(type)) modes[mode.name] = mode;
  ASSERT_EQ(modes.size(), opac.size());
  for (const auto& [name, mode] : modes) {
    const Published& expected = opac.at(name);
    phase::Recipe recipe = recipe_of(mode);
    recipe.radii = 3000;
    const auto species = phase::make_species(recipe, {});
    const auto size = static_cast<float>(recipe.size_um[0]);
    const double extinction_m2 = phase::cross_sections_at_550_nm_m2(*species->table())[0];
    EXPECT_NEAR(extinction_m2 * 1e6 * 1000 / expected.extinction_per_km, 1, 0.02) << name;
    const Spectrum ratio = species->extinction_ratio(size, visible());
    // k of two components is constant here and not quite so there.
    EXPECT_NEAR(static_cast<double>(ratio[0]), expected.at_400, 0.03 * expected.at_400) << name;
    EXPECT_NEAR(static_cast<double>(ratio[2]), expected.at_650, 0.02 * expected.at_650) << name;
    EXPECT_NEAR(static_cast<double>(ratio[3]), expected.at_750, 0.02 * expected.at_750) << name;
    EXPECT_NEAR(static_cast<double>(species->albedo(size, visible())[1]), expected.albedo, 0.01) << name;
    EXPECT_NEAR(static_cast<double>(asymmetry(species->phase_function(size, 0), visible())[1]), expected.asymmetry, 0.02) << name;
  }
}

TEST(Haze, VisibilityIsKoschmiedersOverCleanAir) {
  HazeSettings settings{.type = "continental", .optical_depth = 0.3, .visibility_m = 0, .scale_height_m = 1000};
  EXPECT_EQ(haze_depth_550(settings, 2.5e25), 0.3);
  settings.visibility_m = 20000;
  // 3.912 / 20 km less 1.15e-2 / km of the molecules, times 1 km.
  EXPECT_NEAR(haze_depth_550(settings, 2.5469e25), 0.1956 - 0.0115, 2e-4);
  settings.visibility_m = 400000;
  EXPECT_LT(haze_depth_550(settings, 2.5469e25), 0);
}

TEST(Haze, UnknownTypesAreRefused) { EXPECT_THROW(haze_modes("urban"), Error); }

}  // namespace
}  // namespace arcus::media
