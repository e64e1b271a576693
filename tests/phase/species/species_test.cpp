#include "phase/species/species.h"

#include <gtest/gtest.h>

#include <cmath>

#include "phase/base/error.h"
#include "phase/base/whole_file.h"
#include "phase/species/make_species.h"
#include "tests/phase/species/scratch_folder.h"

namespace arcus::phase {
namespace {

std::shared_ptr<const Species> species_of(std::string_view text, double sun_angular_radius_rad = 0) {
  SpeciesOptions options;
  options.sun_angular_radius_rad = sun_angular_radius_rad;
  return make_species(recipe_from_text(text, "recipe.toml"), options);
}

Wavelengths at(float nm) { return {{nm, nm, nm, nm}}; }

/// Three sizes, three wavelengths, isotropic; extinction that tells size and wavelength.
ScatteringTable example() {
  ScatteringTable t;
  t.size_um = {10, 20, 80};
  t.wavelength_nm = {450, 550, 750};
  t.scattering_angle_deg = {0, 1, 180};
  for (const double size : t.size_um)
    for (const double nm : t.wavelength_nm) {
      t.extinction_cross_section_m2.push_back(size * (1 + (nm - 550) / 1000));
      t.forward_fraction.push_back(size > 50 ? 0.4 : 0);
      t.scattering_cross_section_m2.push_back(0.9 * t.extinction_cross_section_m2.back());
    }
  t.forward_angle_deg = 1;
  t.asymmetry.assign(9, 0);
  t.p11.assign(27, static_cast<float>(0.25 / pi));
  t.p12 = t.p33 = t.p34 = std::vector<float>(27, 0);
  return t;
}

}  // namespace

TEST(Species, ExtinctionIsRelativeToItsOwnAt550AndLessTheLobe) {
  const Species species(example(), {});
  EXPECT_NEAR(species.extinction_ratio(10, at(550))[0], 1, 1e-6);
  EXPECT_NEAR(species.extinction_ratio(10, at(650))[2], 1.1, 1e-6);
  EXPECT_NEAR(species.extinction_ratio(80, at(450))[3], 0.6 * 0.9, 1e-6);
  EXPECT_NEAR(species.albedo(10, at(500))[0], 0.9, 1e-6);
  EXPECT_NEAR(species.albedo(80, at(500))[0], 0.5 / 0.6, 1e-6);  // of what is left, (0.9 − 0.4)/(1 − 0.4)
  EXPECT_NEAR(species.forward_fraction(80, 500), 0.4, 1e-12);
  EXPECT_NEAR(species.largest_extinction_ratio(), 1.2, 1e-6);
}

TEST(Species, BetweenSizesWeightsAreLinearInTheLogarithm) {
  const Species species(example(), {});
  // 40 µm is in the middle between 20 and 80.
  EXPECT_NEAR(species.extinction_ratio(40, at(550))[0], 0.5 * (1 + 0.6), 1e-5);
  EXPECT_NEAR(species.forward_fraction(40, 550), 0.2, 1e-6);
  const auto node = [&](float size_um, float u) {
    // With extinction alike, the node shows in how much of a table of one peak is left; ask many and count instead.
    return species.phase_function(size_um, u).value({0, 0, 1}, {0, 0, 1}, at(550))[0];
  };
  EXPECT_GT(node(40, 0.49f), 0);
  EXPECT_GT(node(40, 0.51f), 0);
}

TEST(Species, ANodeIsDrawnAsOftenAsItsWeight) {
  ScatteringTable t = example();
  // The largest size scatters backwards only: its value straight on tells it from the others.
  for (std::size_t nm = 0; nm < 3; ++nm) {
    const std::size_t first = t.first(2, nm);
    t.p11[first] = t.p11[first + 1] = 0;
    t.p11[first + 2] = static_cast<float>(0.5 / pi);
  }
  const Species species(t, {});
  int large = 0;
  for (int i = 0; i < 1000; ++i)
    large += species.phase_function(30, (static_cast<float>(i) + 0.5f) / 1000).value({0, 0, 1}, {0, 0, 1}, at(550))[0] < 0.01;
  EXPECT_NEAR(large, 1000 * std::log(1.5) / std::log(4.0), 1);
}

TEST(Species, SizesAndWavelengthsOutsideAreThoseAtTheEnd) {
  const Species species(example(), {});
  EXPECT_EQ(species.extinction_ratio(1, at(550))[0], species.extinction_ratio(10, at(550))[0]);
  EXPECT_EQ(species.extinction_ratio(1000, at(550))[0], species.extinction_ratio(80, at(550))[0]);
  EXPECT_EQ(species.extinction_ratio(0, at(550))[0], species.extinction_ratio(10, at(550))[0]);
  EXPECT_EQ(species.extinction_ratio(20, at(300))[0], species.extinction_ratio(20, at(450))[0]);
  EXPECT_EQ(species.extinction_ratio(20, at(900))[0], species.extinction_ratio(20, at(750))[0]);
  EXPECT_EQ(species.smallest_size_um(), 10);
  EXPECT_EQ(species.largest_size_um(), 80);
}

TEST(Species, ExtinctionStaysBelowItsBoundEverywhere) {
  const Species species(example(), {});
  for (float size = 5; size < 200; size *= 1.07f)
    for (float nm = 380; nm < 790; nm += 7)
      ASSERT_LE(species.extinction_ratio(size, at(nm))[0], species.largest_extinction_ratio());
}

TEST(MakeSpecies, ClosedFormsNeedNoTable) {
  const auto hg = species_of("type = 'hg'\ng = 0.5");
  EXPECT_EQ(hg->table(), nullptr);
  EXPECT_EQ(hg->extinction_ratio(10, at(400))[0], 1);
  EXPECT_EQ(hg->albedo(10, at(400))[0], 1);
  EXPECT_EQ(hg->largest_extinction_ratio(), 1);
  EXPECT_NEAR(hg->phase_function(10, 0.5f).value({0, 0, 1}, {0, 0, 1}, at(550))[0], 1.5 / 0.25 / (4 * pi), 1e-4);
  EXPECT_NEAR(species_of("type = 'isotropic'")->phase_function(1, 0).value({0, 0, 1}, {1, 0, 0}, at(550))[0],
              0.25 / pi, 1e-6);
  EXPECT_NEAR(species_of("type = 'rayleigh'")->extinction_ratio(1, at(440))[0], std::pow(1.25, 4), 0.01);
}

TEST(MakeSpecies, ATableFromAFileIsLinearInAngleAndRenormalised) {
  const ScratchFolder folder;
  write_whole_file(folder.path("c.txt"), "# angle value\n0, 3\n90, 2\n180, 1\n");
  const auto species = species_of("type = 'table'\nfile = '" + folder.path("c.txt") + "'");
  // 2π ∫ (3 − θ/90°) sin θ dθ = 8π.
  const PhaseFunction function = species->phase_function(1, 0);
  EXPECT_NEAR(function.value({0, 0, 1}, {0, 0, 1}, at(550))[0], 3 / (8 * pi), 1e-4 * 3);
  const double half = std::sqrt(0.5);
  EXPECT_NEAR(function.value({0, 0, 1}, {half, 0, half}, at(700))[0], 2.5 / (8 * pi), 1e-4 * 3);
  EXPECT_EQ(species->albedo(1, at(550))[0], 1);
}

TEST(MakeSpecies, TablesThatAreNoneAreRefused) {
  const ScratchFolder folder;
  const auto refusal = [&](const std::string& content) -> std::string {
    write_whole_file(folder.path("c.txt"), content);
    try {
      species_of("type = 'table'\nfile = '" + folder.path("c.txt") + "'");
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::input);
      return error.what();
    }
    return "";
  };
  EXPECT_NE(refusal("0 1\n170 1\n").find("must reach from 0 to 180"), std::string::npos);
  EXPECT_NE(refusal("0 1\n90 -1\n180 1\n").find("at least 0"), std::string::npos);
  EXPECT_NE(refusal("0 0\n180 0\n").find("zero"), std::string::npos);
  EXPECT_NE(refusal("0 1 1\n180 1 1\n").find("names"), std::string::npos);
  EXPECT_NE(refusal("0 1\n90 1\n90 1\n180 1\n").find("ascending"), std::string::npos);
  EXPECT_EQ(refusal("0 1\n180 1\n"), "");
}

TEST(MakeSpecies, ComputesOnceAndReadsAfterwards) {
  const ScratchFolder folder;
  const Recipe recipe = recipe_from_text("size_um = 1\nwavelength_nm = [500, 600]\nradii = 300", "recipe.toml");
  SpeciesOptions options;
  options.cache_folder = folder.folder();
  std::string told;
  options.log = [&](std::string_view line) { told.append(line).append("\n"); };
  const auto first = make_species(recipe, options);
  EXPECT_NE(told.find("computing"), std::string::npos);
  told.clear();
  const auto second = make_species(recipe, options);
  EXPECT_EQ(told, "");
  ASSERT_NE(second->table(), nullptr);
  EXPECT_EQ(first->table()->p11, second->table()->p11);
  EXPECT_EQ(first->largest_extinction_ratio(), second->largest_extinction_ratio());
}

TEST(MakeSpecies, WavelengthsBeyondTheOpticalConstantsAreRefused) {
  EXPECT_THROW(species_of("size_um = 1\nwavelength_nm = [250, 500]"), Error);
}

}  // namespace arcus::phase
