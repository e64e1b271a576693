#include "src/photon/photon_store.h"

#include <array>

#include "phase/base/units.h"

namespace arcus::render {
namespace {

/// Least cosine between the surface that is looked at and that of a photon which counts there.
constexpr double least_cosine = 0.9;

PointTree tree_of(const std::vector<Photon>& photons) {
  std::vector<Vec3> points_m;
  points_m.reserve(photons.size());
  for (const Photon& photon : photons) points_m.push_back(photon.position_m);
  return PointTree(std::move(points_m));
}

/// The nearest photons but the last, whose distance is the radius.
class Circle {
 public:
  Circle(const PointTree& tree, const Vec3& position_m, int neighbours) {
    const auto wanted = static_cast<std::size_t>(std::clamp(neighbours, 1, PhotonStore::most_neighbours)) + 1;
    const std::size_t count = tree.nearest(position_m, std::span(nearest_).first(wanted));
    if (count < 2) return;
    radius2_m2 = nearest_[count - 1].squared_distance_m2;
    if (radius2_m2 > 0) inner = std::span<const Neighbour>(nearest_).first(count - 1);
  }
  double radius2_m2 = 0;
  std::span<const Neighbour> inner;

 private:
  std::array<Neighbour, PhotonStore::most_neighbours + 1> nearest_;
};

/// Share of Epanechnikov's kernel in a ball of radius 1 that lies within a distance t of its centre's plane on one side, and all of the other.
double share_within(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return 0.5 + 15.0 / 16 * t * (1 - t * t * (2.0 / 3 - t * t / 5));
}

}  // namespace

PhotonStore::PhotonStore(std::vector<Photon> photons) : photons_(std::move(photons)), tree_(tree_of(photons_)) {}

Gathered PhotonStore::irradiance(const Vec3& position_m, const Vec3& normal, int neighbours, const SpectralQuery& query) const {
  const Circle circle(tree_, position_m, neighbours);
  Spectrum sum;
  for (const Neighbour& one : circle.inner) {
    const Photon& photon = photons_[one.point];
    if (dot(photon.normal.full(), normal) < least_cosine) continue;
    sum += query.share(photon) * static_cast<float>(2 * (1 - one.squared_distance_m2 / circle.radius2_m2));
  }
  if (circle.inner.empty()) return {};
  return {sum * static_cast<float>(1 / (pi * circle.radius2_m2)), std::sqrt(circle.radius2_m2)};
}

Gathered PhotonStore::scattered(const Vec3& position_m, const Vec3& incoming, const phase::PhaseFunction& function, const Wavelengths& wavelengths,
                                int neighbours, const SpectralQuery& query, const media::Box& bounds_m) const {
  const Circle ball(tree_, position_m, neighbours);
  if (ball.inner.empty()) return {};
  Spectrum sum;
  for (const Neighbour& one : ball.inner) {
    const Photon& photon = photons_[one.point];
    sum += query.share(photon) * function.value(incoming, -photon.direction.full(), wavelengths) *
           static_cast<float>(2.5 * (1 - one.squared_distance_m2 / ball.radius2_m2));
  }
  const double radius_m = std::sqrt(ball.radius2_m2);
  double within = 1;
  for (int axis = 0; axis < 3; ++axis)
    within *= share_within((bounds_m.high[axis] - position_m[axis]) / radius_m) + share_within((position_m[axis] - bounds_m.low[axis]) / radius_m) - 1;
  return {sum * static_cast<float>(1 / (4 * pi / 3 * radius_m * ball.radius2_m2 * within)), radius_m};
}

}  // namespace arcus::render
