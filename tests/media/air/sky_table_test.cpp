// The sky's table against adding-doubling, in flat layers of molecules: no noise on either side.

#include "media/air/sky_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <map>
#include <tuple>

#include "media/air/harmonics.h"
#include "phase/base/curve.h"
#include "phase/base/frame.h"
#include "phase/base/quadrature.h"
#include "tests/statistics/seed.h"

namespace arcus::media {
namespace {

TEST(EvenHarmonics, AreOrthonormal) {
  constexpr int degree = 8;
  constexpr std::size_t count = even_harmonic_count(degree);
  std::array<double, count * count> products{};
  const Quadrature rule = gauss_legendre(24);
  constexpr int around = 40;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i)
    for (int k = 0; k < around; ++k) {
      const double z = rule.nodes[i], phi = 2 * pi * k / around, sine = std::sqrt(1 - z * z);
      std::array<double, count> y;
      even_harmonics<degree>({sine * std::cos(phi), sine * std::sin(phi), z}, y);
      for (std::size_t a = 0; a < count; ++a)
        for (std::size_t b = 0; b < count; ++b) products[a * count + b] += rule.weights[i] * 2 * pi / around * y[a] * y[b];
    }
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = 0; b < count; ++b) EXPECT_NEAR(products[a * count + b], a == b ? 1 : 0, 1e-12) << a << ' ' << b;
}

/// As much air as makes the optical depth at 550 nm, over a planet so large that layers are flat.
Atmosphere flat_air(double optical_depth) {
  AirSettings settings;
  settings.planet_radius_m = 1e11;
  settings.ozone_dobson_units = 0;
  const auto depth = [&] { return Atmosphere::optical_depth(Atmosphere(settings).columns({{0, 0, 0}, {0, 0, 1}}), 550); };
  settings.pressure_hpa *= optical_depth / depth();
  return Atmosphere(settings);
}

TEST(SkyTable, FlatLayersMeetTheReference) {
  const Columns reference = read_columns_file(std::string(PUBLISHED_DIR) + "/rayleigh_sky.csv");
  std::map<std::tuple<double, double, double>, std::unique_ptr<SkyTable>> tables;
  Wavelengths wavelengths;
  wavelengths.nm = {550, 550, 550, 550};
  double worst = 0, squares = 0;
  int count = 0;
  for (std::size_t i = 0; i < reference.columns[0].size(); ++i) {
    const auto column = [&](const char* name) { return reference.named(name)[i]; };
    const double depth = column("optical_depth"), albedo = column("ground_albedo"), sun_cosine = column("sun_cosine"), view = column("view_cosine");
    if (depth != 0.5 && statistics::test_effort() <= 1) continue;
    const double sun_elevation_deg = degrees(std::asin(sun_cosine));
    const bool looks_down = column("looks_down") > 0;
    const Atmosphere air = flat_air(depth);
    auto& table = tables[{depth, albedo, sun_cosine}];
    if (!table) table = std::make_unique<SkyTable>(air, nullptr, SkySettings{direction_of(0, sun_elevation_deg), 0, albedo}, air.settings().top_m, 0);
    const double elevation_deg = degrees(std::asin(view));
    const Vec3 direction = direction_of(column("azimuth_deg"), looks_down ? -elevation_deg : elevation_deg);
    const double found = static_cast<double>(table->radiance({0, 0, looks_down ? air.settings().top_m : 0}, direction, wavelengths)[0]);
    const double expected = column("radiance_per_sr"), error = found / expected - 1;
    EXPECT_NEAR(error, 0, 0.015) << "depth " << depth << " albedo " << albedo << " sun " << sun_cosine << (looks_down ? " down " : " up ") << view << " azimuth "
                                 << column("azimuth_deg") << ": " << found << ", reference " << expected;
    worst = std::max(worst, std::fabs(error));
    squares += error * error;
    ++count;
  }
  std::cout << count << " radiances: rms " << 100 * std::sqrt(squares / count) << " %, at most " << 100 * worst << " %\n";
}

}  // namespace
}  // namespace arcus::media
