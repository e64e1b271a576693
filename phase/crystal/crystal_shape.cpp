#include "phase/crystal/crystal_shape.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "phase/base/error.h"
#include "phase/base/frame.h"
#include "phase/settings/number_text.h"

namespace arcus::phase {
namespace {

struct Plane {
  Vec3 normal;
  double distance;
};

/// A polygon in a plane: corner i lies between side i - 1 and side i; sides are other planes, or
/// less than 0: the four that cut a large square out of the plane before anything else does.
struct Corner {
  Vec3 place;
  int side;
};

Vec3 common_point(const Plane& a, const Plane& b, const Plane& c) {
  const Vec3 bc = cross(b.normal, c.normal);
  return (bc * a.distance + cross(c.normal, a.normal) * b.distance +
          cross(a.normal, b.normal) * c.distance) *
         (1 / dot(a.normal, bc));
}

class Polygon {
 public:
  Polygon(const std::vector<Plane>& planes, std::size_t face, double far)
      : planes_(planes), face_(planes[face]) {
    const Frame frame = frame_around(face_.normal);
    const Vec3 outward[] = {frame.side, frame.other, -frame.side, -frame.other};
    for (int i = 0; i < 4; ++i) square_[i] = {outward[i], far};
    for (int i = 0; i < 4; ++i)
      corners_.push_back({common_point(face_, square_[(i + 3) % 4], square_[i]), -1 - i});
  }

  void clip(int cutter, double scale) {
    const Plane& plane = planes_[static_cast<std::size_t>(cutter)];
    if (length(cross(plane.normal, face_.normal)) < 1e-12) {
      if (dot(plane.normal, face_.normal) * face_.distance > plane.distance) corners_.clear();
      return;
    }
    // Corners that lie in the plane but for rounding count as inside: many planes may meet in one
    // point, the tip of a pyramid.
    const auto outside = [&](const Vec3& x) {
      return dot(plane.normal, x) - plane.distance > 1e-12 * scale + 1e-15 * length(x);
    };
    std::vector<Corner> kept;
    const std::size_t count = corners_.size();
    for (std::size_t i = 0; i < count; ++i) {
      const Corner& here = corners_[i];
      const Corner& next = corners_[(i + 1) % count];
      const bool out = outside(here.place), next_out = outside(next.place);
      if (!out) kept.push_back(here);
      if (out == next_out) continue;
      const Vec3 cut = common_point(face_, side_plane(here.side), plane);
      kept.push_back({cut, out ? here.side : cutter});
    }
    corners_ = std::move(kept);
  }

  /// Of all corners from the origin.
  double reach() const {
    double reach = 0;
    for (const Corner& corner : corners_) reach = std::max(reach, length(corner.place));
    return reach;
  }
  /// Without those nearer to the one before than `apart`, made where many planes meet in a point.
  std::vector<Vec3> distinct_corners(double apart) const {
    std::vector<Vec3> places;
    for (const Corner& corner : corners_)
      if (places.empty() || (length(corner.place - places.back()) > apart &&
                             length(corner.place - places.front()) > apart))
        places.push_back(corner.place);
    return places;
  }

 private:
  const Plane& side_plane(int side) const {
    return side < 0 ? square_[-1 - side] : planes_[static_cast<std::size_t>(side)];
  }

  const std::vector<Plane>& planes_;
  const Plane face_;
  Plane square_[4];
  std::vector<Corner> corners_;
};

std::vector<Plane> unit_planes(std::span<const HalfSpace> half_spaces) {
  std::vector<Plane> planes;
  std::set<int> numbers;
  for (const HalfSpace& half : half_spaces) {
    const std::string where = "crystal face " + std::to_string(half.number);
    const double norm = length(half.normal);
    if (!(norm > 0) || !std::isfinite(norm))
      throw bad_input(where, "a normal of length " + number_text(norm), "must be above 0");
    if (!std::isfinite(half.distance))
      throw bad_input(where, "distance " + number_text(half.distance), "must be finite");
    if (half.number < 1 || half.number > 31)
      throw bad_input(where, "that number", "must be 1 to 31");
    if (!numbers.insert(half.number).second)
      throw bad_input(where, "that number twice", "each face needs its own");
    planes.push_back({half.normal * (1 / norm), half.distance / norm});
  }
  return planes;
}

bool same(const Plane& a, const Plane& b) {
  return squared_length(a.normal - b.normal) < 1e-24 &&
         std::fabs(a.distance - b.distance) <= 1e-12 * std::fabs(a.distance);
}

}  // namespace

bool are_opposite(const CrystalFace& a, const CrystalFace& b) {
  return squared_length(a.normal + b.normal) < 1e-20;
}

CrystalShape::CrystalShape(std::span<const HalfSpace> half_spaces) {
  const std::vector<Plane> planes = unit_planes(half_spaces);
  const auto refuse = [](const char* found, const char* hint) {
    return bad_input("crystal", found, "must be a body with faces all around it", hint);
  };
  double scale = 0;
  for (const Plane& plane : planes) scale = std::max(scale, std::fabs(plane.distance));
  // Planes that are nearly parallel meet far away; beyond this the crystal counts as open.
  const double far = 1e6 * scale;
  for (std::size_t face = 0; face < planes.size(); ++face) {
    const auto before = planes.begin() + static_cast<std::ptrdiff_t>(face);
    if (std::any_of(planes.begin(), before, [&](const Plane& p) { return same(p, planes[face]); }))
      continue;
    Polygon polygon(planes, face, far);
    for (std::size_t cutter = 0; cutter < planes.size(); ++cutter)
      if (cutter != face && !same(planes[cutter], planes[face]))
        polygon.clip(static_cast<int>(cutter), scale);
    const double reach = polygon.reach();
    if (reach > 0.5 * far) throw refuse("an open side", "Add the faces that close it");
    CrystalFace made{half_spaces[face].number, planes[face].normal, planes[face].distance, 0, {}};
    made.corners = polygon.distinct_corners(1e-11 * reach);
    Vec3 twice_area(0);
    for (std::size_t i = 1; i + 1 < made.corners.size(); ++i)
      twice_area += cross(made.corners[i] - made.corners[0], made.corners[i + 1] - made.corners[0]);
    made.area = 0.5 * dot(twice_area, made.normal);
    // What is left of a plane through a mere edge or corner is rounding.
    if (made.area > 1e-11 * reach * reach) faces_.push_back(std::move(made));
  }
  pair_opposites();
  measure();
  if (faces_.size() < 4 || !(volume_ > 0)) throw refuse("no room inside", "Move the planes apart");
}

void CrystalShape::pair_opposites() {
  for (std::size_t i = 0; i + 1 < faces_.size(); ++i) {
    const auto rest = faces_.begin() + static_cast<std::ptrdiff_t>(i) + 1;
    const auto found = std::find_if(
        rest, faces_.end(), [&](const CrystalFace& face) { return are_opposite(face, faces_[i]); });
    if (found == faces_.end()) continue;
    std::rotate(rest, found, found + 1);
    ++i;
  }
}

void CrystalShape::measure() {
  surface_ = volume_ = maximum_dimension_ = 0;
  for (const CrystalFace& face : faces_) {
    surface_ += face.area;
    volume_ += face.area * face.distance / 3;
    for (const CrystalFace& other : faces_)
      for (const Vec3& a : face.corners)
        for (const Vec3& b : other.corners)
          maximum_dimension_ = std::max(maximum_dimension_, length(a - b));
  }
}

double CrystalShape::projected_area(const Vec3& direction) const {
  double area = 0;
  for (const CrystalFace& face : faces_)
    area += face.area * std::fmax(0.0, -dot(face.normal, direction));
  return area;
}

CrystalShape CrystalShape::scaled_to(double maximum_dimension) const {
  if (!(maximum_dimension > 0) || !std::isfinite(maximum_dimension))
    throw bad_input("crystal", "maximum dimension " + number_text(maximum_dimension),
                    "must be above 0");
  const double factor = maximum_dimension / maximum_dimension_;
  CrystalShape scaled = *this;
  for (CrystalFace& face : scaled.faces_) {
    face.distance *= factor;
    face.area *= factor * factor;
    for (Vec3& corner : face.corners) corner *= factor;
  }
  scaled.measure();
  return scaled;
}

}  // namespace arcus::phase
