#pragma once
// A convex crystal: the region that lies behind a number of planes, and the polygons that bound it.
// Every corner is the intersection of three of the planes themselves, so that needles and films of
// any aspect keep their digits.

#include <span>
#include <string>
#include <vector>

#include "phase/base/vec3.h"

namespace arcus::phase {

/// The points x with normal . x <= distance. number: what the face is called in ray paths, 1 ... 31
/// (crystal_habit.h has the numbers in use); any unit of length.
struct HalfSpace {
  Vec3 normal;
  double distance;
  int number;
};

struct CrystalFace {
  int number;
  Vec3 normal;      ///< unit, outward
  double distance;  ///< of its plane from the origin
  double area;
  std::vector<Vec3> corners;  ///< counterclockwise seen from outside
};

/// Normals exactly against each other, but for rounding.
bool are_opposite(const CrystalFace& a, const CrystalFace& b);

class CrystalShape {
 public:
  /// What all the half-spaces have in common. A plane that does not touch it has no face, and of
  /// two equal planes the first counts. Normals of any length but zero. Throws bad_input: numbers
  /// that are not finite, numbers of faces outside 1 ... 31 or used twice, half-spaces that do not
  /// close or have no point with room around it in common.
  explicit CrystalShape(std::span<const HalfSpace> half_spaces);

  /// Those with an area, in the order of their half-spaces, but that a parallel face follows at
  /// once.
  const std::vector<CrystalFace>& faces() const { return faces_; }
  double surface() const { return surface_; }
  double volume() const { return volume_; }
  double maximum_dimension() const { return maximum_dimension_; }  ///< between any two corners

  /// Area of the shadow in light of this direction (a unit vector).
  double projected_area(const Vec3& direction) const;
  /// Its mean over all directions, surface / 4 (Cauchy).
  double mean_projected_area() const { return 0.25 * surface_; }

  /// The same shape with another maximum dimension, above 0; the unit of length [um] is chosen
  /// here.
  CrystalShape scaled_to(double maximum_dimension) const;

 private:
  void pair_opposites();
  void measure();

  std::vector<CrystalFace> faces_;
  double surface_ = 0, volume_ = 0, maximum_dimension_ = 0;
};

}  // namespace arcus::phase
