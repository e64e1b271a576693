#include "src/integrator/photon_map.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cstring>
#include <memory>

#include "media/grid/sparse_grid.h"
#include "phase/base/error.h"
#include "phase/base/units.h"
#include "phase/species/species.h"
#include "src/integrator/make_integrator.h"
#include "src/integrator/path_tracer.h"
#include "src/integrator/volume_path.h"
#include "tests/src/flask.h"
#include "tests/statistics/seed.h"
#include "tests/statistics/students_t.h"

namespace arcus::render {
namespace {

using statistics::Moments;

/// `spread_m`: the ray is moved aside at random, in x and y, by up to so much.
Moments traced(const Integrator& integrator, media::Ray ray, int count, std::uint64_t stream = 0, double spread_m = 0) {
  Moments moments;
  Work work;
  const Vec3 middle_m = ray.origin_m;
  for (int i = 0; i < count; ++i) {
    Random random(statistics::test_seed(), stream, static_cast<std::uint32_t>(i));
    const Wavelengths wavelengths = draw_wavelengths(random.uniform_double());
    const FirstNumbers first{0.5, 0.5, 0.5, random.uniform_double(), random.uniform_double()};
    if (spread_m > 0) ray.origin_m = middle_m + Vec3(2 * random.uniform_double() - 1, 2 * random.uniform_double() - 1, 0) * spread_m;
    moments.add(integrator.radiance(ray, wavelengths, first, random, work).mean());
  }
  return moments;
}

/// Means of independent maps: all samples of one map share its photons.
struct Maps {
  Maps(const Scene& scene, RenderSettings settings, int count) {
    for (int i = 0; i < count; ++i) {
      settings.seed = static_cast<long long>(statistics::test_seed() >> 12) + i;
      maps.push_back(std::make_unique<PhotonMap>(scene, settings));
    }
  }
  Moments traced(const media::Ray& ray, int samples, double spread_m = 0) const {
    Moments moments;
    for (std::uint64_t i = 0; i < maps.size(); ++i) moments.add(render::traced(*maps[i], ray, samples, i + 1, spread_m).mean());
    return moments;
  }
  std::vector<std::unique_ptr<const PhotonMap>> maps;
};

/// Mean irradiance on the screen, around the axis.
Gathered around_axis(const PhotonStore& photons, double radius_m, int neighbours, const Wavelengths& wavelengths) {
  Gathered sum;
  constexpr int places = 40;
  for (int i = 0; i < places; ++i) {
    const double turn = 2 * pi * i / places;
    const Gathered one = photons.irradiance(Vec3(radius_m * std::sin(turn), 0, radius_m * std::cos(turn)), Vec3(0, 1, 0), neighbours, SpectralQuery(wavelengths));
    sum.value += one.value * (1.f / places);
    sum.radius_m += one.radius_m / places;
  }
  return sum;
}

/// A matte floor with a ball on it, lit by a wide sun from the south.
SurfaceParts ball_on_floor(const Material& ball) {
  SurfaceParts parts;
  parts.planes.push_back({0, 0});
  parts.materials.push_back(Material(Matte(0.6)));
  parts.add(one_sphere(Vec3(0, 0, 1), 1), ball);
  return parts;
}
bool are_same(const std::vector<Photon>& a, const std::vector<Photon>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Photon)) == 0;
}
bool are_same(const LandedPhotons& a, const LandedPhotons& b) { return are_same(a.on_surfaces, b.on_surfaces) && are_same(a.in_media, b.in_media); }

const SunSettings wide_sun{.azimuth_deg = 200, .elevation_deg = 50, .angular_radius_deg = 8, .spectrum = "equal_energy"};

}  // namespace

TEST(PhotonFlask, BowEndsWhereRayOpticsHasIt) {
  const Scene scene = flask();
  const PhotonTracer tracer(scene, 20);
  std::vector<Photon> landed = tracer.caustic(500000, statistics::test_seed(), 0).on_surfaces;
  relax(landed, scene.surfaces, {.iterations = 12});
  const PhotonStore photons(std::move(landed));
  const Wavelengths wavelengths{{450, 550, 650, 700}};
  for (int colour = 0; colour < 3; ++colour) {
    const double exact_m = bow_radius_m(wavelengths[colour], 1);
    // Outwards from where it is brightest to where half of that is left.
    double most = 0, at_m = 0, found_m = 0, resolution_m = 0;
    for (double radius_m = exact_m - 0.12; radius_m < exact_m + 0.12; radius_m += 0.004) {
      const Gathered here = around_axis(photons, radius_m, 25, wavelengths);
      if (here.value[colour] > most) most = here.value[colour], at_m = radius_m, resolution_m = here.radius_m;
    }
    for (found_m = at_m; around_axis(photons, found_m, 25, wavelengths).value[colour] > 0.5 * most;) found_m += 0.0005;
    EXPECT_NEAR(found_m, exact_m, resolution_m) << wavelengths[colour] << " nm";
    EXPECT_LT(resolution_m, 0.06) << wavelengths[colour] << " nm";
    // The dark band is dark: the same way beyond the edge as the light within.
    EXPECT_LT(around_axis(photons, exact_m + 0.15, 25, wavelengths).value[colour], 0.25 * around_axis(photons, exact_m - 0.15, 25, wavelengths).value[colour]);
  }
}

TEST(PhotonMap, AgreesWithThePathTracer) {
  const RenderSettings settings{.photons = 100000, .neighbours = 60};
  for (const Material& ball : {Material(Matte(0.7)), Material(Mirror{SmoothSpectrum(0.8)}), water(), dielectric(1.5, 2e-8)}) {
    const Scene scene = surfaces_in_sun(ball_on_floor(ball), wide_sun, 0.2);
    const Maps maps(scene, settings, 8);
    // The ball, the floor seen through it, its caustic seen from behind, the floor before it.
    const Vec3 south(1, -6, 3), north(1, 6, 3);
    const std::pair<Vec3, Vec3> views[] = {{south, {0.3, 0, 1.3}}, {south, {0.3, 0.8, 0}}, {north, {0.3, 0.8, 0}}, {south, {-1, -1, 0}}};
    for (const auto& [eye, target] : views) {
      const media::Ray ray{eye, normalize(target - eye)};
      const Moments a = traced(PathTracer(scene, 50), ray, 20000), b = maps.traced(ray, 700);
      EXPECT_TRUE(statistics::means_agree(a, b, {.comparisons = 16, .tolerance = 0.02 * a.mean()}))
          << "path " << a.mean() << " +- " << a.standard_error() << ", photon map " << b.mean() << " +- " << b.standard_error();
    }
  }
}

TEST(PhotonMap, LookedUpAtOnceItIsTheSameInTheOpen) {
  // Without final gathering the light from floor to ball and back is blurred more, in the open hardly.
  const Scene scene = surfaces_in_sun(ball_on_floor(Material(Matte(0.7))), wide_sun, 0.2);
  const media::Ray ray{Vec3(1, -6, 3), normalize(Vec3(0.3, -0.5, 1.3) - Vec3(1, -6, 3))};
  const Moments gathered = traced(PhotonMap(scene, {.photons = 200000, .neighbours = 100}), ray, 4000);
  const Moments at_once = traced(PhotonMap(scene, {.photons = 200000, .neighbours = 100, .final_gather = false}), ray, 4000);
  EXPECT_TRUE(statistics::means_agree(gathered, at_once, {.tolerance = 0.05 * gathered.mean()})) << gathered.mean() << " and " << at_once.mean();
}

TEST(PhotonMap, AgreesWithTheVolumePathInASlab) {
  media::Component slab;
  slab.name = "slab";
  slab.box = {Vec3(-4, -4, 0), Vec3(4, 4, 1)};
  slab.extinction_scale = 3;
  const SunSettings sun{.azimuth_deg = 200, .elevation_deg = 50, .spectrum = "equal_energy"};
  const Scene scene{.medium = std::make_unique<media::Medium>(std::vector<media::Component>{slab}),
                    .sun = Sun(sun, sun_irradiance(sun, "")),
                    .sky = Sky({}, Curve({550}, {1}, "")),
                    .surfaces = Surfaces(SurfaceParts{}),
                    .camera = nullptr};
  for (const bool final_gather : {true, false}) {
    const Maps maps(scene, {.photons = 100000, .neighbours = 20, .final_gather = final_gather}, 8);
    for (const Vec3& direction : {Vec3(0.2, 0.3, -1), Vec3(0.2, 0.3, 1), Vec3(0, 1, 0.1)}) {
      const Vec3 along = normalize(direction);
      const media::Ray ray{Vec3(0, 0, 0.5) - along * 20.0, along};
      const Moments a = traced(VolumePath(scene, 200), ray, 30000, 0, 1.5), b = maps.traced(ray, 2500, 1.5);
      EXPECT_TRUE(statistics::means_agree(a, b, {.comparisons = 6, .tolerance = 0.02 * a.mean()}))
          << "volume path " << a.mean() << " +- " << a.standard_error() << ", photon map " << b.mean() << " +- " << b.standard_error();
    }
  }
}

TEST(PhotonMap, AgreesWithTheVolumePathWhereAMediumFadesOut) {
  // Voxels of 1 m with light between them interpolated: the extinction falls to nothing over a metre all around.
  media::Component cloud;
  cloud.name = "cloud";
  cloud.grid = std::make_shared<const media::SparseGrid>(
      media::make_sparse_grid({{0, 0, 0}, {3, 3, 2}}, false, [](const media::Coord& c) { return media::Voxel{0.3f + 0.4f * static_cast<float>(c.x & 1), 0}; }));
  cloud.species = std::make_shared<phase::Species>(phase::PhaseFunction(phase::HenyeyGreenstein(0.5)), 0.0);
  const SunSettings sun{.azimuth_deg = 200, .elevation_deg = 50, .spectrum = "equal_energy"};
  const Scene scene{.medium = std::make_unique<media::Medium>(std::vector<media::Component>{cloud}),
                    .sun = Sun(sun, sun_irradiance(sun, "")),
                    .sky = Sky({}, Curve({550}, {1}, "")),
                    .surfaces = Surfaces(SurfaceParts{}),
                    .camera = nullptr};
  const Maps maps(scene, {.photons = 100000, .neighbours = 30}, 6);
  const Vec3 along = normalize(Vec3(0.3, 1, 0.2));
  const media::Ray ray{Vec3(1.5, 1.5, 1) - along * 20.0, along};
  const Moments a = traced(VolumePath(scene, 200), ray, 60000, 0, 2), b = maps.traced(ray, 10000, 2);
  EXPECT_TRUE(statistics::means_agree(a, b, {.tolerance = 0.01 * a.mean()})) << "volume path " << a.mean() << ", photon map " << b.mean();
}

TEST(PhotonMap, PassesBringBiasDown) {
  // Sixty passes with ever fewer neighbours come nearer to the path tracer's light in a caustic than the first of them alone.
  const Scene scene = surfaces_in_sun(ball_on_floor(dielectric(1.5)), wide_sun);
  // Just within the bright spot's edge, which is too dark; and beyond, where light leaks to.
  for (const double x_m : {0.4, 0.6}) {
    const Vec3 eye(1, 6, 3);
    const media::Ray ray{eye, normalize(Vec3(x_m, 0.8, 0) - eye)};
    const double exact = traced(PathTracer(scene, 50), ray, 30000).mean();
    const auto off = [&](long long passes) {
      return std::fabs(Maps(scene, {.photons = 1000, .neighbours = 200, .passes = passes}, 6).traced(ray, 1000).mean() / exact - 1);
    };
    const double one = off(1), sixty = off(60);
    EXPECT_LT(sixty, 0.7 * one) << one << " off with one pass, " << sixty << " with sixty";
  }
}

TEST(PhotonMap, SameBitsForAnyNumberOfThreads) {
  const Scene scene = flask();
  std::vector<float> first;
  for (const std::size_t threads : {1, 2, 3}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const PhotonMap photon_map(scene, {.seed = static_cast<long long>(statistics::test_seed() >> 12), .photons = 100000, .neighbours = 20, .iterations = 3, .passes = 2});
    std::vector<float> found;
    for (int i = 0; i < 200; ++i) {
      Random random(1, 2, static_cast<std::uint32_t>(i));
      Work work;
      const Vec3 eye(1, 5, 1), target(0.01 * i, 0, 0.5);
      const Spectrum light = photon_map.radiance({eye, normalize(target - eye)}, draw_wavelengths(i / 200.0), {0.5, 0.5, 0.5, 0.5, i / 200.0}, random, work);
      for (int j = 0; j < wavelength_count; ++j) found.push_back(light[j]);
    }
    if (first.empty()) first = found;
    EXPECT_EQ(std::memcmp(first.data(), found.data(), found.size() * sizeof(float)), 0) << threads << " threads";
  }
}

TEST(PhotonTracer, RangesOneAfterTheOtherAreTheWholeToTheBit) {
  const Scene scene = surfaces_in_sun(ball_on_floor(water()), wide_sun);
  const PhotonTracer tracer(scene, 20);
  const std::uint64_t seed = statistics::test_seed();
  constexpr std::uint32_t count = 30000;
  const LandedPhotons caustic = tracer.caustic(count, seed, 1), all = tracer.all(count, seed, 1, true);
  ASSERT_FALSE(caustic.on_surfaces.empty());
  for (const std::vector<std::uint32_t>& cuts : {std::vector<std::uint32_t>{0, 1, 2, 4096, 4097, 29999, 30000}, {0, 15000, 30000}}) {
    LandedPhotons caustic_parts, all_parts;
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      caustic_parts.append(tracer.caustic({cuts[i], cuts[i + 1], count}, seed, 1));
      all_parts.append(tracer.all({cuts[i], cuts[i + 1], count}, seed, 1, true));
    }
    EXPECT_TRUE(are_same(caustic_parts, caustic));
    EXPECT_TRUE(are_same(all_parts, all));
  }
}

TEST(PhotonSending, RangesCoverAllPassesOnceAndInOrder) {
  const Scene scene = surfaces_in_sun(ball_on_floor(water()), wide_sun), matte = surfaces_in_sun(ball_on_floor(Material(Matte(0.5))), wide_sun);
  for (const RenderSettings& settings : {RenderSettings{.photons = 1, .passes = 1}, {.photons = 1000, .passes = 700}, {.photons = 300000, .passes = 3}})
    for (const Scene* one : {&scene, &matte}) {
      const PhotonSending sending(*one, settings);
      const auto aimed = static_cast<std::uint32_t>(one == &scene ? settings.photons : 0), over_all = static_cast<std::uint32_t>(aimed > 0 ? (aimed + 3) / 4 : settings.photons);
      std::vector<PhotonStretch> joined;
      std::uint64_t longest = 0, shortest = ~0ull;
      for (std::size_t i = 0; i < sending.range_count(); ++i) {
        std::uint64_t photons = 0;
        for (const PhotonStretch& stretch : sending.range(i)) {
          ASSERT_LT(stretch.first, stretch.last);
          photons += stretch.last - stretch.first;
          const bool goes_on = !joined.empty() && joined.back().pass == stretch.pass && joined.back().is_aimed == stretch.is_aimed;
          if (!goes_on) {
            joined.push_back(stretch);
            continue;
          }
          ASSERT_EQ(joined.back().last, stretch.first);
          joined.back().last = stretch.last;
        }
        longest = std::max(longest, photons);
        if (i + 1 < sending.range_count()) shortest = std::min(shortest, photons);
      }
      std::vector<PhotonStretch> expected;
      for (std::uint32_t pass = 0; pass < settings.passes; ++pass) {
        if (aimed > 0) expected.push_back({pass, true, 0, aimed});
        expected.push_back({pass, false, 0, over_all});
      }
      EXPECT_EQ(joined, expected) << settings.photons << " photons, " << settings.passes << " passes";
      if (sending.range_count() > 1) {
        EXPECT_EQ(shortest, longest);
      }
    }
}

TEST(PhotonSending, StopsSoonAndGivesNothing) {
  const Scene scene = flask();
  const RenderSettings settings{.integrator = "photon_map", .photons = 100000, .iterations = 3};
  std::atomic<int> stop_request{15};
  EXPECT_FALSE(PhotonSending(scene, settings).send(0, &stop_request));
  EXPECT_EQ(make_integrator(scene, settings, &stop_request), nullptr);
  stop_request = 0;
  EXPECT_NE(make_integrator(scene, settings, &stop_request), nullptr);
}

TEST(PhotonMap, EveryRayOfTheSunIsSentOnce) {
  // Two mirrors, one before the other as the sun sees them: power that comes to rest on a wall is what falls on both together.
  const auto power_m2 = [](std::uint32_t count, bool aimed) {
    SurfaceParts parts;
    PieceGroup mirrors;
    for (const double y : {0.0, 1.0})
      mirrors.flats.push_back({Vec3(0.5 * y, y, 0), Vec3(0.5, 0.5, 0), Vec3(0, 0, 0.4), false});
    parts.add(std::move(mirrors), Material(Mirror{SmoothSpectrum(0.5)}));
    PieceGroup wall;
    wall.flats = {{Vec3(4, 0, 0), Vec3(0, 20, 0), Vec3(0, 0, 20), false}};
    parts.add(std::move(wall), Material(Matte(0)));
    const Scene scene = surfaces_in_sun(std::move(parts), {.azimuth_deg = 180, .elevation_deg = 0, .angular_radius_deg = 0.1, .spectrum = "equal_energy"});
    const PhotonTracer tracer(scene, 20);
    double sum = 0;
    for (const Photon& photon : aimed ? tracer.caustic(count, statistics::test_seed(), 0).on_surfaces : tracer.all(count, statistics::test_seed(), 0, true).on_surfaces)
      sum += photon.share[0] * (photon.direction.x > 0.1 ? 1 : 0);
    return sum;
  };
  // As wide as both are together: x from -0.5 to 1; 0.8 m high.
  EXPECT_NEAR(power_m2(200000, true), 0.5 * 1.5 * 0.8, 0.006);
  EXPECT_NEAR(power_m2(3000000, false), 0.5 * 1.5 * 0.8, 0.05);
}

TEST(PhotonMap, LaterPassesHaveFewerNeighbours) {
  // The product of (i + 2/3) / (i + 1) falls as i^(-1/3).
  EXPECT_EQ(neighbours_in_pass(100, 0), 100);
  EXPECT_EQ(neighbours_in_pass(100, 1), 83);
  EXPECT_NEAR(neighbours_in_pass(1000000, 1000) / 1e6, std::pow(1001, -1.0 / 3) / std::tgamma(5.0 / 3) , 1e-3);
}

TEST(PhotonMap, RefusesWhatItCannotShow) {
  const auto refused = [](const Scene& scene, const RenderSettings& settings, const char* words) {
    try {
      const PhotonMap photon_map(scene, settings);
      ADD_FAILURE() << words;
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::input);
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  };
  SunSettings dark = wide_sun;
  dark.irradiance_scale = 0;
  refused(surfaces_in_sun(ball_on_floor(water()), dark), {}, "sun without light");
  SurfaceParts plane;
  plane.planes.push_back({0, 0});
  plane.materials.push_back(Material(Matte(0.6)));
  refused(surfaces_in_sun(std::move(plane), wide_sun), {}, "planes alone");
  SurfaceParts mirror;
  mirror.add(one_sphere(Vec3(0), 1), Material(Mirror{SmoothSpectrum(0.8)}));
  refused(surfaces_in_sun(std::move(mirror), wide_sun), {.photons = 100}, "no photon that has landed");
}

TEST(SpectralKernel, HoldsOneWithinTheVisibleRange) {
  for (const double nm : {380.0, 383.0, 450.0, 777.0, 780.0})
    for (const double half_width_nm : {parted_half_width_nm, smooth_half_width_nm}) {
      const SpectralKernel kernel(nm, half_width_nm);
      double sum = 0;
      constexpr int steps = 400000;
      for (int i = 0; i < steps; ++i)
        sum += kernel(shortest_wavelength_nm + (longest_wavelength_nm - shortest_wavelength_nm) * (i + 0.5) / steps) * (longest_wavelength_nm - shortest_wavelength_nm) / steps;
      EXPECT_NEAR(sum, 1, 1e-5) << nm;
    }
}

}  // namespace arcus::render
