#include "phase/crystal/crystal_rays.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "phase/base/error.h"
#include "phase/base/frame.h"
#include "phase/settings/number_text.h"

namespace arcus::phase {

/// A ray on its way, at a face it has just met.
struct CrystalRays::Ray {
  Vec3 place, direction;
  Vec3 perpendicular;  ///< to the plane of the last face that turned the light; any length
  Stokes light;        ///< with respect to `perpendicular`
  FacePath path;
  const CrystalFace* face = nullptr;
  double cos_incident = 0;

  /// Turns the light's axes to a plane that holds the ray and `other`.
  void turn_to_plane_with(const Vec3& other) {
    const Vec3 next = cross(direction, other);
    if (squared_length(next) < 1e-20) return;  // along the normal any axes do, the old ones too
    // With next = direction x other: e_parallel . next = (direction x perpendicular) . next
    // = perpendicular . other.
    light = turned(light, dot(perpendicular, next), dot(perpendicular, other));
    perpendicular = next;
  }
};

namespace {

/// The direction beyond an interface, its normal against the light.
Vec3 refracted(const Vec3& direction, const Vec3& against, double relative_index,
               double cos_incident, double cos_transmitted) {
  const double inverse = 1 / relative_index;
  return direction * inverse + against * (inverse * cos_incident - cos_transmitted);
}

}  // namespace

CrystalRays::CrystalRays(const CrystalShape& shape, double n, double absorption_per_length)
    : shape_(shape), n_(n), absorption_(absorption_per_length) {
  if (!(n > 1) || !std::isfinite(n))
    throw bad_input("refractive index of a crystal", number_text(n), "must be above 1");
  if (!(absorption_ >= 0) || !std::isfinite(absorption_))
    throw bad_input("absorption of a crystal", number_text(absorption_), "must be at least 0");
}

CrystalEntry CrystalRays::entry(const Vec3& incoming, double u_face, double u1, double u2) const {
  const auto& faces = shape_.faces();
  double left = u_face * shape_.projected_area(incoming), share = 0;
  std::size_t chosen = faces.size();
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const double lit = -dot(faces[i].normal, incoming) * faces[i].area;
    if (!(lit > 0)) continue;
    chosen = i;
    share = std::clamp(left / lit, 0.0, 1.0);
    if (left < lit) break;
    left -= lit;
  }
  assert(chosen < faces.size());
  // The face as a fan of triangles around its first corner.
  const auto& corners = faces[chosen].corners;
  std::size_t triangle = 0;
  for (double area = share * faces[chosen].area; triangle + 3 < corners.size(); ++triangle) {
    area -=
        0.5 * length(cross(corners[triangle + 1] - corners[0], corners[triangle + 2] - corners[0]));
    if (area < 0) break;
  }
  if (u1 + u2 > 1) {  // fold the square onto the triangle
    u1 = 1 - u1;
    u2 = 1 - u2;
  }
  return {chosen, corners[0] + (corners[triangle + 1] - corners[0]) * u1 +
                      (corners[triangle + 2] - corners[0]) * u2};
}

CrystalEntry CrystalRays::entry(const Vec3& incoming, Random& random) const {
  const double u_face = random.uniform_double(), u1 = random.uniform_double();
  return entry(incoming, u_face, u1, random.uniform_double());
}

CrystalRays::Ray CrystalRays::enter(const Vec3& incoming, const CrystalEntry& entry,
                                    CrystalExit& outside) const {
  const CrystalFace& face = shape_.faces()[entry.face];
  Ray ray{entry.place, incoming, frame_around(incoming).side, {}, FacePath().then(face.number)};
  ray.turn_to_plane_with(face.normal);
  const double cosine = std::min(1.0, -dot(incoming, face.normal));
  const InterfaceMatrix interface = interface_matrix(cosine, n_);
  Ray reflected = ray;
  reflected.light = interface.reflected(ray.light);
  reflected.direction = incoming + face.normal * (2 * cosine);
  reflected.turn_to_plane_with(incoming);
  outside = {reflected.direction, ray.place, reflected.light, ray.path};
  ray.light = interface.transmitted(ray.light);
  ray.direction = refracted(incoming, face.normal, n_, cosine, interface.cos_transmitted);
  return ray;
}

bool CrystalRays::advance(Ray& ray) const {
  double nearest = std::numeric_limits<double>::infinity();
  ray.face = nullptr;
  for (const CrystalFace& face : shape_.faces()) {
    const double cosine = dot(face.normal, ray.direction);
    if (cosine <= 0) continue;
    const double distance = std::fmax(0.0, face.distance - dot(face.normal, ray.place)) / cosine;
    if (distance >= nearest) continue;
    nearest = distance;
    ray.face = &face;
    ray.cos_incident = std::min(1.0, cosine);
  }
  if (ray.face == nullptr) return false;  // only a direction that is no number
  ray.place += ray.direction * nearest;
  ray.light = ray.light * std::exp(-absorption_ * nearest);
  ray.path = ray.path.then(ray.face->number);
  ray.turn_to_plane_with(ray.face->normal);
  return true;
}

PowerAccount CrystalRays::split(const Vec3& incoming, const CrystalEntry& entry, int events,
                                std::vector<CrystalExit>& exits) const {
  PowerAccount account;
  CrystalExit outside;
  Ray ray = enter(incoming, entry, outside);
  account.left = outside.light.i;
  exits.push_back(outside);
  for (int event = 0; event < events; ++event) {
    const double before = ray.light.i;
    if (!advance(ray)) break;
    account.absorbed += before - ray.light.i;
    const InterfaceMatrix interface = interface_matrix(ray.cos_incident, 1 / n_);
    if (!interface.total()) {
      Ray leaving = ray;
      leaving.light = interface.transmitted(ray.light);
      leaving.direction = refracted(ray.direction, -ray.face->normal, 1 / n_, ray.cos_incident,
                                    interface.cos_transmitted);
      leaving.turn_to_plane_with(incoming);
      account.left += leaving.light.i;
      exits.push_back({leaving.direction, ray.place, leaving.light, ray.path});
    }
    ray.light = interface.reflected(ray.light);
    ray.direction -= ray.face->normal * (2 * ray.cos_incident);
  }
  account.cut_off = ray.light.i;
  return account;
}

std::optional<CrystalExit> CrystalRays::draw(const Vec3& incoming, const CrystalEntry& entry,
                                             Random& random, int events) const {
  CrystalExit exit;
  Ray ray = enter(incoming, entry, exit);
  if (random.uniform_double() < exit.light.i) {
    exit.light = exit.light * (1 / exit.light.i);
    return exit;
  }
  ray.light = ray.light * (1 / ray.light.i);
  for (int event = 0; event < events && advance(ray); ++event) {
    const InterfaceMatrix interface = interface_matrix(ray.cos_incident, 1 / n_);
    const double arriving = ray.light.i;
    const Stokes reflected = interface.reflected(ray.light);
    if (interface.total() || random.uniform_double() * arriving < reflected.i) {
      ray.light = reflected * (arriving / reflected.i);
      ray.direction -= ray.face->normal * (2 * ray.cos_incident);
      continue;
    }
    ray.light = interface.transmitted(ray.light);
    ray.light = ray.light * (arriving / ray.light.i);
    ray.direction = refracted(ray.direction, -ray.face->normal, 1 / n_, ray.cos_incident,
                              interface.cos_transmitted);
    ray.turn_to_plane_with(incoming);
    return CrystalExit{ray.direction, ray.place, ray.light, ray.path};
  }
  return std::nullopt;
}

}  // namespace arcus::phase
