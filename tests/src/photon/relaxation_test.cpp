#include "src/photon/relaxation.h"

#include <gtest/gtest.h>

#include <numeric>

#include "phase/base/units.h"
#include "src/photon/photon_store.h"
#include "tests/src/simple_surfaces.h"
#include "tests/statistics/moments.h"
#include "tests/statistics/seed.h"

namespace arcus::render {
namespace {

const Vec3 up(0, 0, 1);

/// A square of 1 m at z = 0.
Surfaces square() {
  SurfaceParts parts;
  PieceGroup group;
  group.flats = {{Vec3(0.5, 0.5, 0), Vec3(0.5, 0, 0), Vec3(0, 0.5, 0), false}};
  parts.add(std::move(group), Material(Matte(0.5)));
  return Surfaces(std::move(parts));
}

/// Photons on the square, as many times denser left of the middle as right of it.
std::vector<Photon> photons_on(int count, double step = 1) {
  Random random(statistics::test_seed(), 1, 0);
  std::vector<Photon> photons;
  for (int i = 0; i < count; ++i) {
    Photon photon;
    const bool is_left = random.uniform_double() * (step + 1) < step;
    photon.position_m = Vec3(0.5 * random.uniform_double() + (is_left ? 0 : 0.5), random.uniform_double(), 0);
    photon.normal = ShortVec(up);
    photon.direction = ShortVec(-up);
    photon.piece = {0, 0};
    photon.share = Spectrum::filled(1.f / static_cast<float>(count));
    photon.wavelengths = draw_wavelengths(random.uniform_double());
    photons.push_back(photon);
  }
  return photons;
}

double power(const std::vector<Photon>& photons) {
  return std::accumulate(photons.begin(), photons.end(), 0.0, [](double sum, const Photon& photon) { return sum + photon.share[0]; });
}

/// Mean distance to the nearest neighbour, over the spacing 1/√density; away from the borders.
double nearest_over_spacing(const std::vector<Photon>& photons) {
  std::vector<Vec3> places;
  for (const Photon& photon : photons) places.push_back(photon.position_m);
  const PointTree tree(places);
  statistics::Moments distance;
  for (const Vec3& place : places) {
    if (std::fabs(place.x - 0.5) > 0.4 || std::fabs(place.y - 0.5) > 0.4) continue;
    Neighbour found[2];
    tree.nearest(place, found);
    distance.add(std::sqrt(found[1].squared_distance_m2 * static_cast<double>(places.size())));
  }
  return distance.mean();
}

/// Relative scatter of the density that k neighbours give, away from the borders.
double density_noise(const std::vector<Photon>& photons, int neighbours) {
  const PhotonStore store(photons);
  const SpectralQuery query(draw_wavelengths(0.5));
  Random random(statistics::test_seed(), 2, 0);
  statistics::Moments density;
  for (int i = 0; i < 4000; ++i)
    density.add(store.irradiance(Vec3(0.1 + 0.8 * random.uniform_double(), 0.1 + 0.8 * random.uniform_double(), 0), up, neighbours, query).value[0]);
  return std::sqrt(density.variance()) / density.mean();
}

}  // namespace

TEST(PhotonStore, EvenLightIsRightForAnyNumberOfNeighbours) {
  // A hundred thousand photons at random: the estimate's mean is 1, its scatter that of Epanechnikov's kernel, √(4/3k) and a little more.
  const std::vector<Photon> photons = photons_on(100000);
  const PhotonStore store(photons);
  const SpectralQuery query(draw_wavelengths(0.5));
  for (const int neighbours : {8, 50, 200}) {
    Random random(statistics::test_seed(), 3, 0);
    statistics::Moments density;
    for (int i = 0; i < 4000; ++i)
      density.add(store.irradiance(Vec3(0.1 + 0.8 * random.uniform_double(), 0.1 + 0.8 * random.uniform_double(), 0), up, neighbours, query).value[0]);
    // Neighbouring places share photons: the error of the mean is that of the photons under all of them.
    EXPECT_NEAR(density.mean(), 1, 0.03) << neighbours;
    EXPECT_NEAR(std::sqrt(density.variance()), std::sqrt(4.0 / (3 * neighbours)), 0.25 * std::sqrt(4.0 / (3 * neighbours))) << neighbours;
  }
}

TEST(PhotonStore, IsRightAtBorders) {
  const std::vector<Photon> photons = photons_on(100000);
  const PhotonStore store(photons);
  const Surfaces surfaces = square();
  const SpectralQuery query(draw_wavelengths(0.5));
  Random random(statistics::test_seed(), 6, 0);
  statistics::Moments corrected, plain;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 place(0.01 * random.uniform_double(), 0.1 + 0.8 * random.uniform_double(), 0);
    corrected.add(store.irradiance(place, up, 50, query, surfaces.flat({0, 0})).value[0]);
    plain.add(store.irradiance(place, up, 50, query).value[0]);
  }
  EXPECT_NEAR(corrected.mean(), 1, 0.05);
  EXPECT_LT(plain.mean(), 0.9);
}

TEST(PhotonStore, LeavesOutTheOtherSide) {
  const std::vector<Photon> photons = photons_on(1000);
  const PhotonStore store(photons);
  EXPECT_GT(store.irradiance(Vec3(0.5, 0.5, 0), up, 50, SpectralQuery(draw_wavelengths(0.5))).value[0], 0.5);
  EXPECT_EQ(store.irradiance(Vec3(0.5, 0.5, 0), -up, 50, SpectralQuery(draw_wavelengths(0.5))).value[0], 0);
}

TEST(PointTree, FindsTheNearestInOrder) {
  const std::vector<Photon> photons = photons_on(500);
  std::vector<Vec3> places;
  for (const Photon& photon : photons) places.push_back(photon.position_m);
  places.push_back(places.front());  // one place twice
  const PointTree tree(places);
  for (int i = 0; i < 50; ++i) {
    std::vector<Neighbour> found(20);
    ASSERT_EQ(tree.nearest(places[static_cast<std::size_t>(i)], found), 20u);
    std::vector<std::pair<double, std::uint32_t>> all;
    for (std::uint32_t j = 0; j < places.size(); ++j) all.push_back({squared_length(places[j] - places[static_cast<std::size_t>(i)]), j});
    std::sort(all.begin(), all.end());
    for (std::size_t j = 0; j < found.size(); ++j) EXPECT_EQ(found[j].point, all[j].second);
  }
}

TEST(Relaxation, SpreadsPhotonsEvenly) {
  const Surfaces surfaces = square();
  std::vector<Photon> photons = photons_on(4000);
  EXPECT_NEAR(nearest_over_spacing(photons), 0.50, 0.02);  // of points at random: 1/2
  EXPECT_NEAR(density_noise(photons, 10), 0.37, 0.04);
  const double before = power(photons);
  EXPECT_GT(relax(photons, surfaces, {}).iterations, 5);
  EXPECT_GT(nearest_over_spacing(photons), 0.80);
  EXPECT_LT(density_noise(photons, 10), 0.15);
  EXPECT_NEAR(power(photons), before, 1e-6 * before);
  for (const Photon& photon : photons) {
    EXPECT_EQ(photon.position_m.z, 0);
    EXPECT_TRUE(photon.position_m.x >= 0 && photon.position_m.x <= 1 && photon.position_m.y >= 0 && photon.position_m.y <= 1);
  }
}

TEST(Relaxation, KeepsPowerOnItsSideOfAStep) {
  const auto moved_over = [](const Relaxation& relaxation) {
    std::vector<Photon> photons = photons_on(8000, 9);
    const auto left = [&] {
      double sum = 0;
      for (const Photon& photon : photons) sum += photon.position_m.x < 0.5 ? photon.share[0] : 0;
      return sum / power(photons);
    };
    const double before = left();
    relax(photons, square(), relaxation);
    return before - left();
  };
  const double guarded = moved_over({}), free = moved_over({.edge_begins = 2, .edge_holds = 3});
  EXPECT_LT(std::fabs(guarded), 0.025);
  EXPECT_GT(free, 2 * std::fabs(guarded));
}

TEST(Relaxation, CrossingSheetsDoNotPushEachOther) {
  // Two sheets of photons in the same places: each relaxes as if it were alone.
  const Surfaces surfaces = square();
  std::vector<Photon> alone = photons_on(2000), both = alone;
  for (Photon photon : photons_on(3000)) {
    photon.ancestry = 1;
    both.push_back(photon);
  }
  relax(alone, surfaces, {.iterations = 5, .enough = 0});
  relax(both, surfaces, {.iterations = 5, .enough = 0});
  for (std::size_t i = 0; i < alone.size(); ++i) EXPECT_EQ(alone[i].position_m, both[i].position_m);
}

TEST(Relaxation, StaysOnASphere) {
  SurfaceParts parts;
  parts.add(one_sphere(Vec3(1, 2, 3), 0.5), Material(Matte(0.5)));
  const Surfaces surfaces(std::move(parts));
  Random random(statistics::test_seed(), 4, 0);
  std::vector<Photon> photons(2000);
  for (Photon& photon : photons) {
    const Vec3 normal = direction_in_cone(frame_around(up), 1, random.uniform_double(), random.uniform_double());
    photon.position_m = Vec3(1, 2, 3) + normal * 0.5;
    photon.normal = ShortVec(normal);
    photon.piece = {0, 0};
  }
  EXPECT_GT(relax(photons, surfaces, {}).iterations, 3);
  for (const Photon& photon : photons) EXPECT_NEAR(length(photon.position_m - Vec3(1, 2, 3)), 0.5, 1e-12);
}

}  // namespace arcus::render
