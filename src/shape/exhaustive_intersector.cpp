// The intersector that asks every piece: what the hierarchy is held against, in time and in answers.
#include "src/shape/intersector.h"

namespace arcus::render {
namespace {

/// Möller and Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", Journal of Graphics Tools 2(1), 1997.
bool is_within(const media::Ray& ray, const Triangle& t) {
  const Vec3 ab = t.b_m - t.a_m, ac = t.c_m - t.a_m, p = cross(ray.direction, ac);
  const double determinant = dot(ab, p);
  if (determinant == 0) return false;
  const Vec3 s = ray.origin_m - t.a_m, q = cross(s, ab);
  const double u = dot(s, p) / determinant, v = dot(ray.direction, q) / determinant;
  return u >= 0 && v >= 0 && u + v <= 1;
}

class Exhaustive : public Intersector {
 public:
  explicit Exhaustive(const std::vector<PieceGroup>& groups) : groups_(groups) {}

  std::optional<PieceHit> nearest(const media::Ray& ray, const Departure& departure) const override {
    std::optional<PieceHit> best;
    media::Ray rest = ray;
    Meeting meeting;
    for (std::uint32_t g = 0; g < groups_.size(); ++g) {
      const PieceGroup& group = groups_[g];
      const std::uint32_t left = departure.from.group == g ? departure.from.piece : PieceId::none;
      const auto found = [&](std::uint32_t piece) {
        best = PieceHit{{g, piece}, meeting};
        rest.farthest_m = meeting.distance_m;
      };
      const Vec3 origin = ray.origin_m - group.centre_m;
      for (std::uint32_t i = 0; i < group.spheres.size(); ++i)
        if (const Sphere& s = group.spheres[i]; meet(origin - s.offset_m(), ray.direction, s.radius_m, rest.nearest_m, rest.farthest_m, i == left,
                                                     departure.goes_inside, meeting))
          found(i);
      for (std::uint32_t i = 0; i < group.flats.size(); ++i)
        if (i != left && meet(rest, group.flats[i], meeting)) found(i);
      for (std::uint32_t i = 0; i < group.triangle_count(); ++i)
        if (const Triangle t = group.triangle(i); i != left && is_within(ray, t) && meet_plane_of(rest, t, meeting)) found(i);
    }
    return best;
  }
  bool is_blocked(const media::Ray& ray, const Departure& departure) const override { return nearest(ray, departure).has_value(); }

 private:
  const std::vector<PieceGroup>& groups_;
};

}  // namespace

std::unique_ptr<const Intersector> make_exhaustive(const std::vector<PieceGroup>& groups) {
  return std::make_unique<Exhaustive>(groups);
}

}  // namespace arcus::render
