#pragma once
// What surfaces are made of, and where exactly a ray meets one: spheres, flat pieces, triangles. All of it in double precision; what finds
// the candidates (src/shape/intersector.h) may be coarser.

#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "media/space/box.h"
#include "media/space/ray.h"
#include "phase/base/vec3.h"
#include "src/shape/terrain.h"
#include "src/shape/triangle.h"

namespace arcus::render {

/// Which piece of which group: what a ray leaves, so that it does not meet the same place again.
struct PieceId {
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t group = none, piece = none;
  bool operator==(const PieceId&) const = default;
};

/// From where a ray sets out: free space, or a piece and the side of it.
struct Departure {
  PieceId from;
  bool goes_inside = false;  ///< into the body behind the piece
};

/// A sphere around `centre_m` of its group plus this; single precision, so that 10⁷ of them fit.
struct Sphere {
  float x_m, y_m, z_m, radius_m;
  Vec3 offset_m() const { return {x_m, y_m, z_m}; }
};

/// A parallelogram, or the ellipse within it, around its centre: centre ± edge_u ± edge_v.
struct Flat {
  Vec3 centre_m, edge_u_m, edge_v_m;
  bool is_disc = false;
  double hole = 0;  ///< of a disc: radius of a hole in its middle over its own
};

/// Where a ray meets a piece.
struct Meeting {
  double distance_m;
  bool from_inside;  ///< of the sphere, or the back of a flat piece
};

/// The nearest meeting with a sphere within the ray's stretch, the ray's origin given relative to the sphere's centre; `is_departure`: the
/// ray leaves this very sphere, from its surface. Distance in a form that keeps its digits for small and distant spheres (E. Haines and
/// others, "Precision Improvements for Ray/Sphere Intersection", Ray Tracing Gems, chapter 7, 2019).
inline bool meet(const Vec3& origin_m, const Vec3& direction, double radius_m, double nearest_m, double farthest_m, bool is_departure,
                 bool goes_inside, Meeting& meeting) {
  if (is_departure && !goes_inside) return false;
  const double along = -dot(origin_m, direction);
  const Vec3 closest = origin_m + direction * along;
  const double rest = radius_m * radius_m - squared_length(closest);
  if (!(rest > 0)) return false;
  const double half = std::sqrt(rest);
  if (!is_departure && along - half > nearest_m) {
    meeting = {along - half, false};
    return meeting.distance_m < farthest_m;
  }
  meeting = {along + half, true};
  return meeting.distance_m > nearest_m && meeting.distance_m < farthest_m;
}

/// With a flat piece; its front is where edge_u × edge_v points to.
inline bool meet(const media::Ray& ray, const Flat& flat, Meeting& meeting) {
  const Vec3 normal = cross(flat.edge_u_m, flat.edge_v_m);
  const double slope = dot(ray.direction, normal);
  if (slope == 0) return false;
  const double t = dot(flat.centre_m - ray.origin_m, normal) / slope;
  if (!(t > ray.nearest_m && t < ray.farthest_m)) return false;
  const Vec3 p = ray.at(t) - flat.centre_m;
  const double scale = 1 / squared_length(normal);
  const double u = dot(cross(p, flat.edge_v_m), normal) * scale, v = dot(cross(flat.edge_u_m, p), normal) * scale;
  if (flat.is_disc ? u * u + v * v > 1 || u * u + v * v < flat.hole * flat.hole : std::fabs(u) > 1 || std::fabs(v) > 1) return false;
  meeting = {t, slope > 0};
  return true;
}

/// With a triangle's plane, for a ray that is known to meet the triangle; its front is where (b − a) × (c − a) points to.
inline bool meet_plane_of(const media::Ray& ray, const Triangle& triangle, Meeting& meeting) {
  const Vec3 normal = cross(triangle.b_m - triangle.a_m, triangle.c_m - triangle.a_m);
  const double slope = dot(ray.direction, normal);
  if (slope == 0) return false;
  const double t = dot(triangle.a_m - ray.origin_m, normal) / slope;
  if (!(t > ray.nearest_m && t < ray.farthest_m)) return false;
  meeting = {t, slope > 0};
  return true;
}

/// Pieces of one material.
struct PieceGroup {
  std::uint32_t material = 0;
  Vec3 centre_m{0, 0, 0};          ///< of the spheres
  std::vector<Sphere> spheres;     ///< either these
  std::vector<Flat> flats;         ///< or these
  std::vector<Triangle> triangles; ///< or these
  std::shared_ptr<const Terrain> terrain;  ///< or those of a terrain

  std::size_t triangle_count() const { return terrain ? terrain->triangles() : triangles.size(); }
  Triangle triangle(std::uint32_t piece) const { return terrain ? terrain->triangle(piece) : triangles[piece]; }
  std::size_t size() const { return spheres.size() + flats.size() + triangle_count(); }
};

media::Box bounds_of(const PieceGroup& group);

}  // namespace arcus::render
