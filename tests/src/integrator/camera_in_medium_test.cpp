// Radiance along one ray, seen from outside of a medium, from its edge and from within: what arrives at a place is what arrives farther on, dimmed on the way,
// and what the medium scatters into the ray in between. That is gathered here without the tracking: where by quadrature, from where by draws of the phase
// function, dimmed by Beer's law in closed form.

#include <gtest/gtest.h>

#include "media/grid/sparse_grid.h"
#include "phase/base/units.h"
#include "phase/species/species.h"
#include "tests/src/integrator/traced.h"
#include "tests/src/simple_surfaces.h"

namespace arcus::render {
namespace {

constexpr float extinction_per_m = 0.03f, albedo = 0.9f;

/// Haze of 32 x 32 x 16 voxels of 2 m, all alike, turned and tilted, over ground.
struct Haze {
  media::Affine world_from_index = media::Affine::translation({-10, -20, 20}) * media::Affine::rotation_deg({5, 8, 30}) * media::Affine::scaling(Vec3(2));
  media::Box voxels{Vec3(-0.5), Vec3(31.5, 31.5, 15.5)};
  Scene scene;

  Haze() : scene(make(world_from_index)) {}
  /// Where a line is within.
  media::Interval within(const media::Ray& ray) const {
    const media::Affine index = world_from_index.inverse();
    return *media::clip(index.point(ray.origin_m), index.vector(ray.direction), ray.nearest_m, ray.farthest_m, voxels);
  }
  double transmittance(const media::Ray& ray) const {
    const media::Affine index = world_from_index.inverse();
    const auto part = media::clip(index.point(ray.origin_m), index.vector(ray.direction), 0, 1e9, voxels);
    return part ? std::exp(-extinction_per_m * (part->end - part->begin)) : 1;
  }

 private:
  static Scene make(const media::Affine& map) {
    media::Component haze;
    haze.name = "haze";
    haze.grid = std::make_shared<const media::SparseGrid>(media::make_sparse_grid({{0, 0, 0}, {31, 31, 15}}, false, [](const media::Coord&) { return media::Voxel{1, 0}; }));
    haze.world_from_index = map;
    haze.interpolation = media::Interpolation::nearest;
    haze.extinction_scale = extinction_per_m;
    haze.albedo_scale = albedo;
    haze.species = std::make_shared<phase::Species>(phase::PhaseFunction(phase::HenyeyGreenstein(0.7)), 0.0);
    // So small that drawn directions never meet it: its light is asked for.
    const SunSettings sun{.azimuth_deg = 100, .elevation_deg = 30, .angular_radius_deg = 0.001, .spectrum = "equal_energy"};
    return Scene{.medium = std::make_unique<media::Medium>(std::vector<media::Component>{haze}),
                 .sun = Sun(sun, sun_irradiance(sun, "")),
                 .sky = Sky({.type = "constant", .radiance = 0.05}, Curve({550}, {1}, "")),
                 .surfaces = matte_plane(-5, 0.4),
                 .camera = nullptr};
  }
};

/// What is scattered into the ray on its first `length_m`, all of which are within.
Moments scattered_between(const Haze& haze, const media::Ray& ray, double length_m) {
  const VolumePath integrator(haze.scene, 1000000);
  const Wavelengths wavelengths = one_wavelength(550);
  const phase::PhaseFunction function{phase::HenyeyGreenstein(0.7)};
  const Sun& sun = haze.scene.sun;
  Moments moments;
  for (int batch = 0; batch < 64; ++batch) {
    double sum = 0;
    const int samples = static_cast<int>(1500 * statistics::test_effort());
    for (int i = 0; i < samples; ++i) {
      Random random(statistics::test_seed(1), static_cast<std::uint64_t>(batch), static_cast<std::uint32_t>(i));
      const double at_m = length_m * (i + random.uniform_double()) / samples;
      const Vec3 place = ray.at(at_m);
      const phase::Draw draw = function.draw(ray.direction, wavelengths, random);
      const FirstNumbers first{0.5, 0.5, 0.5, random.uniform_double(), random.uniform_double()};
      double light = static_cast<double>(integrator.radiance({place, draw.outgoing}, wavelengths, first, random)[0]);
      light += static_cast<double>(function.value(ray.direction, sun.to_centre(), wavelengths)[0] * sun.irradiance_w_per_m2_nm(wavelengths)[0]) * haze.transmittance({place, sun.to_centre()});
      sum += albedo * extinction_per_m * std::exp(-extinction_per_m * at_m) * light * length_m;
    }
    moments.add(sum / samples);
  }
  return moments;
}

}  // namespace

TEST(CameraInMedium, SeesWhatIsSeenFromOutsideLessWhatLiesBetween) {
  const Haze haze;
  std::size_t number = 0;
  for (const auto& [origin, target] : {std::pair{Vec3(-60, 10, 60), Vec3(20, 20, 30)}, {Vec3(30, -70, 25), Vec3(15, 5, 38)}, {Vec3(20, 15, -4), Vec3(22, 15, 40)}}) {
    const media::Ray outside{origin, normalize(target - origin)};
    const media::Interval part = haze.within(outside);
    const double length_m = 0.4 * (part.end - part.begin);
    ASSERT_GT(length_m, 8);
    const media::Ray at_edge{outside.at(part.begin), outside.direction}, inside{outside.at(part.begin + length_m), outside.direction};
    const Moments from_outside = traced(haze.scene, outside, ++number, one_wavelength(550), 1500), from_edge = traced(haze.scene, at_edge, ++number, one_wavelength(550), 1500),
                  from_inside = traced(haze.scene, inside, ++number, one_wavelength(550), 1500), between = scattered_between(haze, at_edge, length_m);
    const double through = std::exp(-extinction_per_m * length_m), composed = through * from_inside.mean() + between.mean();
    const double error = std::sqrt(from_outside.variance_of_mean() + between.variance_of_mean() + through * through * from_inside.variance_of_mean());
    EXPECT_NEAR(from_outside.mean(), composed, 4 * error);
    EXPECT_LT(error, 0.01 * composed);
    EXPECT_TRUE(statistics::means_agree(from_outside, from_edge, {.comparisons = 3}));
    // The parts are no small ones.
    EXPECT_GT(between.mean(), 0.15 * composed);
    EXPECT_LT(between.mean(), 0.85 * composed);
    std::cout << "seen " << from_outside.mean() << ", composed " << composed << " +- " << error << ", " << between.mean() << " of it from between\n";
  }
}

}  // namespace arcus::render
