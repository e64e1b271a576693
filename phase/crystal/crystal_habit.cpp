#include "phase/crystal/crystal_habit.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "phase/base/error.h"
#include "phase/base/units.h"
#include "phase/settings/number_text.h"

namespace arcus::phase {
namespace {

void require(bool right, const char* key, double found, const char* expected) {
  if (!right) throw bad_input(key, number_text(found), expected);
}

void check(const PyramidSettings& pyramid) {
  require(pyramid.height >= 0 && pyramid.height <= 1, "pyramid height", pyramid.height,
          "must be between 0 and 1");
  require(pyramid.h >= 1, "pyramid h", static_cast<double>(pyramid.h), "must be at least 1");
  require(pyramid.l >= 1, "pyramid l", static_cast<double>(pyramid.l), "must be at least 1");
}

void check(const HabitSettings& habit) {
  check(habit.upper);
  check(habit.lower);
  const bool capped = habit.upper.height > 0 && habit.lower.height > 0;
  require((habit.aspect_ratio >= 1e-5 && habit.aspect_ratio <= 1e5) ||
              (habit.aspect_ratio == 0 && capped),
          "aspect_ratio", habit.aspect_ratio,
          "must be between 1e-5 and 1e5, or 0 with pyramids on both ends");
  for (const double distance : habit.side_distances)
    require(distance > 0 && std::isfinite(distance), "side_distances", distance, "must be above 0");
}

/// Radius of the largest circle within the hexagon with these distances of its sides: opposite
/// sides bound it, and sides whose normals are 120 deg apart.
double inscribed_radius(const std::array<double, 6>& d) {
  double radius = std::min((d[0] + d[2] + d[4]) / 3, (d[1] + d[3] + d[5]) / 3);
  for (std::size_t i = 0; i < 3; ++i) radius = std::min(radius, 0.5 * (d[i] + d[i + 3]));
  return radius;
}

}  // namespace

void list_keys(Keys& keys, PyramidSettings& pyramid) {
  keys.number("height", pyramid.height, between(0, 1),
              "over that of the whole pyramid: 0 none, 1 up to the tip");
  keys.integer("h", pyramid.h, at_least(1), "Miller index of the faces {h 0 -h l}");
  keys.integer("l", pyramid.l, at_least(1), "Miller index of the faces {h 0 -h l}");
}

void list_keys(Keys& keys, HabitSettings& habit) {
  keys.number("aspect_ratio", habit.aspect_ratio, between(0, 1e5),
              "length of the prism over the diameter of its base");
  std::vector<double> distances(habit.side_distances.begin(), habit.side_distances.end());
  keys.numbers("side_distances", distances, above(0), 6, 6,
               "of the prism faces from the axis, over that of the regular hexagon");
  std::copy_n(distances.begin(), std::min<std::size_t>(6, distances.size()),
              habit.side_distances.begin());
  keys.table("upper_pyramid", habit.upper, "on the upper end");
  keys.table("lower_pyramid", habit.lower, "on the lower end");
}

double angle_from_c_axis_rad(long long h, long long l) {
  // The face {h 0 -h l} cuts the c axis at c / l and, along its horizontal normal, reaches
  // sqrt(3)/2 a / h.
  return std::atan2(0.5 * std::sqrt(3.0) * static_cast<double>(l),
                    ice_axial_ratio * static_cast<double>(h));
}

CrystalShape make_crystal(const HabitSettings& habit, double maximum_dimension_um) {
  check(habit);
  // The regular hexagon has diameter 2.
  std::array<double, 6> sides = habit.side_distances;
  for (double& side : sides) side *= 0.5 * std::sqrt(3.0);
  const double half_length = habit.aspect_ratio, inscribed = inscribed_radius(sides);
  std::vector<HalfSpace> planes;
  for (const double up : {1.0, -1.0}) {
    const PyramidSettings& pyramid = up > 0 ? habit.upper : habit.lower;
    const double slope = angle_from_c_axis_rad(pyramid.h, pyramid.l);
    planes.push_back(
        {{0, 0, up}, half_length + pyramid.height * inscribed / std::tan(slope), up > 0 ? 1 : 2});
    for (int i = 0; i < 6; ++i) {
      const double azimuth = radians(60.0 * i), side = sides[static_cast<std::size_t>(i)];
      const Vec3 outward(std::cos(azimuth), std::sin(azimuth), 0);
      if (up > 0) planes.push_back({outward, side, 3 + i});
      if (pyramid.height > 0)
        planes.push_back({outward * std::cos(slope) + Vec3(0, 0, up * std::sin(slope)),
                          std::cos(slope) * side + std::sin(slope) * half_length,
                          (up > 0 ? 13 : 23) + i});
    }
  }
  return CrystalShape(planes).scaled_to(maximum_dimension_um);
}

}  // namespace arcus::phase
