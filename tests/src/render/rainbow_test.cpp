// The bows of a rendered shower stand where the table of the same drops has them. Slow: makes a table and pictures.

#include <gtest/gtest.h>

#include "src/analysis/peaks.h"
#include "src/analysis/profile.h"
#include "tests/src/render/thin_shower.h"

namespace arcus::render {
namespace {

Shower rain_shower(double azimuth_deg, double sun_elevation_deg) {
  static const std::shared_ptr<const phase::Species> species = species_of(250, 0.05);
  return shower(250, species, 130, azimuth_deg, sun_elevation_deg);
}

double highest(const std::vector<double>& x, std::span<const double> y, double low, double high) {
  double position = 0, height = -1;
  for (const Peak& peak : find_peaks(x, y, {}))
    if (peak.position > low && peak.position < high && peak.height > height) {
      position = peak.position;
      height = peak.height;
    }
  return position;
}

double mean_between(const Profile& profile, const std::vector<double>& values, double low, double high) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (profile.angle_deg[i] > low && profile.angle_deg[i] < high) {
      sum += values[i];
      ++count;
    }
  return sum / count;
}

}  // namespace

TEST(Rainbow, StandsWhereTheTableHasItAndTheBandBetweenIsDark) {
  for (const double turned_deg : {0.0, 35.0}) {
    const Shower rain = rain_shower(180, 20);
    const Profile profile = measure_profile(rendered(rain, turned_deg), {.bin_deg = 0.1, .from_deg = 30, .to_deg = 62}, "picture");
    const auto table = expected(rain, profile.angle_deg);
    for (std::size_t c = 0; c < 3; ++c) {
      const char* name = c == 0 ? "R" : c == 1 ? "G" : "B";
      const std::vector<double>& mean = profile.channel(name)->mean;
      for (const auto& [low, high] : {std::pair{39.0, 43.5}, std::pair{49.0, 56.0}}) {
        const double found = highest(profile.angle_deg, mean, low, high);
        const double there = highest(profile.angle_deg, table[c], low, high);
        EXPECT_NEAR(found, there, 0.1) << name << " turned by " << turned_deg;
        std::cout << name << ": picture " << found << " table " << there << '\n';
      }
      const double dark = mean_between(profile, mean, 45, 48);
      EXPECT_LT(dark, 0.7 * mean_between(profile, mean, 32, 37)) << name;
      EXPECT_LT(dark, 0.7 * mean_between(profile, mean, 55, 60)) << name;
    }
  }
}

TEST(Rainbow, OneAzimuthHasTheSameProfileAsAnother) {
  const Shower rain = rain_shower(40, 35);
  const Image picture = rendered(rain, 0);
  std::vector<Profile> sectors;
  for (const double from : {0.0, 120.0, 240.0})
    sectors.push_back(measure_profile(picture, {.bin_deg = 0.25, .from_deg = 39, .to_deg = 55, .sector_from_deg = from,
                                                .sector_to_deg = from + 60}, "picture"));
  for (std::size_t s = 1; s < sectors.size(); ++s) {
    EXPECT_NEAR(highest(sectors[0].angle_deg, sectors[0].channel("G")->mean, 39, 43.5),
                highest(sectors[s].angle_deg, sectors[s].channel("G")->mean, 39, 43.5), 0.1);
  }
}

}  // namespace arcus::render
