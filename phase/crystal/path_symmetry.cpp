#include "phase/crystal/path_symmetry.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "phase/base/units.h"

namespace arcus::phase {
namespace {

/// Of the shape's size: what two faces may differ by and be equal.
constexpr double tolerance = 1e-7;

/// A middle that every turn of the shape onto itself leaves where it is. Distances of faces count from it, as a habit's own origin
/// need not be its middle.
Vec3 middle_of(const CrystalShape& shape) {
  Vec3 sum(0, 0, 0);
  double count = 0;
  for (const CrystalFace& face : shape.faces())
    for (const Vec3& corner : face.corners) {
      sum = sum + corner;
      count += 1;
    }
  return sum * (1 / count);
}

Vec3 turned_direction(const Vec3& v, int sixths, bool mirrored, bool upside_down) {
  const double c = std::cos(radians(60.0 * sixths)), s = std::sin(radians(60.0 * sixths));
  const double y = mirrored ? -v.y : v.y;
  return {c * v.x - s * y, s * v.x + c * y, upside_down ? -v.z : v.z};
}

}  // namespace

PathSymmetry::PathSymmetry(const CrystalShape& shape) {
  const Vec3 middle = middle_of(shape);
  const auto distance = [&](const CrystalFace& face) { return face.distance - dot(face.normal, middle); };
  const auto face_at = [&](const Vec3& normal, double d) -> std::optional<std::uint8_t> {
    for (const CrystalFace& face : shape.faces())
      if (dot(face.normal - normal, face.normal - normal) < tolerance * tolerance &&
          std::fabs(distance(face) - d) < tolerance * shape.maximum_dimension())
        return static_cast<std::uint8_t>(face.number);
    return std::nullopt;
  };
  for (int sixths = 0; sixths < 6; ++sixths)
    for (const bool mirrored : {false, true})
      for (const bool upside_down : {false, true}) {
        Turn turn;
        for (std::size_t i = 0; i < turn.size(); ++i) turn[i] = static_cast<std::uint8_t>(i);
        const bool whole = std::ranges::all_of(shape.faces(), [&](const CrystalFace& face) {
          const auto to = face_at(turned_direction(face.normal, sixths, mirrored, upside_down), distance(face));
          if (to) turn[static_cast<std::size_t>(face.number)] = *to;
          return to.has_value();
        });
        if (whole) turns_.push_back(turn);
      }
}

FacePath PathSymmetry::turned(const FacePath& path, const Turn& turn) {
  FacePath result;
  for (int i = 0; i < path.length(); ++i) result = result.then(turn[static_cast<std::size_t>(path.face(i))]);
  // What follows after the last face kept has no number; any will do.
  return path.longer() ? result.then(1) : result;
}

std::vector<FacePath> PathSymmetry::equivalents(const FacePath& path) const {
  std::vector<FacePath> paths;
  for (const Turn& turn : turns_) paths.push_back(turned(path, turn));
  std::ranges::sort(paths);
  const auto rest = std::ranges::unique(paths);
  paths.erase(rest.begin(), rest.end());
  return paths;
}

FacePath PathSymmetry::representative(const FacePath& path) const {
  FacePath least = path;
  for (const Turn& turn : turns_) least = std::min(least, turned(path, turn));
  return least;
}

}  // namespace arcus::phase
