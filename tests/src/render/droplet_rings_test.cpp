// The fogbow and the rings of the glory of rendered droplets of 10 µm stand where their table has them. Slow: pictures.

#include <gtest/gtest.h>

#include "src/analysis/peaks.h"
#include "src/analysis/profile.h"
#include "tests/src/render/thin_shower.h"

namespace arcus::render {
namespace {

/// Where the parabola through the values between two angles, by least squares, has its top.
double vertex(const std::vector<double>& x, const std::vector<double>& y, double low, double high) {
  const double middle = (low + high) / 2;
  double s[5] = {}, t[3] = {};
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (x[i] < low || x[i] > high) continue;
    double power = 1;
    for (int k = 0; k < 5; ++k, power *= x[i] - middle) {
      s[k] += power;
      if (k < 3) t[k] += power * y[i];
    }
  }
  // Cramer's rule for a + b u + c u².
  const double c = s[0] * (s[2] * t[2] - t[1] * s[3]) - s[1] * (s[1] * t[2] - t[1] * s[2]) + t[0] * (s[1] * s[3] - s[2] * s[2]);
  const double b = s[0] * (t[1] * s[4] - s[3] * t[2]) - t[0] * (s[1] * s[4] - s[3] * s[2]) + s[2] * (s[1] * t[2] - t[1] * s[2]);
  return middle - b / (2 * c);
}

/// All tops of the table's curve in a range, against the picture's, colour by colour; returns how many there were.
int compare_tops(const Profile& profile, const std::array<std::vector<double>, 3>& table, double from_deg, double to_deg, double half_width_deg) {
  int compared = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const char* name = c == 0 ? "R" : c == 1 ? "G" : "B";
    for (const Peak& peak : find_peaks(profile.angle_deg, table[c], {})) {
      if (peak.position < from_deg || peak.position > to_deg) continue;
      const double low = peak.position - half_width_deg, high = peak.position + half_width_deg;
      const double there = vertex(profile.angle_deg, table[c], low, high);
      const double found = vertex(profile.angle_deg, profile.channel(name)->mean, low, high);
      EXPECT_NEAR(found, there, 0.1) << name << " at " << peak.position;
      std::cout << name << ": picture " << found << " table " << there << " degrees\n";
      ++compared;
    }
  }
  return compared;
}

}  // namespace

TEST(DropletRings, FogbowStandsWhereTheTableHasIt) {
  Shower fog = shower(10, species_of(10, 0.05), 110, 180, 30);
  fog.settings.render.samples_per_pixel = 24;
  const Profile profile = measure_profile(rendered(fog, 20), {.bin_deg = 0.25, .from_deg = 28, .to_deg = 46}, "picture");
  EXPECT_EQ(compare_tops(profile, expected(fog, profile.angle_deg), 33, 43, 2.5), 3);
}

TEST(DropletRings, GloryStandsWhereTheTableHasIt) {
  Shower fog = shower(10, species_of(10, 0.01), 10, 180, 30);
  fog.settings.render.samples_per_pixel = 40;
  const Profile profile = measure_profile(rendered(fog, 20), {.bin_deg = 0.05, .from_deg = 0.3, .to_deg = 4.9}, "picture");
  EXPECT_GE(compare_tops(profile, expected(fog, profile.angle_deg), 0.8, 3.9, 0.25), 6);
}

}  // namespace arcus::render
