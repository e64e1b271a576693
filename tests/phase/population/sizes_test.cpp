#include "phase/population/sizes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "phase/base/error.h"
#include "phase/base/quadrature.h"
#include "phase/base/units.h"
#include "phase/settings/toml_text.h"

namespace arcus::phase {
namespace {

struct Case {
  SizesSettings settings;
  double effective_radius_um;
};

std::vector<Case> every_kind() {
  return {{{.type = "gamma", .variance = 0.1}, 10},
          {{.type = "gamma", .variance = 0.01}, 500},
          {{.type = "gamma", .variance = 0.4}, 3},
          {{.type = "lognormal", .variance = 0.2}, 7},
          {{.type = "modified_gamma", .alpha = 8, .gamma = 3}, 4.31},
          {{.type = "marshall_palmer"}, 513}};
}

std::vector<double> log_grid(double low, double high, int nodes) {
  std::vector<double> r;
  for (int i = 0; i < nodes; ++i) r.push_back(low * std::pow(high / low, i / (nodes - 1.0)));
  return r;
}

std::string refusal(const SizesSettings& settings, double effective_radius_um) {
  try {
    Sizes sizes(settings, effective_radius_um);
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::input);
    return error.what();
  }
  return "no error";
}

}  // namespace

TEST(Sizes, HaveTheEffectiveRadiusAndVarianceAskedFor) {
  for (const Case& c : every_kind()) {
    const Sizes sizes(c.settings, c.effective_radius_um);
    EXPECT_NEAR(sizes.effective_radius_um() / c.effective_radius_um, 1, 1e-10) << c.settings.type;
    if (c.settings.type == "gamma" || c.settings.type == "lognormal") {
      EXPECT_NEAR(sizes.effective_variance() / c.settings.variance, 1, 1e-8) << c.settings.type;
    }
  }
}

TEST(Sizes, MomentsAreTheIntegralsOfTheDensity) {
  for (const Case& c : every_kind()) {
    const Sizes sizes(c.settings, c.effective_radius_um);
    const auto range = sizes.range_um(1e-9);
    for (const double order : {1.0, 2.0, 3.0, 4.0}) {
      const double expected = sizes.mean_power_um(order);
      const double integral = integrate(
          [&](double u) {
            return std::pow(std::exp(u), order + 1) * sizes.number_per_um(std::exp(u));
          },
          std::log(range.low_um * 0.01), std::log(range.high_um * 1.3), 1e-9 * expected);
      EXPECT_NEAR(integral / expected, 1, 2e-6) << c.settings.type << " <r^" << order << ">";
    }
    EXPECT_NEAR(sizes.mean_power_um(0), 1, 1e-12);
  }
}

TEST(Sizes, RangeLeavesOutTheShareOfCrossSectionAskedFor) {
  for (const Case& c : every_kind())
    for (const double share : {1e-6, 1e-4}) {
      const Sizes sizes(c.settings, c.effective_radius_um);
      const auto range = sizes.range_um(share);
      const double inside = integrate(
          [&](double u) { return std::exp(3 * u) * sizes.number_per_um(std::exp(u)); },
          std::log(range.low_um), std::log(range.high_um), 1e-10 * sizes.mean_power_um(2));
      EXPECT_NEAR((1 - inside / sizes.mean_power_um(2)) / share, 1, 1e-3) << c.settings.type;
    }
}

TEST(Sizes, WeightsKeepTheCrossSectionOnAnyGrid) {
  for (const Case& c : every_kind())
    for (const int nodes : {12, 100, 3000}) {
      const Sizes sizes(c.settings, c.effective_radius_um);
      const auto range = sizes.range_um(1e-6);
      const auto r = log_grid(range.low_um, range.high_um, nodes);
      const auto w = sizes.weights(r);
      double second = 0;
      for (std::size_t i = 0; i < r.size(); ++i) {
        EXPECT_GE(w[i], 0);
        second += w[i] * r[i] * r[i];
      }
      EXPECT_NEAR(second / sizes.mean_power_um(2), 1, 2e-6) << c.settings.type << " " << nodes;
    }
}

TEST(Sizes, WeightsConvergeForOtherMoments) {
  for (const Case& c : every_kind()) {
    const Sizes sizes(c.settings, c.effective_radius_um);
    const auto range = sizes.range_um(1e-7);
    const auto r = log_grid(range.low_um, range.high_um, 400);
    const auto w = sizes.weights(r);
    double third = 0, between = 0;
    for (std::size_t i = 0; i < r.size(); ++i) {
      third += w[i] * std::pow(r[i], 3);
      between += w[i] * std::pow(r[i], 2.5);
    }
    EXPECT_NEAR(third / sizes.mean_power_um(3), 1, 1e-4) << c.settings.type;
    EXPECT_NEAR(between / sizes.mean_power_um(2.5), 1, 1e-4) << c.settings.type;
  }
}

TEST(Sizes, GridsThatCoverPartOfTheRangeGetThatPart) {
  const Sizes sizes({.type = "marshall_palmer"}, 500);
  const auto r = log_grid(100, 1000, 200);
  const auto w = sizes.weights(r);
  double second = 0;
  for (std::size_t i = 0; i < r.size(); ++i) second += w[i] * r[i] * r[i];
  const double share = sizes.cross_section_share_below(1000) - sizes.cross_section_share_below(100);
  EXPECT_NEAR(second / sizes.mean_power_um(2), share, 1e-6);
}

TEST(Sizes, OneSizeSharesItsWeightBetweenItsNeighbours) {
  const Sizes sizes({.type = "monodisperse"}, 10);
  EXPECT_EQ(sizes.effective_radius_um(), 10);
  const auto at_node = sizes.weights(std::vector<double>{5, 10, 20});
  EXPECT_DOUBLE_EQ(at_node[1], 1);
  EXPECT_DOUBLE_EQ(at_node[0] + at_node[2], 0);
  const auto between = sizes.weights(std::vector<double>{9, 11, 12});
  EXPECT_NEAR(between[0] * 81 + between[1] * 121, 100, 1e-12);
}

// Marshall & Palmer, J. Meteor. 5, 165 (1948): Lambda = 4.1 R^-0.21 per mm; the other columns
// follow with N0 = 8000.
TEST(MarshallPalmer, HasItsSlopeRadiusWaterAndExtinction) {
  struct Row {
    double rain_mm_per_hour, slope_per_mm, effective_radius_mm, water_g_per_m3, extinction_per_km;
  };
  for (const Row& row : {Row{1, 4.100, 0.37, 0.089, 0.365}, Row{5, 2.924, 0.51, 0.344, 1.005},
                         Row{25, 2.086, 0.72, 1.329, 2.771}, Row{50, 1.803, 0.83, 2.378, 4.288}}) {
    EXPECT_NEAR(marshall_palmer_slope_per_mm(row.rain_mm_per_hour), row.slope_per_mm, 5.1e-4);
    const Sizes sizes({.type = "marshall_palmer", .rain_mm_per_hour = row.rain_mm_per_hour}, 1);
    EXPECT_NEAR(mm_from_um(sizes.effective_radius_um()), row.effective_radius_mm, 5.1e-3);
    EXPECT_NEAR(sizes.effective_variance(), 1 / 3.0, 1e-9);
    const double per_m3 = marshall_palmer_drops_per_m3(row.rain_mm_per_hour);
    EXPECT_NEAR(4 * pi / 3 * sizes.mean_power_um(3) * 1e-12 * per_m3, row.water_g_per_m3, 5.1e-4);
    EXPECT_NEAR(2 * pi * sizes.mean_power_um(2) * 1e-12 * per_m3 * 1000, row.extinction_per_km,
                5.1e-4);
    EXPECT_NEAR(
        marshall_palmer_rain_mm_per_hour(sizes.effective_radius_um()) / row.rain_mm_per_hour, 1,
        1e-9);
  }
}

// D. Deirmendjian, Electromagnetic Scattering on Spherical Polydispersions (1969); E. P. Shettle
// and R. W. Fenn, AFGL-TR-79-0214 (1979): n(r) = a r^alpha exp(-b r^gamma) with a total number that
// they state.
TEST(ModifiedGamma, GivesTheLiteraturesHazesCloudsAndFogs) {
  struct Row {
    const char* name;
    double a, alpha, b, gamma, number_per_cm3, effective_radius_um, effective_variance;
  };
  for (const Row& row :
       {Row{"Cloud C.1", 2.373, 6, 1.5, 1, 100, 6, 0.111},
        Row{"Cloud C.2", 0.010851, 8, 0.041667, 3, 100, 4.31, 0.0321},
        Row{"Cloud C.3", 5.5556, 8, 0.33333, 3, 100, 2.16, 0.0321},
        Row{"Haze M", 53333, 1, 8.9443, 0.5, 100, 0.9, 0.528},
        Row{"Haze L", 4.9757e6, 2, 15.119, 0.5, 100, 0.481, 0.418},
        Row{"Haze H", 4e5, 2, 20, 1, 100, 0.25, 0.2}, Row{"Fog 1", 0.027, 3, 0.3, 1, 20, 20, 0.167},
        Row{"Fog 4", 607.5, 6, 3, 1, 200, 3, 0.111}}) {
    const SizesSettings settings{.type = "modified_gamma", .alpha = row.alpha, .gamma = row.gamma};
    const Sizes sizes(settings, row.effective_radius_um);
    EXPECT_NEAR(sizes.effective_variance(), row.effective_variance, 5.1e-4) << row.name;
    // a and b return where the effective radius has the digits printed
    const double r = row.effective_radius_um;
    const double printed =
        row.a * std::pow(r, row.alpha) * std::exp(-row.b * std::pow(r, row.gamma));
    EXPECT_NEAR(sizes.number_per_um(r) * row.number_per_cm3 / printed, 1, 2e-2) << row.name;
  }
}

TEST(Sizes, RefusalsNameTheKey) {
  EXPECT_NE(refusal({.type = "gamma", .variance = 0.5}, 10).find("variance"), std::string::npos);
  EXPECT_NE(refusal({.type = "gamma", .variance = -0.1}, 10).find("variance"), std::string::npos);
  EXPECT_NE(refusal({.type = "lognormal", .variance = 0}, 10).find("variance"), std::string::npos);
  EXPECT_NE(refusal({}, -10).find("size_um"), std::string::npos);
  EXPECT_NE(refusal({}, std::nan("")).find("size_um"), std::string::npos);
  EXPECT_NE(refusal({.type = "modified_gamma", .alpha = -1}, 10).find("alpha"), std::string::npos);
  EXPECT_NE(refusal({.type = "modified_gamma", .gamma = 0}, 10).find("gamma"), std::string::npos);
  EXPECT_NE(refusal({.type = "uniform"}, 10).find("type"), std::string::npos);
}

TEST(Sizes, SettingsSurviveWritingAndReading) {
  for (const Case& c : every_kind()) {
    const std::string text = text_of(c.settings);
    EXPECT_EQ(text_of(settings_from_text<SizesSettings>(text, "sizes.toml")), text);
  }
  EXPECT_THROW(settings_from_text<SizesSettings>("type = 'gamma'\nvariance = 0.5\n", "sizes.toml"),
               Error);
  EXPECT_THROW(settings_from_text<SizesSettings>("type = 'gama'\n", "sizes.toml"), Error);
}

}  // namespace arcus::phase
