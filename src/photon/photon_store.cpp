#include "src/photon/photon_store.h"

#include <array>
#include <utility>

#include "phase/base/units.h"

namespace arcus::render {
namespace {

/// Least cosine between the surface that is looked at and that of a photon which counts there.
constexpr double least_cosine = 0.9;

/// Of the kernel that is taken to lie on the surface or in the medium, however little does: a flat piece may be smaller than the circle.
constexpr double least_share = 0.05;

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

/// The same for a circle.
double share_of_circle_within(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return 0.5 + (t * (5 - 2 * t * t) * std::sqrt(1 - t * t) + 3 * std::asin(t)) / (3 * pi);
}

/// Share of the kernel in a circle around a place that lies on a flat piece.
double share_on(const Flat& flat, const Vec3& position_m, double radius_m) {
  const Vec3 offset_m = position_m - flat.centre_m;
  const auto within = [&](double distance_m) { return share_of_circle_within(distance_m / radius_m); };
  if (flat.is_disc) {
    // Of an ellipse the shorter half axis; the scene's discs are round.
    const double rim_m = std::min(length(flat.edge_u_m), length(flat.edge_v_m)), out_m = length(offset_m);
    const double share = within(rim_m - out_m);
    return flat.hole > 0 ? share + within(out_m - flat.hole * rim_m) - 1 : share;
  }
  const Vec3 across = cross(flat.edge_u_m, flat.edge_v_m);
  double share = 1;
  for (const auto& [along_m, other_m] : {std::pair(flat.edge_u_m, flat.edge_v_m), std::pair(flat.edge_v_m, flat.edge_u_m)}) {
    const Vec3 aside = normalize(cross(across, along_m));
    const double half_m = std::fabs(dot(aside, other_m)), at_m = dot(aside, offset_m);
    share *= within(half_m - at_m) + within(half_m + at_m) - 1;
  }
  return share;
}

}  // namespace

PhotonStore::PhotonStore(std::vector<Photon> photons) : photons_(std::move(photons)), tree_(tree_of(photons_)) {}

Gathered PhotonStore::irradiance(const Vec3& position_m, const Vec3& normal, int neighbours, const SpectralQuery& query, const Flat* flat) const {
  const Circle circle(tree_, position_m, neighbours);
  Spectrum sum;
  for (const Neighbour& one : circle.inner) {
    const Photon& photon = photons_[one.point];
    if (dot(photon.normal.full(), normal) < least_cosine) continue;
    sum += query.share(photon) * static_cast<float>(2 * (1 - one.squared_distance_m2 / circle.radius2_m2));
  }
  if (circle.inner.empty()) return {};
  const double radius_m = std::sqrt(circle.radius2_m2), on_surface = flat ? std::max(least_share, share_on(*flat, position_m, radius_m)) : 1;
  return {sum * static_cast<float>(1 / (pi * circle.radius2_m2 * on_surface)), radius_m};
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
  within = std::max(least_share, within);
  return {sum * static_cast<float>(1 / (4 * pi / 3 * radius_m * ball.radius2_m2 * within)), radius_m};
}

}  // namespace arcus::render
