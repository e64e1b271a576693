// The layer of tests/published/slab_*.csv, traced: every radiance within the error it states and 0.5 %, and what comes
// in comes out. Minutes of work in all: labelled slow.

#include <gtest/gtest.h>

#include <tbb/parallel_for.h>

#include "phase/base/curve.h"
#include "tests/src/integrator/slab.h"
#include "tests/statistics/seed.h"
#include "tests/statistics/students_t.h"

namespace arcus::render {
namespace {

using statistics::Moments;

constexpr int tasks = 64;  // fixed, so that the numbers do not depend on the threads

/// Means of samples, gathered in rounds until the standard error is below `wanted` of the mean, or `most` rounds (times
/// TEST_EFFORT); in an order that does not depend on threads.
template <class Sample>
Moments gathered(double wanted, int most, const Sample& sample) {
  constexpr int batch = 1000;
  most = std::max(1, static_cast<int>(most * statistics::test_effort()));
  Moments moments;
  for (int round = 0; round < most; ++round) {
    std::vector<double> means(tasks);
    tbb::parallel_for(0, tasks, [&](int task) {
      double sum = 0;
      for (int i = 0; i < batch; ++i) {
        Random random(statistics::test_seed(), static_cast<std::uint64_t>(task), static_cast<std::uint32_t>(round * batch + i));
        sum += sample(random);
      }
      means[static_cast<std::size_t>(task)] = sum / batch;
    });
    for (const double mean : means) moments.add(mean);
    if (round >= 2 && moments.standard_error() < wanted * moments.mean()) break;
  }
  return moments;
}

Moments radiance(const Scene& scene, double view_cosine, double azimuth_deg) {
  const VolumePath integrator(scene, 1000000);
  return gathered(0.0017, 15, [&](Random& random) {
    const Wavelengths wavelengths = draw_wavelengths(random.uniform_double());
    const FirstNumbers first{0.5, 0.5, 0.5, random.uniform_double(), random.uniform_double()};
    return integrator.radiance(slab_ray(view_cosine, azimuth_deg), wavelengths, first, random).mean();
  });
}

/// Diffuse flux through a face per irradiance on the layer: view cosines with density 2μ, all azimuths.
Moments flux(const Scene& scene, double side, double sun_cosine, int most) {
  const VolumePath integrator(scene, 1000000);
  return gathered(0.0017, most, [&](Random& random) {
    // The few rays that look straight into the sun are drawn anew: the direct beam is known.
    media::Ray ray;
    do ray = slab_ray(side * std::sqrt(1 - random.uniform_double()), 360 * random.uniform_double());
    while (scene.sun.density_per_sr(ray.direction) > 0);
    const Wavelengths wavelengths = draw_wavelengths(random.uniform_double());
    const FirstNumbers first{0.5, 0.5, 0.5, random.uniform_double(), random.uniform_double()};
    return integrator.radiance(ray, wavelengths, first, random).mean() * pi / sun_cosine;
  });
}

struct Row {
  Slab slab;
  double view_cosine, azimuth_deg, radiance_per_sr;
};

std::vector<Row> rows(const std::string& file, double side) {
  const Columns table = read_columns_file(std::string(PUBLISHED_DIR) + "/" + file);
  std::vector<Row> result;
  for (std::size_t i = 0; i < table.columns[0].size(); ++i) {
    const auto column = [&](const char* name) { return table.named(name)[i]; };
    result.push_back({{column("asymmetry"), column("albedo"), column("optical_depth"), column("sun_zenith_deg")},
                      side * column("view_cosine"), column("azimuth_deg"), column("radiance_per_sr")});
  }
  return result;
}

/// The views held against the reference, for the sun at 60°: of every layer one from above and one from below, some straight, some
/// oblique.
bool is_chosen(const Row& row) {
  if (row.slab.sun_zenith_deg != 60) return false;
  const bool oblique = row.view_cosine > 0 ? row.slab.optical_depth == 5 : row.slab.optical_depth == 1;
  const double mu = std::fabs(row.view_cosine);
  return oblique ? mu == 0.5 && row.azimuth_deg == 180 : mu == 1 && row.azimuth_deg == 0;
}

void compare(const std::vector<Row>& table) {
  int compared = 0;
  for (const Row& row : table) compared += is_chosen(row);
  ASSERT_EQ(compared, 12);
  for (const Row& row : table) {
    if (!is_chosen(row)) continue;
    const Scene scene = slab_scene(row.slab);
    const Moments found = radiance(scene, row.view_cosine, row.azimuth_deg);
    const auto place = testing::Message() << "g " << row.slab.asymmetry << " albedo " << row.slab.albedo << " tau "
                                          << row.slab.optical_depth << " view " << row.view_cosine << " azimuth "
                                          << row.azimuth_deg << ": " << found.mean() << " +- " << found.standard_error()
                                          << ", reference " << row.radiance_per_sr;
    EXPECT_TRUE(statistics::mean_is(found, row.radiance_per_sr, {.comparisons = compared})) << place;
    // Half a percent; where the noise of the affordable samples is larger than a third of that, three standard errors.
    const double error = found.standard_error() / row.radiance_per_sr;
    EXPECT_NEAR(found.mean() / row.radiance_per_sr, 1, std::max(0.005, 3 * error)) << place;
    std::cout << place << "  z " << (found.mean() - row.radiance_per_sr) / found.standard_error() << '\n';
  }
}

}  // namespace

TEST(Slab, ReflectedRadiancesMeetTheReference) { compare(rows("slab_reflected.csv", 1)); }

TEST(Slab, TransmittedRadiancesMeetTheReference) { compare(rows("slab_transmitted.csv", -1)); }

TEST(Slab, WhatComesInGoesOut) {
  for (const double tau : {1.0, 5.0, 20.0, 100.0}) {
    const Slab slab{.asymmetry = 0.85, .albedo = 1, .optical_depth = tau, .sun_zenith_deg = 60};
    const Scene scene = slab_scene(slab);
    const int rounds = tau < 50 ? 8 : 4;  // paths are long in the thickest
    const Moments up = flux(scene, 1, 0.5, rounds), down = flux(scene, -1, 0.5, rounds);
    const double error = std::hypot(up.standard_error(), down.standard_error());
    std::cout << "tau " << tau << ": " << up.mean() << " up, " << down.mean() << " down, +- " << error << '\n';
    EXPECT_NEAR(up.mean() + down.mean() + std::exp(-tau / 0.5), 1, 3 * error) << "tau " << tau;
    EXPECT_LT(error, 0.005);
  }
}

}  // namespace arcus::render
