#include "media/author/box.h"

#include <gtest/gtest.h>

#include "media/medium/medium.h"
#include "media/tracking/optical_depth.h"
#include "phase/base/error.h"
#include "phase/settings/toml_text.h"

namespace arcus::media {
namespace {

Medium medium_of(const NewSpecies& species, Interpolation interpolation) {
  Component component;
  component.grid = std::make_shared<const SparseGrid>(sparse_grid_of(species));
  component.world_from_index = species.world_from_index;
  component.interpolation = interpolation;
  return Medium({component});
}

TEST(Box, HasItsOpticalDepthHoweverItIsInterpolated) {
  BoxSettings settings;
  settings.centre_m = {10, 20, 500};
  settings.size_m = {4000, 3000, 1000};
  settings.optical_depth = 5;
  settings.voxels = {20, 11, 9};
  for (const Interpolation interpolation : {Interpolation::linear, Interpolation::nearest}) {
    const Medium medium = medium_of(author_box(settings, ""), interpolation);
    EXPECT_NEAR(optical_depth(medium, {{0, 0, -1e4}, {0, 0, 1}}, 550), 5, 1e-4);
    EXPECT_NEAR(optical_depth(medium, {{-2800, 200, 1e4}, normalize(Vec3(0.3, 0, -1))}, 550), 5 * std::sqrt(1.09), 1e-4);
    EXPECT_NEAR(optical_depth(medium, {{-1e4, 20, 500}, {1, 0, 0}}, 550), 20, 1e-3);
  }
  const Medium cells = medium_of(author_box(settings, ""), Interpolation::nearest);
  EXPECT_EQ(optical_depth(cells, {{10 + 2001, 20, -1e4}, {0, 0, 1}}, 550), 0);
  EXPECT_NEAR(optical_depth(cells, {{10 + 1999, 20, -1e4}, {0, 0, 1}}, 550), 5, 1e-4);
}

TEST(Box, CarriesItsRecipeAndSize) {
  BoxSettings settings;
  settings.phase.type = "hg";
  settings.phase.g = 0.7;
  settings.size_um = 25;
  const NewSpecies species = author_box(settings, "");
  EXPECT_EQ(species.recipe, text_of(settings.phase));
  EXPECT_EQ(species.phase_id, phase::recipe_id(settings.phase));
  EXPECT_EQ(species.size_um, 25);
  EXPECT_TRUE(species.size.empty());
}

TEST(Box, OneNumberOfVoxelsMakesCubes) {
  BoxSettings settings;
  settings.size_m = {300, 200, 100};
  settings.voxels = {10};
  const NewSpecies species = author_box(settings, "");
  std::size_t count = 0;
  for (const NewBrick& brick : species.extinction)
    for (const float value : brick.values) count += value > 0;
  EXPECT_EQ(count, 30u * 20 * 10);
  EXPECT_NEAR(species.world_from_index.x.x, 10, 1e-12);
}

TEST(Box, RefusesWhatCannotBe) {
  EXPECT_THROW(settings_from_text<BoxSettings>("size_m = [1, 0, 1]", "test"), Error);
  EXPECT_THROW(settings_from_text<BoxSettings>("voxels = [1, 2]", "test"), Error);
  EXPECT_THROW(settings_from_text<BoxSettings>("extinction_per_m = -1", "test"), Error);
  BoxSettings settings;
  settings.voxels = {5000, 5000, 5000};
  EXPECT_THROW(author_box(settings, ""), Error);
}

TEST(Box, SettingsSurviveWritingAndReading) {
  BoxSettings settings;
  settings.phase.type = "isotropic";
  settings.optical_depth = 3;
  const std::string text = text_of(settings);
  EXPECT_EQ(text_of(settings_from_text<BoxSettings>(text, "test")), text);
}

}  // namespace
}  // namespace arcus::media
