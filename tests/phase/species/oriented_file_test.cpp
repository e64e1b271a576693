#include "phase/species/oriented_file.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "phase/base/error.h"
#include "phase/base/whole_file.h"
#include "tests/phase/species/scratch_folder.h"

namespace arcus::phase {
namespace {

Recipe small_recipe() {
  Recipe recipe = default_recipe("crystal");
  recipe.wavelength_nm = {500, 600};
  recipe.rays_million = 0.01;
  recipe.map_step_deg = 5;
  return recipe;
}

void expect_equal(const OrientedTable& a, const OrientedTable& b) {
  EXPECT_EQ(a.size_um, b.size_um);
  EXPECT_EQ(a.wavelength_nm, b.wavelength_nm);
  EXPECT_EQ(a.sine_elevation, b.sine_elevation);
  EXPECT_EQ(a.extinction_cross_section_m2, b.extinction_cross_section_m2);
  EXPECT_EQ(a.forward_fraction, b.forward_fraction);
  EXPECT_EQ(a.mean_extinction_cross_section_m2, b.mean_extinction_cross_section_m2);
  EXPECT_EQ(a.albedo, b.albedo);
  EXPECT_EQ(a.sun_elevation_deg, b.sun_elevation_deg);
  EXPECT_EQ(a.sun_angular_radius_deg, b.sun_angular_radius_deg);
  EXPECT_EQ(a.elevation_deg, b.elevation_deg);
  EXPECT_EQ(a.azimuth_deg, b.azimuth_deg);
  EXPECT_EQ(a.scattering_m2_per_sr, b.scattering_m2_per_sr);
  EXPECT_EQ(a.relative_error, b.relative_error);
}

}  // namespace

TEST(OrientedFile, ComesFromTheCacheAsItWasMade) {
  const ScratchFolder folder;
  SpeciesOptions options;
  options.cache_folder = folder.folder();
  const Recipe recipe = small_recipe();
  const OrientedTable made = oriented_table_of(recipe, 12, 0.2666, options);
  int computed = 0;
  options.progress = [&](double) { ++computed; };
  expect_equal(oriented_table_of(recipe, 12, 0.2666, options), made);
  EXPECT_EQ(computed, 0);
  const OrientedFile file = read_oriented_file(folder.path(oriented_table_id(recipe, 12, 0.2666) + ".nc"));
  EXPECT_EQ(recipe_from_text(file.recipe, "file").map_step_deg, 5);
  oriented_table_of(recipe, 12.5, 0.2666, options);  // another sun, another table
  EXPECT_GT(computed, 0);
  computed = 0;
  options.disc = DiscKind::uniform;  // and a moon in its place
  const OrientedTable under_moon = oriented_table_of(recipe, 12, 0.2666, options);
  EXPECT_GT(computed, 0);
  EXPECT_NE(under_moon.scattering_m2_per_sr, made.scattering_m2_per_sr);
  EXPECT_NE(oriented_table_id(recipe, 12, 0.2666), oriented_table_id(recipe, 12, 0.2666, {}, DiscKind::uniform));
}

TEST(OrientedFile, ADamagedOneIsMadeAgain) {
  const ScratchFolder folder;
  SpeciesOptions options;
  options.cache_folder = folder.folder();
  std::string told;
  options.log = [&](std::string_view line) { told.append(line); };
  const Recipe recipe = small_recipe();
  const OrientedTable made = oriented_table_of(recipe, 12, 0, options);
  const std::string path = folder.path(oriented_table_id(recipe, 12, 0) + ".nc");
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  EXPECT_THROW(read_oriented_file(path), Error);
  expect_equal(oriented_table_of(recipe, 12, 0, options), made);
  EXPECT_NE(told.find("warning"), std::string::npos);
  expect_equal(read_oriented_file(path).table, made);
}

TEST(OrientedFile, RefusesRecipesOfOtherKindsAndSunsThatAreNot) {
  EXPECT_THROW(oriented_table_of(default_recipe("mie"), 10, 0, {}), Error);
  EXPECT_THROW(oriented_table_of(small_recipe(), 91, 0, {}), Error);
}

}  // namespace arcus::phase
