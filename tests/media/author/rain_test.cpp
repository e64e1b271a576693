#include "media/author/rain.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <map>

#include "phase/base/error.h"
#include "phase/settings/toml_text.h"
#include "phase/species/recipe.h"

namespace arcus::media {
namespace {

/// Small and quick: 40 m voxels.
RainSettings coarse() {
  RainSettings settings;
  settings.voxel_m = 40;
  return settings;
}

/// Calls visit(position of the voxel, extinction, size) for every voxel that scatters.
template <class Visit>
void for_voxels(const AuthoredRain& rain, const Visit& visit) {
  for (std::size_t b = 0; b < rain.species.extinction.size(); ++b)
    for (int i = 0; i < SparseGrid::brick_voxels; ++i) {
      const NewBrick& brick = rain.species.extinction[b];
      const auto at = static_cast<std::size_t>(i);
      if (brick.values[at] == 0) continue;
      const Vec3 index(brick.origin.x + (i >> 6), brick.origin.y + (i >> 3 & 7), brick.origin.z + (i & 7));
      visit(rain.species.world_from_index.point(index), brick.values[at], rain.species.size[b].values[at]);
    }
}

TEST(RainDrops, MeetTheTablesOfTheLiterature) {
  // Extinction per km and effective radius in mm at 1, 5, 25, 50 mm/h from the formulas of Marshall & Palmer 1948.
  const double rates[] = {1, 5, 25, 50}, per_km[] = {0.365, 1.005, 2.771, 4.288}, radius_mm[] = {0.37, 0.51, 0.72, 0.83};
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(1e3 * marshall_palmer_drops(rates[i]).extinction_per_m, per_km[i], 0.0006);
    EXPECT_NEAR(1e-3 * marshall_palmer_drops(rates[i]).effective_radius_um, radius_mm[i], 0.005);
  }
}

TEST(RainDrops, FallAtTheSpeedsOfTheLiterature) {
  EXPECT_NEAR(fall_speed_m_per_s(500), 4.0, 0.05);    // Atlas et al. 1973: 9.65 - 10.3 exp(-0.6)
  EXPECT_NEAR(fall_speed_m_per_s(1500), 7.95, 0.05);  // D = 3 mm
  EXPECT_NEAR(fall_speed_m_per_s(200), 1.6, 1e-9);
  double last = 0;
  for (double r = 1; r < 5000; r *= 1.1) {
    EXPECT_GE(fall_speed_m_per_s(r), last);
    EXPECT_LT(fall_speed_m_per_s(r) - last, 0.9);  // no jumps between the regimes
    last = fall_speed_m_per_s(r);
  }
}

TEST(RainDrops, OfOneSizeCarryTheWaterOfTheRain) {
  // 3.6 mm/h are 1 g per m² and s; at 4 m/s that is 0.25 g/m³, and extinction is 3 W / (2 rho r).
  const RainDrops drops = narrow_drops(3.6, 500);
  EXPECT_NEAR(drops.extinction_per_m, 1.5 * 1e-3 / fall_speed_m_per_s(500) / (1000 * 500e-6), 1e-12);
}

TEST(Rain, IsPlausibleRain) {
  const AuthoredRain rain = author_rain(coarse());
  int voxels = 0;
  double water_kg = 0;
  for_voxels(rain, [&](const Vec3& p, float extinction, float size) {
    ++voxels;
    EXPECT_GT(p.z, 0);
    EXPECT_LT(p.z, 1200);
    // Extinction and size belong to one rain rate of Marshall and Palmer's.
    const double rate = std::pow(size / marshall_palmer_drops(1).effective_radius_um, 1 / 0.21);
    EXPECT_NEAR(extinction, marshall_palmer_drops(rate).extinction_per_m, 1e-3 * extinction);
    EXPECT_LT(rate, 200);
    water_kg += 2.0 / 3 * 1000 * size * 1e-6 * extinction * 40 * 40 * 40;
  });
  EXPECT_GT(voxels, 20000);
  EXPECT_NEAR(rain.water_kg, water_kg, 1e-3 * water_kg);
  // A core of 1.4 km and 8 mm/h: about 0.5 g/m³ in 2 to 3 km³.
  EXPECT_GT(rain.water_kg, 2e5);
  EXPECT_LT(rain.water_kg, 3e6);
  EXPECT_GT(rain.largest_extinction_per_m, 1e-3);
  EXPECT_LT(rain.largest_extinction_per_m, 1.5e-2);
}

TEST(Rain, RecipeSpansTheSizes) {
  for (const std::string drops : {"marshall_palmer", "narrow"}) {
    RainSettings settings = coarse();
    settings.drops = drops;
    const AuthoredRain rain = author_rain(settings);
    const phase::Recipe recipe = phase::recipe_from_text(rain.species.recipe, "test");
    EXPECT_EQ(recipe.type, "rain");
    EXPECT_EQ(recipe.distribution.type, drops == "narrow" ? "gamma" : "marshall_palmer");
    ASSERT_GT(recipe.size_um.size(), 2u);
    // By less than a step of the lattice, whose nodes have two decimals.
    const double ratio = recipe.size_um[1] / recipe.size_um[0];
    EXPECT_LE(recipe.size_um.front(), rain.smallest_radius_um + 0.01);
    EXPECT_GT(recipe.size_um.front() * ratio, rain.smallest_radius_um - 0.01);
    EXPECT_GE(recipe.size_um.back(), rain.largest_radius_um - 0.01);
    EXPECT_LT(recipe.size_um.back() / ratio, rain.largest_radius_um + 0.01);
    EXPECT_LT(ratio, drops == "narrow" ? std::exp2(1 / 6.9) : std::exp2(1 / 2.9));
    EXPECT_EQ(rain.species.phase_id, phase::recipe_id(recipe));
  }
}

TEST(Rain, NarrowDropsHaveTheirRadiusAtTheCoresRate) {
  RainSettings settings = coarse();
  settings.drops = "narrow";
  settings.streak_contrast = settings.turbulence = settings.virga_m = 0;
  settings.radius_exponent = 0.5;
  const AuthoredRain rain = author_rain(settings);
  EXPECT_NEAR(rain.largest_radius_um, 350, 1e-3);
}

TEST(Rain, EvaporatesOnItsWayAndLightRainFirst) {
  RainSettings settings = coarse();
  settings.streak_contrast = settings.turbulence = settings.wind_m_per_s = settings.base_fade_m = 0;
  settings.rain_mm_per_hour = 1;
  settings.virga_m = 600;
  const AuthoredRain rain = author_rain(settings);
  double lowest = 1e9, widest_high = 0, widest_low = 0;
  for_voxels(rain, [&](const Vec3& p, float, float) {
    lowest = std::min(lowest, p.z);
    if (p.z > 1100) widest_high = std::max(widest_high, p.x);
    if (p.z < 800) widest_low = std::max(widest_low, p.x);
  });
  EXPECT_NEAR(lowest, 1200 - 600, 60) << "1 mm/h lasts 600 m";
  EXPECT_LT(widest_low, widest_high - 80) << "the light rain at the edges is gone first";
}

TEST(Rain, LeansWithTheWind) {
  RainSettings settings = coarse();
  settings.streak_contrast = settings.turbulence = settings.virga_m = 0;
  settings.wind_azimuth_deg = 90;  // towards the east: +x
  const auto middle = [&](double low, double high) {
    double sum = 0, weight = 0;
    for_voxels(author_rain(settings), [&](const Vec3& p, float extinction, float) {
      if (p.z < low || p.z > high) return;
      sum += extinction * p.x;
      weight += extinction;
    });
    return sum / weight;
  };
  EXPECT_NEAR(middle(950, 1050), 0.5 * 6 / 4.4 * 200 * 200 / 1200, 15);
  EXPECT_GT(middle(0, 100), 400);
  settings.wind_m_per_s = 0;
  EXPECT_NEAR(middle(0, 100), 0, 10);
}

TEST(Rain, MeanRateIsThatOfTheSettingsWhateverTheTexture) {
  RainSettings settings = coarse();
  settings.virga_m = settings.wind_m_per_s = settings.base_fade_m = 0;
  settings.drops = "narrow";
  settings.radius_exponent = 0;  // extinction is then in proportion to the rain rate
  const auto mean = [&] {
    double sum = 0, count = 0;
    for_voxels(author_rain(settings), [&](const Vec3& p, float extinction, float) {
      if (p.x * p.x + p.y * p.y > 600 * 600) return;
      sum += extinction;
      ++count;
    });
    return sum / count;
  };
  const double rough = mean();
  settings.streak_contrast = settings.turbulence = 0;
  EXPECT_NEAR(rough / mean(), 1, 0.25);
}

TEST(Rain, IsTheSameForAnyNumberOfThreads) {
  const auto values = [](std::size_t threads) {
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const AuthoredRain rain = author_rain(coarse());
    std::vector<std::pair<Coord, std::array<float, 512>>> all;
    for (const NewBrick& brick : rain.species.extinction) all.emplace_back(brick.origin, brick.values);
    return std::make_pair(all, rain.water_kg);
  };
  const auto one = values(1), three = values(3);
  EXPECT_EQ(one.first, three.first);
  EXPECT_EQ(one.second, three.second);
}

TEST(Rain, AnotherSeedGivesAnotherShower) {
  RainSettings settings = coarse();
  const double first = author_rain(settings).water_kg;
  settings.seed = 2;
  EXPECT_NE(author_rain(settings).water_kg, first);
}

TEST(Rain, SettingsSurviveWritingAndReading) {
  RainSettings settings;
  settings.drops = "narrow";
  settings.centre_m = {1, 2, 3};
  const std::string text = text_of(settings);
  const auto again = settings_from_text<RainSettings>(text, "test");
  EXPECT_EQ(text_of(again), text);
  EXPECT_EQ(again.centre_m.z, 3);
}

TEST(Rain, RefusesWhatCannotBeMade) {
  RainSettings settings;
  settings.voxel_m = 0.5;
  EXPECT_THROW(author_rain(settings), Error);
  settings = coarse();
  settings.virga_m = 1;
  EXPECT_THROW(author_rain(settings), Error);
  EXPECT_THROW(settings_from_text<RainSettings>("core_radius_m = -5", "test"), Error);
  EXPECT_THROW(settings_from_text<RainSettings>("drops = \"huge\"", "test"), Error);
}

}  // namespace
}  // namespace arcus::media
