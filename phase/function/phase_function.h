#pragma once
// Where scattered light goes: a small value that is one of a closed set of kinds, made anew at every collision.

#include <variant>

#include "phase/base/random.h"
#include "phase/base/spectrum.h"
#include "phase/base/vec3.h"
#include "phase/base/wavelengths.h"
#include "phase/function/analytic.h"

namespace arcus::phase {

class OrientedCrystals;
class SphereTable;

/// One size node of a table, which must outlive it.
struct SphereLobe {
  const SphereTable* table;
  int size;
};

/// One size node of oriented crystals, which must outlive it.
struct OrientedLobe {
  const OrientedCrystals* crystals;
  int size;
};

/// A direction drawn from a phase function.
struct Draw {
  Vec3 outgoing;            ///< unit vector, the way the light goes on
  Spectrum value_per_sr;    ///< phase function in that direction
  /// How likely the draw was, had each wavelength led it; equal to the value but for oriented crystals. These know neither: both
  /// are in units of the first wavelength's density, the value being the albedo, and 0 at the other wavelengths, which would
  /// have gone elsewhere.
  Spectrum density_per_sr;
};

/// Integrates to 1 over the sphere [1/sr] at every wavelength. Both directions are unit vectors that point the way the
/// light travels: dot(incoming, outgoing) = 1 is straight on. All kinds but oriented crystals depend on the angle between them
/// alone, so a path traced backwards may pass them in its own order. What oriented crystals scatter is their extinction in the
/// direction of the light times this function; the product is reciprocal, and a path traced backwards passes the directions that
/// it goes, too.
class PhaseFunction {
 public:
  using Kinds = std::variant<Isotropic, Rayleigh, HenyeyGreenstein, SphereLobe, OrientedLobe>;

  PhaseFunction() = default;  ///< isotropic
  PhaseFunction(const Kinds& kind) : kind_(kind) {}

  /// Value for light from one direction. No sun's disc: to be used for all light but that of the disc where
  /// includes_sun_disc() is true, and for all light elsewhere. Not for oriented crystals, which can only be asked for the sun.
  Spectrum value(const Vec3& incoming, const Vec3& outgoing, const Wavelengths& wavelengths) const;

  /// True: sunlight is added with sunlit_value, and paths never count the sun's disc after such a scattering.
  bool includes_sun_disc() const;

  /// Mean of value from `incoming` to places of the sun's limb-darkened disc around `to_centre`, for a path traced backwards from
  /// a viewer; only where includes_sun_disc(). Times the irradiance on a surface facing the sun it gives the radiance scattered
  /// once.
  Spectrum sunlit_value(const Vec3& incoming, const Vec3& to_centre, const Wavelengths& wavelengths) const;

  /// A direction drawn as the first of the wavelengths would: its density there is value()[0].
  Draw draw(const Vec3& incoming, const Wavelengths& wavelengths, Random& random) const;

  /// True: each wavelength has to be drawn for itself, because none knows how likely another's draw was.
  bool parts_wavelengths() const { return std::holds_alternative<OrientedLobe>(kind_); }

  /// Whether a narrow part of the sphere may get most of the light, so that it pays to look there on purpose.
  bool is_peaked() const {
    if (const auto* function = std::get_if<HenyeyGreenstein>(&kind_)) return function->asymmetry() > 0.5;
    return std::holds_alternative<SphereLobe>(kind_);
  }

  /// Density of draw in a direction, had each wavelength led it [1/sr].
  Spectrum density(const Vec3& incoming, const Vec3& outgoing, const Wavelengths& wavelengths) const {
    return value(incoming, outgoing, wavelengths);
  }

 private:
  Kinds kind_;
};
static_assert(sizeof(PhaseFunction) <= 32);

}  // namespace arcus::phase
