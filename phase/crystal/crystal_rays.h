#pragma once
// Light rays through one convex crystal, by Fresnel's coefficients at every face, with polarisation
// and absorption. Written to be read and in double precision; crystal_packets.h does the same many
// times faster and is tested against this.
//
// Everything is in the crystal's own axes (orientations.h turns directions into them and back).
// Lengths are in the shape's unit. No diffraction (silhouette_diffraction.h) and no interference.

#include <optional>
#include <vector>

#include "phase/base/random.h"
#include "phase/crystal/crystal_shape.h"
#include "phase/crystal/face_path.h"
#include "phase/optics/stokes.h"

namespace arcus::phase {

/// Where a ray of light meets the crystal.
struct CrystalEntry {
  std::size_t face;  ///< in CrystalShape::faces()
  Vec3 place;
};

/// Light that leaves.
struct CrystalExit {
  Vec3 direction;
  Vec3 place;
  /// Relative to unpolarised light of power 1 that entered; i is the share of its power. Axes:
  /// perpendicular and parallel to the plane of the incoming and this direction, as in scattering
  /// matrices: the first column of one. Exactly forward and backward the axes are arbitrary.
  Stokes light;
  FacePath path;
};

/// What became of the power 1 that met the crystal.
struct PowerAccount {
  double left = 0;  ///< sum of the exits
  double absorbed = 0;
  double cut_off = 0;  ///< still inside when the tracer stopped
};

class CrystalRays {
 public:
  /// n: index over that of the surroundings, above 1. absorption_per_length: of power, 4 pi k /
  /// wavelength in vacuum in the inverse of the shape's unit of length, at least 0; weak enough to
  /// leave Fresnel's coefficients real. Keeps a reference to the shape. Throws bad_input.
  CrystalRays(const CrystalShape& shape, double n, double absorption_per_length = 0);

  /// A point of the surface that light of this direction meets, uniform over the crystal's shadow;
  /// u in [0, 1).
  CrystalEntry entry(const Vec3& incoming, double u_face, double u1, double u2) const;
  CrystalEntry entry(const Vec3& incoming, Random& random) const;

  /// All the ways on: appends to `exits` what is reflected outside and what leaves at each of the
  /// first `events` faces met from inside. The crystal being convex, nothing branches: at each face
  /// one part leaves and the other goes on.
  PowerAccount split(const Vec3& incoming, const CrystalEntry& entry, int events,
                     std::vector<CrystalExit>& exits) const;

  /// One of them, drawn by its share of the power: reflected or not at every face, by what
  /// Fresnel's coefficients make of the ray's polarisation so far. light.i is what absorption
  /// leaves, 1 without it, and the mean over many draws of what is counted with light is that of
  /// split. None where the ray is still inside after `events` faces.
  std::optional<CrystalExit> draw(const Vec3& incoming, const CrystalEntry& entry, Random& random,
                                  int events = 1000) const;

 private:
  struct Ray;
  Ray enter(const Vec3& incoming, const CrystalEntry& entry, CrystalExit& reflected) const;
  bool advance(Ray& ray) const;

  const CrystalShape& shape_;
  double n_, absorption_;
};

}  // namespace arcus::phase
