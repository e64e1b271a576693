#include "src/shape/surfaces.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "phase/base/error.h"
#include "phase/base/random.h"
#include "src/shape/droplets.h"
#include "src/shape/mesh_file.h"
#include "tests/src/simple_surfaces.h"

namespace arcus::render {
namespace {

/// A name in the folder of temporary files, gone after the test.
struct TemporaryFile {
  std::string path;
  TemporaryFile(const std::string& name, const std::string& text) : path(testing::TempDir() + "arcus_" + name) { std::ofstream(path) << text; }
  ~TemporaryFile() { std::filesystem::remove(path); }
};

const char* tetrahedron_obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
const char* square_ply =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
    "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";

/// One of each, around `place`.
SurfaceParts all_shapes(const Vec3& place) {
  SurfaceParts parts;
  const Material grey(Matte(0.5));
  parts.planes.push_back({place.z - 3, 0});
  parts.materials.push_back(grey);
  parts.add(gasket(place, 2, 3), grey);
  PieceGroup flats;
  flats.flats = {{place + Vec3(1.5, 0, 0), {0.2, 0.6, 0}, {0, 0.1, 0.7}, false}, {place + Vec3(-1.5, 0, 0), {0, 0.6, 0}, {0.1, 0, 0.7}, true}};
  parts.add(flats, grey);
  const TemporaryFile file("tetrahedron.obj", tetrahedron_obj);
  PieceGroup mesh;
  for (Triangle t : read_mesh(file.path, "test")) mesh.triangles.push_back({t.a_m + place, t.b_m + place, t.c_m + place});
  parts.add(mesh, grey);
  DropletsSettings drops;
  drops.count = 3000;
  drops.radius_um.effective = 2e4;
  drops.low_m = place - Vec3(2);
  drops.high_m = place + Vec3(2);
  parts.add(drops_in_box(drops, "test"), grey);
  return parts;
}

Vec3 random_direction(Random& random) {
  return direction_in_cone(frame_around(Vec3(0, 0, 1)), 1, random.uniform_double(), random.uniform_double());
}

}  // namespace

/// The hierarchy finds what asking every piece finds, near the origin and far away, for rays from near and far, and from each other's hits.
TEST(Surfaces, HierarchyFindsWhatExhaustiveSearchFinds) {
  for (const Vec3& place : {Vec3(0), Vec3(4e4, -2e4, 3e3)}) {
    const Surfaces quick(all_shapes(place)), slow(all_shapes(place), true);
    Random random(7, 0, 0);
    int hits = 0, of_drops = 0;
    for (int i = 0; i < 20000; ++i) {
      const Vec3 direction = random_direction(random);
      const Vec3 target = place + random_direction(random) * 1.5;
      media::Ray ray{target - direction * (i % 3 == 0 ? 1e3 : 1), direction};
      Departure departure;
      for (int bounce = 0; bounce < 4; ++bounce) {
        const auto a = quick.nearest_hit(ray, departure), b = slow.nearest_hit(ray, departure);
        ASSERT_EQ(a.has_value(), b.has_value()) << i << " " << bounce;
        EXPECT_EQ(quick.is_blocked(ray, departure), a.has_value());
        if (!a) break;
        ASSERT_TRUE(a->piece == b->piece) << a->piece.group << " " << b->piece.group << " at " << a->distance_m - b->distance_m;
        EXPECT_EQ(a->distance_m, b->distance_m);
        EXPECT_EQ(a->from_inside, b->from_inside);
        EXPECT_LT(dot(a->normal, ray.direction), 0);
        ++hits;
        of_drops += a->piece.group == 3;
        const bool crosses = random.uniform() < 0.5;
        departure = a->departure(crosses);
        ray = media::Ray{a->position_m, normalize(random_direction(random) + a->normal * (crosses ? -1.01 : 1.01))};
      }
    }
    EXPECT_GT(hits, 20000);
    EXPECT_GT(of_drops, 500);
  }
}

TEST(Surfaces, ASphereIsEnteredAndLeftWhereGeometrySays) {
  SurfaceParts parts;
  parts.add(one_sphere(Vec3(1e5, 0, 0), 5e-4), dielectric(1.33));
  const Surfaces surfaces(std::move(parts));
  const media::Ray ray{Vec3(1e5 - 3, 3e-4, 0), Vec3(1, 0, 0)};
  const auto in = surfaces.nearest_hit(ray);
  ASSERT_TRUE(in);
  EXPECT_FALSE(in->from_inside);
  EXPECT_NEAR(in->distance_m, 3 - 4e-4, 1e-10);
  EXPECT_NEAR(in->normal.y, 0.6, 1e-6);
  const auto out = surfaces.nearest_hit({in->position_m, ray.direction}, in->departure(true));
  ASSERT_TRUE(out);
  EXPECT_TRUE(out->from_inside);
  EXPECT_NEAR(out->distance_m, 8e-4, 1e-10);
  EXPECT_FALSE(surfaces.nearest_hit({out->position_m, ray.direction}, out->departure(true)));
  EXPECT_FALSE(surfaces.nearest_hit({in->position_m, Vec3(-1, 0, 0)}, in->departure(false)));
}

TEST(Surfaces, ADiscMayHaveAHole) {
  ShapeSettings disc;
  disc.type = "disc";
  disc.normal = Vec3(1, 2, 3);
  disc.radius_m = 2;
  disc.inner_radius_m = 0.5;
  SurfaceParts parts, same;
  parts.add(pieces_of(disc, "", "test"), Material(Matte(0.5)));
  same.add(pieces_of(disc, "", "test"), Material(Matte(0.5)));
  const Surfaces surfaces(std::move(parts)), exhaustive(std::move(same), true);
  const Frame frame = frame_around(normalize(disc.normal));
  for (const double out_m : {0.0, 0.499, 0.501, 1.999, 2.001})
    for (const double turn : {0.3, 2.0, 4.0}) {
      const media::Ray ray{frame.to_world(out_m * std::cos(turn), out_m * std::sin(turn), 5), -frame.along};
      const bool meets = out_m > 0.5 && out_m < 2;
      EXPECT_EQ(surfaces.is_blocked(ray), meets) << out_m;
      EXPECT_EQ(exhaustive.nearest_hit(ray).has_value(), meets) << out_m;
    }
}

TEST(Gasket, TouchesAndCounts) {
  const PieceGroup group = gasket(Vec3(0), 2, 4);
  ASSERT_EQ(group.spheres.size(), 256u);
  const double radius = group.spheres[0].radius_m;
  EXPECT_NEAR(radius, 1.0 / 16, 1e-7);
  double nearest = 1e9;
  Vec3 sum(0);
  for (std::size_t i = 0; i < group.spheres.size(); ++i) {
    sum += group.spheres[i].offset_m();
    for (std::size_t j = 0; j < i; ++j) nearest = std::min(nearest, length(group.spheres[i].offset_m() - group.spheres[j].offset_m()));
  }
  EXPECT_NEAR(nearest, 2 * radius, 1e-6);
  EXPECT_NEAR(length(sum) / 256, 0, 1e-6);
}

TEST(Droplets, LieInTheBoxApartAndHaveTheirSizes) {
  DropletsSettings settings;
  settings.count = 20000;
  settings.radius_um.shape = {.type = "gamma", .variance = 0.05};
  settings.radius_um.effective = 8000;
  settings.low_m = Vec3(3, 4, 5);
  settings.high_m = Vec3(5, 7, 6);
  const PieceGroup group = drops_in_box(settings, "test");
  ASSERT_EQ(group.spheres.size(), 20000u);
  double squares = 0, cubes = 0;
  for (const Sphere& s : group.spheres) {
    squares += std::pow(s.radius_m, 2);
    cubes += std::pow(s.radius_m, 3);
    const Vec3 p = group.centre_m + s.offset_m();
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_GE(p[axis] - s.radius_m, settings.low_m[axis] - 1e-6);
      EXPECT_LE(p[axis] + s.radius_m, settings.high_m[axis] + 1e-6);
    }
  }
  EXPECT_NEAR(cubes / squares, 8e-3, 8e-3 * 0.01);
  int overlaps = 0;
  for (std::size_t i = 0; i < group.spheres.size(); i += 10)
    for (std::size_t j = 0; j < group.spheres.size(); ++j)
      overlaps += i != j && length(group.spheres[i].offset_m() - group.spheres[j].offset_m()) < static_cast<double>(group.spheres[i].radius_m) + group.spheres[j].radius_m;
  EXPECT_EQ(overlaps, 0);  // of drops thrown in blindly about 0.4 a drop would overlap
  const PieceGroup again = drops_in_box(settings, "test");
  EXPECT_EQ(again.spheres[777].x_m, group.spheres[777].x_m);
}

TEST(Droplets, TooManyForTheirBoxAreRefused) {
  DropletsSettings settings;
  settings.count = 2000;
  settings.radius_um.effective = 1e5;
  settings.low_m = Vec3(0);
  settings.high_m = Vec3(1);
  EXPECT_THROW(drops_in_box(settings, "test"), Error);
  settings.radius_um.effective = 1e6;
  EXPECT_THROW(drops_in_box(settings, "test"), Error);
}

TEST(MeshFile, ReadsPlyAndObjAndRefusesTheRest) {
  const TemporaryFile obj("mesh.obj", tetrahedron_obj), ply("mesh.ply", square_ply), empty("empty.obj", "v 0 0 0\n"), other("mesh.stl", "solid\n"),
      broken("broken.ply", "ply\nformat ascii 1.0\nelement vertex 4\n");
  EXPECT_EQ(read_mesh(obj.path, "test").size(), 4u);
  EXPECT_EQ(read_mesh(ply.path, "test").size(), 2u);  // a square, cut in two
  for (const std::string& path : {empty.path, other.path, broken.path, std::string("nowhere.ply")}) {
    try {
      read_mesh(path, "test");
      FAIL() << path;
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::input);
      EXPECT_NE(std::string(error.what()).find(path), std::string::npos) << error.what();
    }
  }
}

}  // namespace arcus::render
