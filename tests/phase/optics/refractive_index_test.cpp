#include "phase/optics/refractive_index.h"

#include <gtest/gtest.h>

#include <fstream>

#include "phase/base/error.h"

namespace arcus::phase {
namespace {

std::string message_of(const auto& act) {
  try {
    act();
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::input);
    return error.what();
  }
  return "no error";
}

bool contains(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST(RefractiveIndex, OfWaterIsDaimonAndMasumurasRelativeToAir) {
  const RefractiveIndex water = RefractiveIndex::water();
  // The fit at the sodium line, 20 C: 1.33335 absolute, 1.33298 in air (Appl. Opt. 46, 3811, 2007).
  EXPECT_NEAR(water.relative_to_air(589.3).real(), 1.33298, 5e-6);
  EXPECT_NEAR(water.relative_to_air(589.3).real() * air_index(589.3), 1.33335, 5e-6);
  // Absorption is least near 480 nm and rises steeply to the red.
  EXPECT_LT(water.relative_to_air(480).imag(), 2e-9);
  EXPECT_GT(water.relative_to_air(700).imag(), 3e-8);
}

TEST(RefractiveIndex, BetweenRowsStaysWithinTheStatedErrorOfTheFit) {
  const RefractiveIndex water = RefractiveIndex::water();
  // Daimon & Masumura 2007, table of the four-term Sellmeier fit at 20.0 C.
  const double a[] = {5.684027565e-1, 1.726177391e-1, 2.086189578e-2, 1.130748688e-1};
  const double b[] = {5.101829712e-3, 1.821153936e-2, 2.620722293e-2, 1.069792721e1};
  for (double nm = 301; nm < 1000; nm += 3.7) {
    const double l2 = nm * nm * 1e-6;
    double n2 = 1;
    for (int i = 0; i < 4; ++i) n2 += a[i] * l2 / (l2 - b[i]);
    EXPECT_NEAR(water.relative_to_air(nm).real(), std::sqrt(n2) / air_index(nm), 3e-6) << nm;
  }
}

TEST(RefractiveIndex, OfIceIsWarrenAndBrandtsRelativeToAir) {
  const auto m = RefractiveIndex::ice().relative_to_air(550);
  EXPECT_NEAR(m.real(), 1.3110 / air_index(550),
              1e-4);  // J. Geophys. Res. 113, D14220: 1.3110 at 550 nm
  EXPECT_GT(m.imag(), 1e-9);
  EXPECT_LT(m.imag(), 4e-9);
}

TEST(RefractiveIndex, InterpolatesNLinearlyAndKGeometrically) {
  const auto index =
      RefractiveIndex::from_text("nm,n,k\n500,1.3,1e-8\n600,1.4,1e-6\n700,1.4,0\n", "m.txt");
  const auto m = index.relative_to_air(550);
  EXPECT_DOUBLE_EQ(m.real(), 1.35);
  EXPECT_NEAR(m.imag(), 1e-7, 1e-15);
  EXPECT_DOUBLE_EQ(index.relative_to_air(650).imag(), 0.5e-6);  // k = 0 has no logarithm
  EXPECT_EQ(index.relative_to_air(500), std::complex<double>(1.3, 1e-8));
  EXPECT_EQ(index.relative_to_air(700), std::complex<double>(1.4, 0));
}

TEST(RefractiveIndex, ConstantIsTheSameEverywhere) {
  const auto index = RefractiveIndex::constant({1.5, 0.01});
  EXPECT_EQ(index.relative_to_air(1), std::complex<double>(1.5, 0.01));
  EXPECT_EQ(index.relative_to_air(1e6), std::complex<double>(1.5, 0.01));
}

TEST(RefractiveIndex, IsNotExtrapolated) {
  for (const double nm : {299.9, 1000.1, -1.0, std::nan("")})
    EXPECT_TRUE(contains(message_of([&] { RefractiveIndex::water().relative_to_air(nm); }),
                         "between 300 and 1000 nm"));
}

TEST(RefractiveIndex, RefusesWrongTables) {
  const auto refusal = [](const char* text) {
    return message_of([&] { RefractiveIndex::from_text(text, "m.txt"); });
  };
  EXPECT_TRUE(contains(refusal("500 1.3\n600 1.3\n"), "three"));
  EXPECT_TRUE(contains(refusal("500 1.3 0\n500 1.3 0\n"), "row 2"));
  EXPECT_TRUE(contains(refusal("500 1.3 0\n600 -1.3 0\n"), "above 0"));
  EXPECT_TRUE(contains(refusal("500 1.3 0\n600 1.3 -1e-9\n"), "at least 0"));
  EXPECT_TRUE(contains(refusal("500 1.3 0\n"), "at least two"));
  EXPECT_TRUE(contains(refusal("500 1.3 x\n"), "m.txt:1"));
  EXPECT_NE(message_of([] { RefractiveIndex::named("no_such_file.txt"); }), "no error");
}

TEST(RefractiveIndex, SizeParameterCountsTheAir) {
  // r 100 um at 550 nm: 2 pi r / wavelength = 1142.397 in vacuum, x n_air in air.
  EXPECT_NEAR(size_parameter(100, 550), 1142.3973 * 1.000278, 2e-3);
}

}  // namespace arcus::phase
