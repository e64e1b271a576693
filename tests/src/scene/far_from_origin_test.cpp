// A scene 100 km from the origin is the scene at the origin: positions are doubles, and what is in single precision is relative to what it belongs to.

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "media/air/air_walk.h"
#include "media/grid/sparse_grid.h"
#include "media/tracking/collision_walk.h"
#include "media/tracking/optical_depth.h"
#include "phase/base/frame.h"
#include "phase/base/units.h"
#include "src/integrator/volume_path.h"
#include "src/shape/droplets.h"
#include "tests/src/simple_surfaces.h"

namespace arcus::render {
namespace {

const Vec3 far_m{100000, -100000, 0};

/// A faceted ball of triangles a few millimetres wide.
PieceGroup faceted_ball(const Vec3& centre_m, double radius_m) {
  constexpr int rows = 40, columns = 80;
  const auto corner = [&](int row, int column) { return centre_m + direction_of(360.0 * column / columns, 180.0 * row / rows - 90) * radius_m; };
  PieceGroup group;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const Vec3 a = corner(row, column), b = corner(row, column + 1), c = corner(row + 1, column + 1), d = corner(row + 1, column);
      if (row > 0) group.triangles.push_back({a, c, b});
      if (row < rows - 1) group.triangles.push_back({a, d, c});
    }
  return group;
}

PieceGroup hills(const Vec3& centre_m) {
  Raster heights{24, 24, 1, {}};
  for (int i = 0; i < 24 * 24; ++i) heights.values.push_back(static_cast<float>(0.5 + 0.5 * std::sin(0.7 * (i % 24)) * std::cos(0.9 * (i / 24))));
  PieceGroup group;
  group.terrain = std::make_shared<const Terrain>(std::move(heights), TerrainPlace{centre_m, 3, 3, -0.6, -0.4});
  return group;
}

/// One of each within a metre or so of a place; and perhaps a ball of `other_m` somewhere else, which makes the scene as large as it is far.
SurfaceParts everything_at(const Vec3& place_m, const std::optional<Vec3>& other_m = {}) {
  SurfaceParts parts;
  const Material grey(Matte(0.5));
  parts.add(faceted_ball(place_m + Vec3(0, 0, 0.2), 0.25), grey);
  parts.add(hills(place_m), grey);
  parts.add(one_sphere(place_m + Vec3(0.6, 0, 0.1), 0.2), grey);
  PieceGroup flats;
  flats.flats = {{place_m + Vec3(-0.6, 0, 0), {0.2, 0.1, 0}, {0, 0.1, 0.25}, false}, {place_m + Vec3(-0.6, 0.3, 0.5), {0, 0.1, 0.2}, {0.2, 0, 0.1}, true}};
  parts.add(std::move(flats), grey);
  DropletsSettings drops;
  drops.count = 400;
  drops.radius_um.effective = 3000;
  drops.low_m = place_m + Vec3(-0.3, -0.6, 0.3);
  drops.high_m = place_m + Vec3(0.3, -0.3, 0.7);
  parts.add(drops_in_box(drops, "test"), grey);
  if (other_m) parts.add(one_sphere(*other_m, 5), grey);
  return parts;
}

/// An eye 4 m away with pixels of a millimetre or so.
struct Eye {
  int width = 320, height = 200;
  media::Ray ray(const Vec3& place_m, int column, int row) const {
    const Frame frame = frame_around(normalize(Vec3(0.1, 4, -0.8)));
    const double x = 0.6 * ((column + 0.5) / width - 0.5), y = 0.375 * ((row + 0.5) / height - 0.5);
    return {place_m + Vec3(-0.1, -4, 1.1), normalize(frame.along + frame.side * x + frame.other * y)};
  }
};

struct Difference {
  int rays = 0, hits = 0, others = 0;  ///< others: another piece, or none
  double farthest_m = 0, most_turned = 0;
};

Difference compared(const Surfaces& here, const Surfaces& there) {
  const Eye eye;
  Difference difference;
  for (int row = 0; row < eye.height; ++row)
    for (int column = 0; column < eye.width; ++column) {
      const auto a = here.nearest_hit(eye.ray(Vec3(0), column, row)), b = there.nearest_hit(eye.ray(far_m, column, row));
      ++difference.rays;
      if (!a && !b) continue;
      ++difference.hits;
      if (!a || !b || !(a->piece == b->piece)) {
        ++difference.others;
        continue;
      }
      // Where it is grazed, rounding reaches farther along the ray.
      const double slope = std::fabs(dot(a->normal, eye.ray(Vec3(0), column, row).direction));
      difference.farthest_m = std::max(difference.farthest_m, std::fabs(a->distance_m - b->distance_m) * slope);
      difference.most_turned = std::max(difference.most_turned, length(a->normal - b->normal));
    }
  return difference;
}

void expect_same(const Difference& difference) {
  EXPECT_GT(difference.hits, difference.rays / 4);
  EXPECT_LE(difference.others, 2) << "of " << difference.hits << " hits";
  EXPECT_LT(difference.farthest_m, 1e-9);
  EXPECT_LT(difference.most_turned, 1e-6);
  std::cout << difference.hits << " hits, " << difference.others << " of other pieces; distances within " << difference.farthest_m << " m, normals within " << difference.most_turned << "\n";
}

/// A cloud of 20 m with holes, of voxels of a quarter metre, turned; and perhaps a block somewhere else.
std::vector<media::Component> cloud_at(const Vec3& place_m, const std::optional<Vec3>& other_m = {}) {
  const auto value = [](const media::Coord& c) {
    const double hill = std::sin(0.13 * c.x) + std::sin(0.11 * c.y + 1) + std::sin(0.17 * c.z + 2);
    return media::Voxel{static_cast<float>(hill > 0.3 ? hill : 0), 0};
  };
  static const auto grid = std::make_shared<const media::SparseGrid>(media::make_sparse_grid({{0, 0, 0}, {79, 79, 79}}, false, value));
  media::Component cloud;
  cloud.name = "cloud";
  cloud.grid = grid;
  cloud.world_from_index = media::Affine::translation(place_m) * media::Affine::rotation_deg({10, 20, 30}) * media::Affine::scaling(Vec3(0.25));
  cloud.extinction_scale = 0.1f;
  std::vector<media::Component> components{cloud};
  if (other_m) {
    media::Component block;
    block.name = "block";
    block.box = {*other_m - Vec3(5), *other_m + Vec3(5)};
    block.extinction_scale = 0.1f;
    components.push_back(block);
  }
  return components;
}

/// Fine steps across the cloud: a tenth of a millimetre there.
media::Ray across_cloud(const Vec3& place_m, int step) {
  const Vec3 eye(-30, 5, 12), target = Vec3(6, 9.0001 + 1e-4 * step, 11);
  return {place_m + eye, normalize(target - eye)};
}

Wavelengths four() {
  Wavelengths wavelengths;
  wavelengths.nm = {550, 450, 600, 680};
  return wavelengths;
}

Scene scene_at(const Vec3& place_m, const std::optional<Vec3>& other_m = {}) {
  const SunSettings sun{.azimuth_deg = 120, .elevation_deg = 40, .spectrum = "equal_energy"};
  SurfaceParts parts = everything_at(place_m + Vec3(5, 5, 0), other_m);
  parts.planes.push_back({-2, static_cast<std::uint32_t>(parts.materials.size())});
  parts.materials.push_back(Material(Matte(0.3)));
  return Scene{.medium = std::make_unique<media::Medium>(cloud_at(place_m, other_m)),
               .sun = Sun(sun, sun_irradiance(sun, "")),
               .sky = Sky({.type = "constant", .radiance = 0.05}, Curve({550}, {1}, "")),
               .surfaces = Surfaces(std::move(parts)),
               .camera = nullptr};
}

}  // namespace

TEST(FarFromOrigin, RaysMeetSurfacesAtTheSamePlaces) { expect_same(compared(Surfaces(everything_at(Vec3(0))), Surfaces(everything_at(far_m)))); }

TEST(FarFromOrigin, SurfacesAreAsSharpInASceneOfHundredKilometres) {
  expect_same(compared(Surfaces(everything_at(Vec3(0))), Surfaces(everything_at(far_m, Vec3(0)))));
}

TEST(FarFromOrigin, MediaAreAsDeepAndCollisionsLieAtTheSamePlaces) {
  const media::Medium here(cloud_at(Vec3(0))), there(cloud_at(far_m)), with_other(cloud_at(far_m, Vec3(0)));
  double worst_depth = 0, worst_bend = 0, worst_m = 0, before[2] = {0, 0};
  int collisions = 0;
  for (int step = 0; step < 2000; ++step) {
    const media::Ray a = across_cloud(Vec3(0), step), b = across_cloud(far_m, step);
    const double depth = media::optical_depth(here, a, 550);
    ASSERT_GT(depth, 0.3);
    for (const media::Medium* medium : {&there, &with_other}) {
      const double found = media::optical_depth(*medium, b, 550);
      worst_depth = std::max(worst_depth, std::fabs(found / depth - 1));
      if (medium == &there) {  // what is there, bends as here
        const double error = found - depth;
        if (step > 1) worst_bend = std::max(worst_bend, std::fabs(error - 2 * before[1] + before[0]));
        before[0] = before[1];
        before[1] = error;
      }
    }
    Random one(3, 1, static_cast<std::uint32_t>(step)), other(3, 1, static_cast<std::uint32_t>(step));
    media::CollisionWalk walk_here(here, a, four(), one), walk_there(there, b, four(), other);
    media::Collision x, y;
    while (walk_here.next(x)) {
      ASSERT_TRUE(walk_there.next(y)) << step;
      worst_m = std::max(worst_m, std::fabs(x.distance_m - y.distance_m));
      ++collisions;
    }
    EXPECT_FALSE(walk_there.next(y)) << step;
  }
  EXPECT_GT(collisions, 1000);
  EXPECT_LT(worst_depth, 1e-6);
  EXPECT_LT(worst_bend, 1e-6);
  EXPECT_LT(worst_m, 1e-6);
  std::cout << "optical depths within " << worst_depth << ", their second differences within " << worst_bend << ", " << collisions << " collisions within " << worst_m << " m\n";
}

TEST(FarFromOrigin, PathsBringTheSameLight) {
  const Scene here = scene_at(Vec3(0)), there = scene_at(far_m);
  const VolumePath near(here, 20), far(there, 20);
  const Eye eye;
  double sum = 0, difference = 0;
  int samples = 0, others = 0;
  for (int row = 5; row < eye.height; row += 10)
    for (int column = 5; column < eye.width; column += 10)
      for (int i = 0; i < 4; ++i) {
        media::Ray a = eye.ray(Vec3(5, 5, 0), column, row), b = a;
        b.origin_m += far_m;
        const auto radiance = [&](const VolumePath& path, const media::Ray& ray) {
          Random random(5, static_cast<std::uint64_t>(row * eye.width + column), static_cast<std::uint32_t>(i));
          return static_cast<double>(path.radiance(ray, four(), {0.5, 0.5, random.uniform_double(), random.uniform_double(), random.uniform_double()}, random).mean());
        };
        const double x = radiance(near, a), y = radiance(far, b);
        sum += x;
        difference += std::fabs(x - y);
        others += std::fabs(x - y) > 1e-4 * x;
        ++samples;
      }
  // Between drops rounding grows from turn to turn: a few paths go elsewhere.
  EXPECT_LT(others, samples / 100);
  EXPECT_LT(difference, 0.01 * sum);
  std::cout << others << " of " << samples << " samples differ by more than 1e-4; mean difference " << difference / sum << " of the mean\n";
}

/// Fine steps of the view, and of the eye: neighbours may differ, but not jump.
TEST(FarFromOrigin, AirDoesNotJitter) {
  media::AirSettings settings;
  settings.haze_depth_550 = 0.2;
  const media::Atmosphere air(settings);
  // The planet has sunk by 1,570 m there: the eye stands as high over it at both places.
  const double sunk_m = air.height_m(far_m);
  const auto bend = [&](const Vec3& eye, const Vec3& eye_step_m, double elevation_deg, double elevation_step_deg, double length_m) {
    double worst = 0, before[2] = {0, 0};
    for (int step = 0; step < 400; ++step) {
      media::Ray ray{eye + eye_step_m * step, direction_of(30, elevation_deg + elevation_step_deg * step)};
      ray.farthest_m = length_m;
      const double column = air.columns(ray).haze_depth_550;
      if (step > 1) worst = std::max(worst, std::fabs(column - 2 * before[1] + before[0]) / column);
      before[0] = before[1];
      before[1] = column;
    }
    return worst;
  };
  double most = 0;
  for (const double elevation_deg : {-2.0, 0.0, 3.0, 40.0})
    for (const double length_m : {300.0, 20000.0, 1e9})
      for (const bool is_view : {true, false}) {
        const Vec3 eye_step_m = is_view ? Vec3(0) : Vec3(0.01, 0.02, 0.003);
        const double view_step_deg = is_view ? 1e-5 : 0;
        const double here = bend(Vec3(0, 0, 2000 + sunk_m), eye_step_m, elevation_deg, view_step_deg, length_m), there = bend(Vec3(far_m.x, far_m.y, 2000), eye_step_m, elevation_deg, view_step_deg, length_m);
        EXPECT_LT(there, 1e-6) << "at " << elevation_deg << " degrees over " << length_m << " m; at the origin " << here;
        most = std::max(most, there);
      }
  std::cout << "columns of haze bend by " << most << " from step to step\n";
}

}  // namespace arcus::render
