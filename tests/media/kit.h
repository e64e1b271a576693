#pragma once
// Small media whose answers are known, for the tests of this room.

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "media/grid/sparse_grid.h"
#include "media/medium/medium.h"
#include "phase/base/random.h"

namespace arcus::media::kit {

inline Wavelengths green() { return Wavelengths{{550, 600, 650, 450}}; }

inline Vec3 point_in(const Box& box, Random& random) {
  return {box.low.x + box.size().x * random.uniform_double(), box.low.y + box.size().y * random.uniform_double(),
          box.low.z + box.size().z * random.uniform_double()};
}
inline Vec3 direction(Random& random) {
  const double z = 2 * random.uniform_double() - 1, phi = 2 * pi * random.uniform_double();
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

inline Component component(std::shared_ptr<const SparseGrid> grid, const Affine& world_from_index = {},
                           Interpolation interpolation = Interpolation::linear) {
  return {.name = "test",
          .grid = std::move(grid),
          .box = {},
          .world_from_index = world_from_index,
          .interpolation = interpolation,
          .species = nullptr};
}
inline Component block(const Box& box, float extinction_per_m) {
  return {.name = "block",
          .grid = nullptr,
          .box = box,
          .world_from_index = {},
          .extinction_scale = extinction_per_m,
          .species = nullptr};
}
inline std::shared_ptr<const SparseGrid> grid(const IndexBox& box, const std::function<double(int, int, int)>& value) {
  return std::make_shared<const SparseGrid>(make_sparse_grid(
      box, false, [&](const Coord& c) { return Voxel{static_cast<float>(value(c.x, c.y, c.z)), 0}; }));
}

// The kinds of field that every estimator is asked about.
inline std::shared_ptr<const SparseGrid> uniform_grid(int n, double value = 1) {
  return grid({{0, 0, 0}, {n - 1, n - 1, n - 1}}, [=](int, int, int) { return value; });
}
/// Grows along x from 0 at the plane x = 0 to 1 at x = n − 1.
inline std::shared_ptr<const SparseGrid> ramp_grid(int n) {
  return grid({{0, 0, 0}, {n - 1, n - 1, n - 1}}, [=](int x, int, int) { return x / (n - 1.0); });
}
/// Cubes of `edge` voxels, alternately full and empty.
inline std::shared_ptr<const SparseGrid> checkerboard_grid(int n, int edge) {
  return grid({{0, 0, 0}, {n - 1, n - 1, n - 1}},
              [=](int x, int y, int z) { return (x / edge + y / edge + z / edge) % 2 ? 0.0 : 1.0; });
}
/// Smooth hills with sharp holes, sparse: some bricks are empty.
inline std::shared_ptr<const SparseGrid> rough_grid(const IndexBox& box) {
  return grid(box, [](int x, int y, int z) {
    const double hills = std::sin(0.13 * x) + std::sin(0.11 * y + 1) + std::sin(0.17 * z + 2);
    const int hash = (x * 73856093 ^ y * 19349663 ^ z * 83492791) & 15;
    return hills > 0.3 && hash != 0 ? hills * (1 + 0.2 * hash) : 0.0;
  });
}

/// Transforms that grids come with: plain, shifted and scaled, rotated with unequal edges, sheared, mirrored.
inline std::vector<std::pair<std::string, Affine>> transforms() {
  const Affine uneven = Affine::scaling({0.5, 2, 1.25});
  return {{"identity", {}},
          {"scaled", Affine::translation({10, -20, 5}) * Affine::scaling(Vec3(0.25))},
          {"rotated and uneven", Affine::rotation_deg({30, -50, 70}) * uneven},
          {"sheared", Affine{{1, 0.3, 0}, {0.2, 1, 0.4}, {0, -0.3, 1}, {1, 2, 3}}},
          {"mirrored", Affine::rotation_deg({0, 20, 10}) * Affine::scaling({-1, 1, 0.7})}};
}

}  // namespace arcus::media::kit
