// What relaxation is worth: the light on the screen of Descartes' flask, against a hundred times as many photons. Prints the table of
// docs/photon_map.md.

#include <gtest/gtest.h>

#include <array>
#include <cstdio>

#include "phase/base/units.h"
#include "src/integrator/photon_tracer.h"
#include "src/photon/photon_store.h"
#include "src/photon/relaxation.h"
#include "tests/src/flask.h"
#include "tests/statistics/seed.h"

namespace arcus::render {
namespace {

/// Luminance, about, then blue, green, red light.
using Colour = std::array<double, 4>;

/// Light at places on the screen, over all wavelengths.
std::vector<Colour> light_at(const std::vector<Vec3>& places, const PhotonStore& photons, int neighbours) {
  constexpr int draws = 16;
  std::vector<Colour> result;
  for (const Vec3& place : places) {
    Colour colour{};
    for (int i = 0; i < draws; ++i) {
      const Wavelengths wavelengths = draw_wavelengths((i + 0.5) / draws / wavelength_count);
      const Spectrum light = photons.irradiance(place, Vec3(0, 1, 0), neighbours, SpectralQuery(wavelengths)).value;
      for (int j = 0; j < wavelength_count; ++j) {
        const double nm = wavelengths[j], share = light[j] / (wavelength_density_per_nm(nm) * draws * wavelength_count);
        colour[0] += share * std::exp(-0.5 * std::pow((nm - 560) / 45, 2));
        colour[nm < 490 ? 1 : nm < 580 ? 2 : 3] += share;
      }
    }
    result.push_back(colour);
  }
  return result;
}

/// Mean squared error over the mean square.
Colour relative_error(const std::vector<Colour>& found, const std::vector<Colour>& expected) {
  Colour result{};
  for (std::size_t c = 0; c < 4; ++c) {
    double error = 0, all = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      error += std::pow(found[i][c] - expected[i][c], 2);
      all += std::pow(expected[i][c], 2);
    }
    result[c] = error / all;
  }
  return result;
}

double power(const std::vector<Photon>& photons, const auto& counts) {
  double sum = 0;
  for (const Photon& photon : photons)
    if (counts(photon)) sum += photon.share[0];
  return sum;
}

double radius_m(const Photon& photon) { return length(photon.position_m); }

}  // namespace

TEST(CausticQuality, RelaxationIsWorthMorePhotons) {
  const Scene scene = flask(0.2666);
  const PhotonTracer tracer(scene, 20);
  constexpr std::uint32_t sent = 300000;
  const PhotonStore reference(tracer.caustic(100 * sent, statistics::test_seed(), 1).on_surfaces);
  std::vector<Photon> photons = tracer.caustic(sent, statistics::test_seed(), 0).on_surfaces;

  // The primary bow with its bright side, the dark band and the secondary; apart from it, the even light within.
  Random random(statistics::test_seed(), 5, 0);
  const auto places = [&](double from_m, double to_m) {
    std::vector<Vec3> result;
    for (int i = 0; i < 3000; ++i) {
      const double out_m = std::sqrt(from_m * from_m + (to_m * to_m - from_m * from_m) * random.uniform_double()), turn = 2 * pi * random.uniform_double();
      result.push_back(Vec3(out_m * std::cos(turn), 0, out_m * std::sin(turn)));
    }
    return result;
  };
  const std::vector<std::vector<Vec3>> areas = {places(0.3, 2.1), places(0.5, 1.3)};
  std::vector<std::vector<Colour>> expected;
  for (const auto& area : areas) expected.push_back(light_at(area, reference, 400));

  const std::vector<Photon> before = photons;
  const Relaxed relaxed = relax(photons, scene.surfaces, {});
  EXPECT_GT(relaxed.iterations, 5);
  const PhotonStore plain(before), even(photons);
  std::printf("%zu photons, %zu for reference; relMSE of luminance, blue, green, red: without relaxation | with\n", before.size(), reference.photons().size());
  Colour best_plain, best_even;
  best_plain.fill(1e9), best_even.fill(1e9);
  for (std::size_t a = 0; a < areas.size(); ++a)
    for (const int neighbours : {8, 12, 25, 50, 100}) {
      const Colour without = relative_error(light_at(areas[a], plain, neighbours), expected[a]), with = relative_error(light_at(areas[a], even, neighbours), expected[a]);
      std::printf("%s, %3d neighbours: %.4f %.4f %.4f %.4f | %.4f %.4f %.4f %.4f\n", a == 0 ? "all" : "even light", neighbours, without[0], without[1], without[2],
                  without[3], with[0], with[1], with[2], with[3]);
      for (std::size_t c = 0; c < 4; ++c) {
        EXPECT_LT(with[c], neighbours == 12 ? without[c] / 1.5 : 2 * without[c]);
        if (a != 0) continue;
        best_plain[c] = std::min(best_plain[c], without[c]);
        best_even[c] = std::min(best_even[c], with[c]);
      }
    }
  for (std::size_t c = 0; c < 4; ++c) EXPECT_LT(best_even[c], best_plain[c]);

  // Power stays what it is, and hardly any leaves over the bow's outer edge into the dark.
  const auto all = [](const Photon&) { return true; };
  EXPECT_NEAR(power(photons, all), power(before, all), 1e-6 * power(before, all));
  const double edge_m = bow_radius_m(780, 1) + 0.012;  // the sun's radius beyond
  const auto beyond = [&](const Photon& photon) { return radius_m(photon) > edge_m && radius_m(photon) < edge_m + 0.1; };
  const double over = (power(photons, beyond) - power(before, beyond)) / power(before, all);
  std::printf("power over the edge: %.5f of all\n", over);
  EXPECT_LT(std::fabs(over), 0.01);
}

TEST(CausticQuality, BowsEndWhereRayOpticsHasThem) {
  const Scene scene = flask();
  const PhotonTracer tracer(scene, 20);
  const std::vector<Photon> photons = tracer.caustic(20000000, statistics::test_seed(), 0).on_surfaces;
  for (const double nm : {450.0, 550.0, 650.0}) {
    // No map: the photons themselves, of 4 nm, in rings of 1.5 mm. The light falls over the edge at once.
    const double edge_m = bow_radius_m(nm, 1);
    const auto in_ring = [&](double from_m, double to_m) {
      return power(photons, [&](const Photon& photon) { return std::fabs(photon.wavelengths[0] - nm) < 2 && radius_m(photon) >= from_m && radius_m(photon) < to_m; });
    };
    const double within = in_ring(edge_m - 0.0035, edge_m - 0.002), beyond = in_ring(edge_m + 0.002, edge_m + 0.0035);
    std::printf("%g nm: edge at %.4f m; light within %.3g, beyond %.3g\n", nm, edge_m, within, beyond);
    EXPECT_GT(within, 4 * beyond) << nm;
  }
}

}  // namespace arcus::render
