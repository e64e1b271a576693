#include "phase/species/recipe.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "phase/base/error.h"
#include "phase/base/whole_file.h"
#include "phase/settings/toml_text.h"
#include "tests/phase/species/scratch_folder.h"

namespace arcus::phase {
namespace {

std::string refusal(std::string_view text) {
  try {
    recipe_from_text(text, "recipe.toml");
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::input);
    return error.what();
  }
  return "";
}

bool contains(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST(Recipe, EveryKeyHasADefault) {
  const Recipe mie = recipe_from_text("", "recipe.toml");
  EXPECT_EQ(mie.type, "mie");
  EXPECT_EQ(mie.material, "water");
  EXPECT_EQ(mie.distribution.type, "gamma");
  EXPECT_EQ(mie.wavelength_nm.size(), 41u);
  EXPECT_EQ(mie.wavelength_nm[1], 390);
  for (std::size_t i = 1; i < mie.size_um.size(); ++i) EXPECT_LT(mie.size_um[i] / mie.size_um[i - 1], 1.101);
  EXPECT_EQ(recipe_from_text("type = 'hg'", "recipe.toml").g, 0.85);
  EXPECT_EQ(recipe_from_text("type = 'rayleigh'", "recipe.toml").depolarisation, 0.0279);
}

TEST(Recipe, ATypeBringsItsDefaultsWhereTheTextIsSilent) {
  const Recipe rain = recipe_from_text("type = 'rain'", "recipe.toml");
  EXPECT_EQ(rain.distribution.type, "marshall_palmer");
  EXPECT_EQ(rain.size_um.front(), 150);
  EXPECT_EQ(rain.size_um.back(), 1000);
  const Recipe sorted = recipe_from_text(
      "size_um = 500\ntype = 'rain'\ndistribution = { type = 'gamma', variance = 0.01 }", "recipe.toml");
  EXPECT_EQ(sorted.distribution.type, "gamma");
  EXPECT_EQ(sorted.distribution.variance, 0.01);
  EXPECT_EQ(sorted.size_um, std::vector<double>{500});
}

TEST(Recipe, AHabitBringsHowCrystalsAreShapedAndLie) {
  const Recipe column = recipe_from_text("type = 'crystal'\nhabit = 'column'\norientation = { tilt_deg = 3 }", "recipe.toml");
  EXPECT_EQ(column.material, "ice");
  EXPECT_EQ(column.crystal.habit.aspect_ratio, 2.5);
  EXPECT_EQ(column.crystal.orientation.type, "column");
  EXPECT_EQ(column.crystal.orientation.tilt_deg, 3);
  EXPECT_TRUE(column.is_oriented());
  EXPECT_FALSE(recipe_from_text("type = 'crystal'\nhabit = 'prism'", "recipe.toml").is_oriented());
}

TEST(Recipe, ARainRateDecidesTheSize) {
  const Recipe recipe = recipe_from_text("type = 'rain'\ndistribution = { rain_mm_per_hour = 10 }", "recipe.toml");
  ASSERT_EQ(recipe.size_um.size(), 1u);
  EXPECT_NEAR(recipe.size_um[0], 1500 / 4.1 * std::pow(10, 0.21), 0.01);
}

TEST(Recipe, SizesAreSpacedLogarithmicallyAndWavelengthsEvenly) {
  const Recipe recipe = recipe_from_text(
      "size_um = { min = 5, max = 20, nodes = 3 }\nwavelength_nm = { min = 400, max = 700, nodes = 4 }", "recipe.toml");
  EXPECT_NEAR(recipe.size_um[1], 10, 1e-12);
  EXPECT_NEAR(recipe.wavelength_nm[1], 500, 1e-12);
}

TEST(Recipe, CanonicalTextReadsBackTheSameForEveryType) {
  for (const char* text : {"", "type = 'rain'", "type = 'hg'\ng = -0.3", "type = 'isotropic'", "type = 'rayleigh'",
                           "type = 'table'\nfile = 'c1.txt'", "material = { n = 1.5, k = 0.01 }",
                           "type = 'rain'\ndistribution = { rain_mm_per_hour = 5 }\nforward_lobe = 'scatter'",
                           "distribution = { type = 'lognormal', variance = 0.2 }\noptics = 'geometric'", "type = 'crystal'",
                           "type = 'crystal'\nhabit = 'triangle'\naspect_spread = 0.2\norientation = { tilt_deg = 3 }",
                           "type = 'crystal'\nhabit = 'pyramid'\nlower_pyramid = { height = 0 }\nsize_um = [30, 100]"}) {
    const std::string canonical = text_of(recipe_from_text(text, "recipe.toml"));
    EXPECT_EQ(text_of(recipe_from_text(canonical, "canonical")), canonical) << text;
  }
}

TEST(Recipe, MistakesAreNamedWithTheirPlace) {
  EXPECT_TRUE(contains(refusal("type = 'mei'"), "recipe.toml:1:8: type")) << refusal("type = 'mei'");
  EXPECT_TRUE(contains(refusal("type = 'mei'"), "Did you mean 'mie'"));
  EXPECT_TRUE(contains(refusal("type = 'crystals'"), "isotropic, rayleigh, table, mie, rain or crystal"));
  EXPECT_TRUE(contains(refusal("\nsize_um = [-5, 10]"), "recipe.toml:2:12: size_um: -5 found"));
  EXPECT_TRUE(contains(refusal("size_mm = 5"), "Did you mean 'size_um'"));
  EXPECT_TRUE(contains(refusal("type = 'hg'\ng = 1"), "g: 1 found; must be above -1 and below 1"));
  EXPECT_TRUE(contains(refusal("type = 'table'"), "file: nothing found"));
  EXPECT_TRUE(contains(refusal("distribution = { variance = 0.5 }"), "must be below 0.5"));
}

TEST(Recipe, FilesAreRelativeToTheRecipe) {
  const ScratchFolder folder;
  write_whole_file(folder.path("recipe.toml"), "type = 'table'\nfile = 'c1.txt'\n");
  EXPECT_EQ(recipe_from_file(folder.path("recipe.toml")).file, folder.path("c1.txt"));
  Recipe recipe = recipe_from_text("material = 'glass.txt'", "recipe.toml");
  resolve_files(recipe, "/there");
  EXPECT_EQ(recipe.material, "/there/glass.txt");
  recipe.material = "ice";
  resolve_files(recipe, "/there");
  EXPECT_EQ(recipe.material, "ice");
}

TEST(RecipeId, DependsOnEverythingThatDecidesTheTableAndOnNothingElse) {
  const auto id = [](std::string_view text) { return recipe_id(recipe_from_text(text, "recipe.toml")); };
  const std::string plain = id("");
  EXPECT_EQ(plain.size(), 32u);
  EXPECT_EQ(id("# a comment\nmaterial = 'water'"), plain);
  EXPECT_EQ(id("type = 'rain'").size(), 32u);
  for (const char* other : {"type = 'rain'", "material = 'ice'", "size_um = [5, 6]", "distribution = { variance = 0.11 }",
                            "wavelength_nm = [500, 600]", "optics = 'geometric'", "forward_lobe = 'scatter'", "radii = 5000"})
    EXPECT_NE(id(other), plain) << other;
}

TEST(RecipeId, DependsOnTheContentOfFilesAndNotOnTheirNames) {
  const ScratchFolder folder;
  write_whole_file(folder.path("a.txt"), "300 1.5 0\n900 1.5 0\n");
  write_whole_file(folder.path("b.txt"), "300 1.5 0\n900 1.5 0\n");
  write_whole_file(folder.path("c.txt"), "300 1.5 0\n900 1.6 0\n");
  const auto id = [&](const char* name) {
    return recipe_id(recipe_from_text("material = '" + folder.path(name) + "'", "recipe.toml"));
  };
  EXPECT_EQ(id("a.txt"), id("b.txt"));
  EXPECT_NE(id("a.txt"), id("c.txt"));
  EXPECT_THROW(id("missing.txt"), Error);
}

}  // namespace arcus::phase
