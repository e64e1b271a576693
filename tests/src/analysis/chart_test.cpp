#include "src/analysis/chart.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace arcus::render {
namespace {

std::vector<std::string> labels_of(const Scale& scale, int wanted) {
  std::vector<std::string> labels;
  for (const Tick& tick : scale.ticks(wanted))
    if (!tick.label.empty()) labels.push_back(tick.label);
  return labels;
}

}  // namespace

TEST(Axis, LinearTicksAreRoundNumbers) {
  const std::vector<double> values{0.013, 0.94};
  const Scale scale({"", false}, values, false);
  EXPECT_EQ(scale.low(), 0);
  EXPECT_EQ(scale.high(), 1);
  EXPECT_EQ(labels_of(scale, 5),
            (std::vector<std::string>{"0.0", "0.2", "0.4", "0.6", "0.8", "1.0"}));
}

TEST(Axis, AnglesAreDividedAsACircleIs) {
  const std::vector<double> values{0, 180};
  EXPECT_EQ(
      labels_of(Scale({"", false}, values, true), 9),
      (std::vector<std::string>{"0", "20", "40", "60", "80", "100", "120", "140", "160", "180"}));
  EXPECT_EQ(labels_of(Scale({"", false}, values, true), 6),
            (std::vector<std::string>{"0", "30", "60", "90", "120", "150", "180"}));
}

TEST(Axis, LogarithmicTicksArePowersOfTenAndIgnoreWhatHasNoLogarithm) {
  const std::vector<double> values{0, -3, 0.002, 40, std::nan("")};
  const Scale scale({"", true}, values, false);
  EXPECT_NEAR(scale.low(), 1e-3, 1e-15);
  EXPECT_NEAR(scale.high(), 100, 1e-12);
  EXPECT_EQ(labels_of(scale, 6),
            (std::vector<std::string>{"10⁻³", "10⁻²", "10⁻¹", "10⁰", "10¹", "10²"}));
  EXPECT_FALSE(scale.position(0));
  EXPECT_NEAR(*scale.position(1), 0.6, 1e-12);
}

TEST(Axis, NarrowLogarithmicRangesStillHaveNumbers) {
  const std::vector<double> values{0.3, 0.9};
  EXPECT_GE(labels_of(Scale({"", true}, values, false), 5).size(), 3u);
}

TEST(Axis, ConstantAndEmptyDataHaveARange) {
  for (const bool is_logarithmic : {false, true})
    for (const std::vector<double>& values : {std::vector<double>{}, {5, 5}, {0}}) {
      const Scale scale({"", is_logarithmic}, values, false);
      EXPECT_LT(scale.low(), scale.high());
      EXPECT_FALSE(scale.ticks(5).empty());
    }
}

TEST(Chart, IsAPngOfTwicePointsWhateverTheData) {
  LineChart chart;
  chart.title = "Nothing but trouble";
  chart.y_axis.is_logarithmic = true;
  chart.lines.push_back(
      {"odd", {0, 1, 2, 3}, {0, std::nan(""), -1, 1e300}, {1, 1, 1, 1}, {1, 0, 0}});
  chart.lines.push_back({"empty", {}, {}, {}, {0, 0, 1}});
  chart.strips.push_back({"colours", {0, 3}, {{1, 0, 0}, {-1, 2, 7}}});
  chart.marks.push_back({99, "outside"});
  chart.width = 300;
  chart.height = 200;
  const std::string png = png_of(chart);
  ASSERT_GT(png.size(), 100u);
  EXPECT_EQ(png.substr(1, 3), "PNG");
  const auto big_endian = [&](std::size_t at) {
    return static_cast<unsigned char>(png[at + 2]) * 256 + static_cast<unsigned char>(png[at + 3]);
  };
  EXPECT_EQ(big_endian(16), 600);
  EXPECT_EQ(big_endian(20), 400);
  EXPECT_EQ(png_of(chart), png) << "the same chart gives the same bytes";
  PolarChart polar;
  polar.radius_axis.is_logarithmic = true;
  polar.lines = chart.lines;
  EXPECT_EQ(png_of(polar).substr(1, 3), "PNG");
}

TEST(Chart, WavelengthsHaveTheirColours) {
  const Ink red = ink_of_wavelength(640), green = ink_of_wavelength(530),
            blue = ink_of_wavelength(450);
  EXPECT_GT(red.r, red.g + 0.3);
  EXPECT_GT(green.g, green.r + 0.2);
  EXPECT_GT(blue.b, blue.r + 0.2);
}

}  // namespace arcus::render
