// The step cloud of the Intercomparison of 3-D Radiation Codes against its consensus: tests/published/i3rc_case1/README.md.
// Minutes of work: labelled slow.

#include <gtest/gtest.h>

#include <tbb/parallel_for.h>

#include <fstream>

#include "media/grid/sparse_grid.h"
#include "phase/species/species.h"
#include "src/integrator/volume_path.h"
#include "tests/statistics/seed.h"

namespace arcus::render {
namespace {

constexpr int columns = 32;
constexpr double column_m = 15.625, thickness_m = 250;

/// The cloud of 0.5 km repeated to 10 km on either side: light that comes from further away is lost in a thousandth.
Scene step_cloud(double sun_zenith_deg, double albedo) {
  constexpr int periods = 20;
  const media::IndexBox voxels{{-2 * periods, 0, 0}, {2 * periods + 1, 0, 0}};
  media::Component cloud;
  cloud.name = "cloud";
  cloud.grid = std::make_shared<const media::SparseGrid>(media::make_sparse_grid(
      voxels, false, [](const media::Coord& c) { return media::Voxel{(c.x & 1 ? 18.f : 2.f) / 250.f, 0}; }));
  // A voxel fills 16 columns; along y it is 100 km wide.
  cloud.world_from_index = media::Affine::translation(Vec3(125, 0, 125)) * media::Affine::scaling(Vec3(250, 1e5, 250));
  cloud.interpolation = media::Interpolation::nearest;
  cloud.albedo_scale = static_cast<float>(albedo);
  cloud.species = std::make_shared<phase::Species>(phase::PhaseFunction(phase::HenyeyGreenstein(0.85)), 0.0);
  std::vector<media::Component> components{cloud};
  // From the west: its light travels towards +x.
  const SunSettings sun{.azimuth_deg = 270, .elevation_deg = 90 - sun_zenith_deg, .angular_radius_deg = 0.01, .spectrum = "equal_energy"};
  return Scene{.medium = std::make_unique<media::Medium>(std::move(components)),
               .sun = Sun(sun, sun_irradiance(sun, "")),
               .sky = Sky({.type = "none"}, Curve({550}, {1}, "")),
               .surfaces = Surfaces(),
               .camera = nullptr};
}

std::vector<double> consensus(const std::string& name) {
  std::ifstream in(std::string(PUBLISHED_DIR) + "/i3rc_case1/I3RC_cons_res_case1_" + name + ".txt");
  std::vector<double> values;
  for (double value; in >> value;) values.push_back(value);
  return values;
}

/// Of every column, with its standard error.
struct Radiances {
  std::vector<double> mean, error;
};

/// π I / (μ₀ F₀): light that leaves along `leaving` through the top, or the bottom where it goes down.
Radiances radiances(const Scene& scene, const Vec3& leaving, double sun_cosine) {
  const int samples = static_cast<int>(24000 * statistics::test_effort());
  const VolumePath integrator(scene, 1000000);
  Radiances result{std::vector<double>(columns), std::vector<double>(columns)};
  tbb::parallel_for(0, columns, [&](int column) {
    double sum = 0, sum2 = 0;
    for (int i = 0; i < samples; ++i) {
      Random random(statistics::test_seed(), static_cast<std::uint64_t>(column), static_cast<std::uint32_t>(i));
      const Vec3 place((column + random.uniform_double()) * column_m, 0, leaving.z > 0 ? thickness_m : 0);
      const Wavelengths wavelengths = draw_wavelengths(random.uniform_double());
      const FirstNumbers first{0.5, 0.5, 0.5, random.uniform_double(), random.uniform_double()};
      const double value = integrator.radiance(media::Ray{place, -leaving}, wavelengths, first, random).mean() * pi / sun_cosine;
      sum += value;
      sum2 += value * value;
    }
    const auto at = static_cast<std::size_t>(column);
    result.mean[at] = sum / samples;
    result.error[at] = std::sqrt((sum2 / samples - result.mean[at] * result.mean[at]) / samples);
  });
  return result;
}

void expect_agreement(const std::string& name, const Radiances& found) {
  const std::vector<double> expected = consensus(name);
  ASSERT_EQ(expected.size(), static_cast<std::size_t>(columns)) << name;
  double squares = 0, noise = 0, sum = 0, expected_sum = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    squares += (found.mean[i] / expected[i] - 1) * (found.mean[i] / expected[i] - 1);
    noise += found.error[i] / expected[i] * found.error[i] / expected[i];
    sum += found.mean[i];
    expected_sum += expected[i];
  }
  // What is left of the deviation without the noise of the samples.
  const double rms = std::sqrt(std::max(0.0, squares - noise) / columns), mean = sum / expected_sum - 1;
  std::cout << name << ": rms over the columns " << 100 * std::sqrt(squares / columns) << " %, of that noise " << 100 * std::sqrt(noise / columns)
            << " %, without it " << 100 * rms << " %; mean " << 100 * mean << " %\n";
  EXPECT_LT(rms, 0.02) << name;
  // With enough samples (TEST_EFFORT=4) the deviation itself tells.
  if (noise / columns < 0.01 * 0.01) {
    EXPECT_LT(squares / columns, 0.02 * 0.02) << name;
  }
  EXPECT_LT(std::fabs(mean), 0.01) << name;
}

const Vec3 up(0, 0, 1), down(0, 0, -1);
const double s60 = std::sqrt(0.75);

}  // namespace

TEST(StepCloud, SunOverhead) {
  const Scene scene = step_cloud(0, 1);
  expect_agreement("exp1_Iu", radiances(scene, up, 1));
  expect_agreement("exp1_I602", radiances(scene, Vec3(-s60, 0, 0.5), 1));
}

TEST(StepCloud, SunAt60Degrees) {
  const Scene scene = step_cloud(60, 1);
  expect_agreement("exp2_Iu", radiances(scene, up, 0.5));
  expect_agreement("exp2_I602", radiances(scene, Vec3(-s60, 0, 0.5), 0.5));
  expect_agreement("exp2_Id", radiances(scene, down, 0.5));
}

TEST(StepCloud, SunAt60DegreesAndAbsorption) {
  const Scene scene = step_cloud(60, 0.99);
  expect_agreement("exp4_Iu", radiances(scene, up, 0.5));
  expect_agreement("exp4_I601", radiances(scene, Vec3(s60, 0, 0.5), 0.5));
  expect_agreement("exp4_Id", radiances(scene, down, 0.5));
}

}  // namespace arcus::render
